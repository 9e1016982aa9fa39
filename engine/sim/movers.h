// What moves, and what drives its joints and stops them. Private to engine/sim.
#pragma once

#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "engine/sim/articulation.h"
#include "engine/sim/bonds.h"

namespace stampede {

// A body without joints. Its object's frame: centre of mass and principal axes.
struct FreeBody {
  btCollisionObject* object = nullptr;
  double mass = 1;
  Vector3 moments = Vector3::Ones();
  Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();  // velocities, world, m/s and rad/s

  Matrix3 principal_axes() const;   // in the world
  Matrix3 inverse_inertia() const;  // along world axes, 1/(kg m^2)
};

// Drives a joint of a tree towards a speed and a position with a limited force: the speed aimed at is
// velocity + position_gain * erp * (position - q) / dt, at most `fastest`.
struct JointMotor {
  int dof = 0;
  double erp = 1;  // share of the error in position that a step takes away
  double position = 0, position_gain = 0, velocity = 0;
  double fastest = 1e30;  // m/s or rad/s
  double most_force = 0;  // N or N m; 0: it is off
  // N or N m, above 0: beyond what the speed asked for takes where nothing touches, the motor gives no more than this.
  double against_contact = 0;
  bool presses = false;    // what holds it up bears all its force: the solver starts from there
  double force = 0;        // of the last step
  bool saturated = false;  // in the last step, by one of both
};

// Keeps a tree from going faster than `most_speed` along `jacobian`, of which each entry is what a dof at unit speed
// adds: of one joint, or of a point of a link. It gives no more than `most_force`, whatever pushes the tree. m/s and N,
// or rad/s and N m.
struct SpeedBrake {
  std::vector<double> jacobian;
  double most_speed = 0, most_force = 0;
};

// Keeps joint `one` of a tree at ratio * other + offset.
struct JointGear {
  int one = 0, other = 0;  // dofs
  double erp = 0.04;
  double most_force = 0;  // on `one`
  double ratio = 1, offset = 0;
};

struct JointStop {
  int dof = 0;
  double lower = 0, upper = 0;
};

// How long a mover has been at rest: all that tells one moment from another beside positions and velocities, right
// after contacts were forgotten.
struct Rest {
  int rest = 0;                                                           // steps
  Vector3 mean_linear = Vector3::Zero(), mean_angular = Vector3::Zero();  // velocities of a free body, smoothed
};

struct Mover : Rest {  // what moves as one: a free body or a tree
  FreeBody* free = nullptr;
  Articulation* tree = nullptr;
  int at = 0, quads = 0;  // its part of all velocities
  int island = 0;         // the first of all movers that it touches, over others too
  bool may_sleep = true, asleep = false;
  Matrix3 inverse_inertia = Matrix3::Zero();  // of a free body, world axes
  std::vector<btCollisionObject*> objects;
  std::vector<JointMotor*> motors;
  std::vector<JointGear> gears;
  std::vector<JointStop> stops;
  std::vector<SpeedBrake> brakes;

  void set_asleep(bool sleeps);
  bool at_rest() const;
  bool slower(double than) const;  // so many times the speed of rest
  // Speed and spin of what moves freely: a free body, or the first link of a floating tree.
  std::optional<std::pair<Vector3, Vector3>> free_twist() const;
  Vector3 velocity_at(int link, const Vector3& point) const;
};

// What an object belongs to; nothing: it stands still.
struct MoverLink {
  int mover = -1, link = -1;
  static MoverLink of(const btCollisionObject* object);
};

class Movers {
 public:
  // In the order in which they are added. References stay valid.
  FreeBody& add_free(const FreeBody& body);
  Articulation& add_tree(const Transform& world_from_base, bool floating, bool may_sleep);
  void add_object(btCollisionObject& object, Articulation& tree, int link);  // the object moves with the link
  JointMotor& add_motor(Articulation& tree, int dof);
  void add_gear(Articulation& tree, const JointGear& gear) { mover_of(tree).gears.push_back(gear); }
  void add_stop(Articulation& tree, const JointStop& stop) { mover_of(tree).stops.push_back(stop); }
  void set_brakes(Articulation& tree, std::vector<SpeedBrake> brakes);  // until they are set anew
  Bond& add_bond(const Bond& bond);

  std::vector<Mover>& all() { return movers_; }
  const std::vector<Mover>& all() const { return movers_; }
  Mover& operator[](int mover) { return movers_[static_cast<std::size_t>(mover)]; }
  const Mover& operator[](int mover) const { return movers_[static_cast<std::size_t>(mover)]; }
  std::deque<Bond>& bonds() { return bonds_; }
  const std::deque<Bond>& bonds() const { return bonds_; }

  bool asleep(const MoverLink& node) const { return node.mover >= 0 && (*this)[node.mover].asleep; }
  // On a joint: the first link of a floating tree is as free as a free body.
  bool on_link(const MoverLink& node) const {
    return node.link > 0 || (node.link == 0 && !(*this)[node.mover].tree->floating());
  }
  bool bonded(const btCollisionObject& one, const btCollisionObject& other) const;
  bool holds_in(const Bond& bond, int island) const;

 private:
  Mover& mover_of(const Articulation& tree);
  std::deque<FreeBody> free_;  // deques: what they hold stays where it is
  std::deque<Articulation> trees_;
  std::deque<JointMotor> motors_;
  std::deque<Bond> bonds_;
  std::deque<MoverLink> links_;
  std::vector<Mover> movers_;
};

}  // namespace stampede
