// What a World is made of. Private to engine/sim; the only header here that shows Bullet's world.
#pragma once

#include <btBulletCollisionCommon.h>

#include <set>

#include "engine/sim/anchors.h"
#include "engine/sim/arm_dynamics.h"
#include "engine/sim/bullet_convert.h"
#include "engine/sim/collision_model.h"
#include "engine/sim/command_log.h"
#include "engine/sim/contacts.h"
#include "engine/sim/dynamics.h"
#include "engine/sim/servo.h"
#include "engine/sim/shapes.h"
#include "engine/sim/world.h"

namespace stampede {

constexpr int kRobot = -1;

enum class Role { still, moving, free, pad };  // of a part

// Where a part lives.
struct PartSlot {
  btCollisionObject* object = nullptr;  // its frame is the link's: centre of mass, principal axes
  Transform link_from_part = Transform::Identity();
  Articulation* tree = nullptr;  // null: it stands still, or is free
  int link = -1;                 // of the tree
  int dof = -1;                  // of the tree, where the part itself moves on a hinge or slider
};

struct BodySlot {
  std::vector<PartSlot> parts;
  Articulation* tree = nullptr;  // null: nothing of it moves on a joint
  FreeBody* free = nullptr;      // the one part of a free body; with more parts it is a floating tree
  Bond* bond = nullptr;          // by which the free body is joined to another

  bool floats() const { return tree != nullptr && tree->floating(); }
};

// A joint of furniture with what acts on it. All of it is a function of joint positions and `locked`.
struct Mechanism {
  PartRef part;
  Articulation* tree = nullptr;
  std::size_t dof = 0;
  double inertia = 1;            // that one joint feels at the start, kg or kg m^2
  JointMotor* brake = nullptr;   // friction, and the lock of a latch
  JointMotor* spring = nullptr;  // return spring or detent
  int key_dof = -1;              // of the latch; -1: none
  double key_initial = 0;
  double relock_below = 0;
  bool locked = false;
  double torque = 0;  // given in this step
};

// Pairs that Bullet need not look at: parts of one body, but for links of a robot that can meet; static with static.
struct PairFilter final : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
  std::set<std::pair<int, int>> links;  // of the robot
};

// Links are near each other all the time, in the eyes of boxes along the axes: most are told apart here, cheaply.
struct Dispatcher final : btCollisionDispatcher {
  explicit Dispatcher(btCollisionConfiguration* configuration) : btCollisionDispatcher(configuration) {
    setNearCallback(look_at);
  }
  btPersistentManifold* getNewManifold(const btCollisionObject* one, const btCollisionObject* other) override;
  static void look_at(btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo& info);
  bool apart(const btCollisionObject& one, const btCollisionObject& other) const;
  struct Piece {
    Convex convex;
    Transform object_from_shape;
  };
  std::vector<std::vector<Piece>> links;  // per part of the robot
};

// The arm's reference: a trajectory since the step at which it was given, what a servo makes of it, or a set-point.
struct Reference {
  std::shared_ptr<const Trajectory> trajectory;
  std::int64_t start_step = 0;
  JointState setpoint;
  std::optional<operation::Servo> servo = {};
  Stream stream = {};  // of a servo's positions
  double pace = 1;     // of a servo: the share of its speeds that what lies ahead allows
};

struct World::Impl {
  explicit Impl(std::shared_ptr<const Scene> scene_in);
  ~Impl();

  // build_bodies.cpp
  void build();
  void build_free(int body);
  void build_jointed(int body);
  void join(int body, const Transform& part_from_link);
  btCollisionObject& add_object(PartRef ref, const Transform& link_from_part, Role role);
  void build_robot_motors();
  void let_links_meet();
  void build_mechanisms();

  // controllers.cpp
  void control();
  void serve(const operation::Servo& servo);
  JointState served(const JointState& now, std::int64_t step, const Guard& guard, Limits& noted) const;
  JointState reference_at(std::int64_t step) const;
  bool under_torque() const { return reference.servo && reference.servo->of == operation::Servo::Of::torque; }
  void control_torque(const JointVector& asked);
  void control_position(const JointState& now, const JointState& next);
  void control_joint_impedance(const JointState& next);
  void control_cartesian_impedance(const JointState& next);
  void give_torques(JointVector torque);
  JointVector kept_safe(const JointVector& acceleration, double margin);
  std::vector<SpeedBrake> speed_brakes() const;
  JointVector held_back(const JointVector& acceleration);
  double load_mass() const;
  Vector3 lever(std::size_t joint, const Vector3& point) const;
  bool moves(std::size_t joint, PartRef link) const;
  Vector3 motion_of(PartRef link, const Vector3& point, const JointVector& change) const;
  std::vector<double> contact_levers() const;
  void update_dynamics();
  void control_hand();

  // approach.cpp
  void look_ahead();
  std::vector<JointVector> way_to_a_stand(double pace, std::int64_t led) const;
  bool meets(PartRef own, PartRef other, std::optional<int> held) const;
  bool presses(const std::vector<JointVector>& way, std::optional<int> held) const;
  CollisionState now_for_planning() const;  // world.cpp

  // mechanisms.cpp
  void move_mechanisms();

  // snapshot.cpp
  void canonicalise();
  void rebuild_broadphase();
  void place(int body, const Transform& world_from_body);
  void forget_pairs(int body);
  std::vector<double> state() const;
  void set_state(const std::vector<double>& state);

  const Body& body(int index) const;
  const Part& part(PartRef ref) const;
  const PartSlot& slot(PartRef ref) const;
  BodySlot& body_slot(int index) { return bodies[static_cast<std::size_t>(index + 1)]; }
  const BodySlot& body_slot(int index) const { return bodies[static_cast<std::size_t>(index + 1)]; }
  const Transform& world_from_part(PartRef ref) const;
  Vector3 velocity(PartRef ref, Vector3* linear) const;  // angular; linear of the centre of mass
  double position(PartRef ref) const;
  void check_robot(int robot) const;  // throws Error for an index that the scene does not have
  bool strained() const;
  void keep_within_stops();
  JointVector arm_position_now() const;
  JointVector arm_velocity_now() const;
  void read_efforts();
  void after_step();

  std::shared_ptr<const Scene> scene;
  Arm arm;
  double dt = 1.0 / 240;

  // Order matters: destroyed from the bottom up, Bullet's world before what it points to.
  ShapeStore shapes;
  PairFilter filter;
  btDefaultCollisionConfiguration configuration;
  Dispatcher dispatcher;
  btDbvtBroadphase broadphase;
  btCollisionWorld world;
  std::vector<std::unique_ptr<btCollisionObject>> objects;  // in creation order: Bullet sorts pairs by it
  Dynamics dynamics;

  std::vector<BodySlot> bodies;  // the robot first, then the scene's
  std::vector<Mechanism> mechanisms;
  std::vector<JointMotor*> arm_motors, finger_motors;  // their dofs are those of the joints
  ArmDynamics arm_dynamics;

  std::int64_t steps = 0;
  operation::Controller controller;
  operation::Hand hand;
  std::int64_t hand_step = 0;      // when it was given
  std::int64_t boundary_step = 0;  // of the last boundary: contact points have to be found again after it
  Reference reference;
  JointState reference_now;  // of `steps`
  AnchorNormals anchors;
  ContactWindow contacts;
  Limits acted;                              // since they were last forgotten
  JointVector arm_torque;                    // given by the controller in the last step
  JointVector foreseen;                      // velocity after the last step, had the arm met nothing; may be empty
  std::vector<std::vector<double>> efforts;  // body + 1, part
  bool canonical = false;                    // nothing moved since the last boundary
  CommandLog log;
  bool keeps_log = true;

  mutable std::shared_ptr<const CollisionModel> collision_model;  // made when first asked for
  mutable std::vector<std::vector<Transform>> poses;              // body + 1, part
  mutable std::vector<std::vector<std::int64_t>> pose_stamps;
  std::int64_t stamp = 1;  // poses with another one are stale
};

}  // namespace stampede
