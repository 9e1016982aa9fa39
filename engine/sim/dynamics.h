// Makes bodies move: forces, joints and contacts, one step of semi-implicit Euler at a time. Bullet finds the contacts.
//
// Contacts and joints are rows of velocity constraints, solved by projected Gauss-Seidel as in Bullet's own solvers
// (Catto, Iterative Dynamics with Temporal Coherence, GDC 2005; Coumans, Bullet 3), with which its settings are shared.
// What differs, all for speed: every tree's mass matrix is inverted once a step and shared by its rows; a tree whose
// joints are all driven starts at the speeds that its motors ask for; contacts start with the impulses of the step
// before; and bodies that touch each other are iterated until nothing changes any more, each such island for itself.
//
// An island that has been at rest for a while sleeps: it keeps its contacts and their impulses, and costs nothing. What
// meets a sleeper wakes all that lies together with it.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/sim/articulation.h"
#include "engine/sim/solve_rows.h"

class btCollisionObject;
class btCollisionWorld;
class btManifoldPoint;
struct btBroadphasePair;
template <typename T>
class btAlignedObjectArray;
class btPersistentManifold;

namespace stampede {

// Points of contact further apart than this, m, or that slid so far, are forgotten: a fiftieth of the smaller shape, as
// in Bullet; but those of a robot not within 2 mm, for Bullet tells of boxes only once they lie in each other, and one
// step without any would free what a hand presses. (So far the edge of a hole would be remembered, too.)
double contact_margin(const btCollisionObject& one, const btCollisionObject& other);

// A body without joints. Its object's frame: centre of mass and principal axes.
struct FreeBody {
  btCollisionObject* object = nullptr;
  double mass = 1;
  Vector3 moments = Vector3::Ones();
  Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();  // velocities, world, m/s and rad/s
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

// A joint between a free body and something else, which lets go of the body at a limit.
struct Bond {
  const btCollisionObject* on = nullptr;
  FreeBody* body = nullptr;
  Transform on_from_joint = Transform::Identity(), body_from_joint = Transform::Identity();  // of the objects' frames
  JointKind kind = JointKind::hinge;
  Vector3 axis = Vector3::UnitZ();  // unit, in the joint's frame
  double lead = 0;                  // of a screw, m/rad
  double lower = 0, upper = 0;      // stops, where they differ
  double friction = 0;              // N or N m
  double lets_go = 0;
  bool upwards = true;  // it is passed from below
  // What tells one moment from another.
  bool holds = true;
  double position = 0;  // m or rad; stays when it has let go
};

class Dynamics {
 public:
  Dynamics(btCollisionWorld& world, const Vector3& gravity, double dt) : world_(world), gravity_(gravity), dt_(dt) {}

  // In the order in which they are added. References stay valid.
  FreeBody& add_free(const FreeBody& body);
  Articulation& add_tree(const Transform& world_from_base, bool floating, bool may_sleep);
  void add_object(btCollisionObject& object, Articulation& tree, int link);  // the object moves with the link
  JointMotor& add_motor(Articulation& tree, int dof);
  void add_gear(Articulation& tree, const JointGear& gear);
  void set_brakes(Articulation& tree, std::vector<SpeedBrake> brakes);  // until they are set anew
  void add_stop(Articulation& tree, const JointStop& stop);
  Bond& add_bond(const Bond& bond);
  void place_bond(Bond& bond);  // puts the body where the joint at its position has it

  void step(int iterations);  // at most so many where a robot takes part

  // Whoever moves a body himself wakes it first, and all that lies together with it.
  void wake(const btCollisionObject& object);
  void let_sleep(bool sleep);  // false: all wake, and stay so
  // Where contacts are dropped: all wake; who slept may sleep again as soon as contacts are found anew.
  void forget_contacts();
  // How long each mover has been at rest: all that tells one moment from another beside positions and velocities, right
  // after `forget_contacts`.
  struct Rest {
    int rest = 0;                                                           // steps
    Vector3 mean_linear = Vector3::Zero(), mean_angular = Vector3::Zero();  // velocities of a free body, smoothed
  };
  std::vector<Rest> rest() const;
  void set_rest(const std::vector<Rest>& rest);

  // What rolling and spinning friction did in the last step: contact points leave that out.
  struct Torsion {
    const btCollisionObject *on, *other;
    Vector3 impulse;  // angular, world, on `on`; the other got the opposite
  };
  const std::vector<Torsion>& torsions() const { return torsions_; }

 private:
  struct Mover : Rest {  // what moves as one: a free body or a tree
    FreeBody* free = nullptr;
    Articulation* tree = nullptr;
    int at = 0, quads = 0;  // its part of velocities_
    int island = 0;         // the first of all movers that it touches, over others too
    bool may_sleep = true, asleep = false;
    Matrix3 inverse_inertia = Matrix3::Zero();  // of a free body, world axes
    std::vector<btCollisionObject*> objects;
    std::vector<JointMotor*> motors;
    std::vector<JointGear> gears;
    std::vector<JointStop> stops;
    std::vector<SpeedBrake> brakes;
  };
  struct Node {  // what an object belongs to; nothing: it stands still
    int mover = -1, link = -1;
  };
  struct Touched {
    btManifoldPoint* point = nullptr;
    const btCollisionObject *first = nullptr, *second = nullptr;
  };
  struct Touching {
    int island = 0;
    int first = 0, second = 0;  // objects of the world
    btPersistentManifold* manifold = nullptr;
    bool on_link = false;
    int points = 0;      // of all manifolds of these two
    bool narrow = true;  // all points of these two lie along a line: nothing else resists turning about it
  };
  struct Island {
    int number = 0;
    int touching_begin = 0, touching_end = 0;
  };
  struct Bounds {                           // of contacts
    double impulse = 1e10, parting = 1e30;  // N s; m/s, of what lies in each other
  };
  struct Motion {                     // of free bodies
    double energy = 0, momentum = 0;  // J; N s, with what a step presses into them
    double mass = 0;                  // kg
  };

  static Node node_of(const btCollisionObject* object);
  Mover& mover_of(const Articulation& tree);
  bool asleep(const Node& node) const {
    return node.mover >= 0 && movers_[static_cast<std::size_t>(node.mover)].asleep;
  }
  bool holds_in(const Bond& bond, int island) const {
    return bond.holds && movers_[static_cast<std::size_t>(node_of(bond.body->object).mover)].island == island;
  }
  void set_asleep(Mover& mover, bool asleep);
  Vector3 velocity_at(const Node& node, const Vector3& point) const;
  bool meet(const btPersistentManifold& manifold) const;
  void wake_what_is_met();
  void wake_with_neighbours(int mover);
  static bool at_rest(const Mover& mover);
  static bool slower(const Mover& mover, double than);  // so many times the speed of rest
  static std::optional<std::pair<Vector3, Vector3>> free_twist(const Mover& mover);
  bool on_link(const Node& node) const;
  // bonds.cpp
  bool bonded(const btCollisionObject& one, const btCollisionObject& other) const;
  void add_bond_rows(const Bond& bond);
  void move_bonds();
  // encounters.cpp
  struct Side;
  Side side_of(btCollisionObject& object) const;
  void hold_up(Side& one, Side& other, const btAlignedObjectArray<btPersistentManifold*>& manifolds) const;
  void meet_ahead(btBroadphasePair& pair, double way);
  void find_encounters();
  void forget_encounters();
  void fall_asleep();
  void apply_forces();
  void find_touching();
  void solve_island(const Island& island, int iterations);
  Motion free_motion(const Island& island) const;
  void slow_down(const Island& island, double share);
  void take_no_energy(const Island& island, const Motion& before);
  void add_contacts(const Touching& touching, double kept, const Bounds& bounds);
  void add_joints(const Mover& mover);
  void start_motors(const Mover& mover, std::size_t first);
  SolverRow& begin_row(std::vector<SolverRow>& rows);
  double* add_side(SolverRow& row, const Mover& mover);
  double* tree_side(SolverRow& row, const Mover& mover);
  void add_free_side(SolverRow& row, const Mover& mover, const Vector3& linear, const Vector3& angular);
  void add_point(SolverRow& row, const Node& node, const Vector3& point, const Vector3& direction);
  void add_turn(SolverRow& row, const Node& node, const Vector3& direction);
  void add_screw(SolverRow& row, const Node& node, const Vector3& point, const Vector3& linear, const Vector3& angular);
  void start(SolverRow& row, double impulse);
  static void respond(const Articulation& tree, double* jacobian);
  void end_row(SolverRow& row, double target);
  void keep_results();
  void move();

  btCollisionWorld& world_;
  Vector3 gravity_;
  double dt_;
  bool sleep_ = true;
  std::deque<FreeBody> free_;  // deques: what they hold stays where it is
  std::deque<Articulation> trees_;
  std::deque<JointMotor> motors_;
  std::deque<Bond> bonds_;
  std::deque<Node> nodes_;
  std::vector<Mover> movers_;

  std::vector<Quad> velocities_, untouched_;                          // now; by forces alone, before any contact
  std::vector<double> fast_;                                          // m that a free body gets in a step
  std::vector<std::pair<btPersistentManifold*, double>> encounters_;  // with their usual margins, m
  std::vector<Touching> touching_;
  std::vector<Island> islands_;
  std::vector<int> waking_, least_rest_;
  std::vector<Vector3> points_;
  std::vector<Torsion> torsions_;
  // Of the island that is being solved.
  std::vector<Quad> numbers_;
  std::vector<SolverRow> joints_, rows_;
  std::vector<std::pair<int, JointMotor*>> motor_rows_;
  std::vector<SolverContact> contacts_;
  double parting_ = 0;            // m/s, the most that a contact asks of what lies in each other
  std::vector<Touched> touched_;  // of the contacts
  std::vector<double> scratch_;
  SolveRows solve_rows_ = fastest_solve_rows();
};

}  // namespace stampede
