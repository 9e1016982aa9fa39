// What a World is made of. Private to engine/sim; the only header here that shows Bullet's dynamics.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyGearConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>

#include "engine/sim/anchors.h"
#include "engine/sim/arm_dynamics.h"
#include "engine/sim/bullet_convert.h"
#include "engine/sim/collision_model.h"
#include "engine/sim/contacts.h"
#include "engine/sim/shapes.h"
#include "engine/sim/torsion_solver.h"
#include "engine/sim/world.h"

namespace stampede {

constexpr int kRobot = -1;

// Where a part lives in Bullet. Static parts and free bodies are rigid bodies; moving parts are links.
struct PartSlot {
  btCollisionObject* object = nullptr;  // its frame is the link's: centre of mass, principal axes
  Transform link_from_part = Transform::Identity();
  btMultiBody* multibody = nullptr;  // null: rigid
  int link = -1;                     // of multibody
  bool driven_by_joint = false;      // the part itself moves on a hinge or slider
};

struct BodySlot {
  std::vector<PartSlot> parts;
  btMultiBody* multibody = nullptr;  // null: nothing of it moves on a joint
  btRigidBody* free = nullptr;       // the one part of a free body
};

// A joint of furniture with what acts on it. All of it is a function of joint positions and `locked`.
struct Mechanism {
  PartRef part;
  btMultiBody* multibody = nullptr;
  int link = -1;
  double inertia = 1;                       // that one joint feels at the start, kg or kg m^2
  btMultiBodyJointMotor* brake = nullptr;   // friction, and the lock of a latch
  btMultiBodyJointMotor* spring = nullptr;  // return spring or detent
  int key_link = -1;                        // of the latch; -1: none
  double key_initial = 0;
  double relock_below = 0;
  bool locked = false;
  double torque = 0;  // given as addJointTorque in this step
};

// Pairs that Bullet need not look at: parts of one body, static with static, parts without shape.
struct PairFilter final : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
};

// The arm's reference: a trajectory since the step at which it was given, what a servo makes of it, or a set-point.
struct Reference {
  std::shared_ptr<const Trajectory> trajectory;
  std::int64_t start_step = 0;
  JointState setpoint;
  std::optional<operation::Servo> servo = {};
};

struct World::Impl {
  explicit Impl(std::shared_ptr<const Scene> scene_in);
  ~Impl();

  // build_bodies.cpp
  void build();
  void build_free(int body);
  void build_fixed(int body);
  void add_static_part(int body, int part, const Transform& world_from_part);
  void add_joint_constraints(int body, const std::vector<int>& host);
  void build_robot_motors();
  void build_mechanisms();

  // controllers.cpp
  void control();
  JointState reference_at(std::int64_t step) const;
  bool under_torque() const { return reference.servo && reference.servo->of == operation::Servo::Of::torque; }
  void control_torque(const JointVector& asked);
  void control_position(const JointState& now, const JointState& next);
  void control_joint_impedance(const JointState& next);
  void control_cartesian_impedance(const JointState& next);
  void give_torques(JointVector torque);
  void update_dynamics();
  void control_hand();

  // mechanisms.cpp
  void move_mechanisms();

  // snapshot.cpp
  void canonicalise();
  void rebuild_broadphase();
  void place(int body, const Transform& world_from_body);
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
  btCollisionDispatcher dispatcher;
  btDbvtBroadphase broadphase;
  TorsionSolver solver;
  btMultiBodyDynamicsWorld world;
  std::vector<std::unique_ptr<btCollisionObject>> objects;  // in creation order: Bullet sorts pairs by it
  std::vector<std::unique_ptr<btMultiBody>> multibodies;
  std::vector<std::unique_ptr<btMultiBodyConstraint>> constraints;
  btAlignedObjectArray<btQuaternion> scratch_rotations;
  btAlignedObjectArray<btVector3> scratch_origins;

  std::vector<BodySlot> bodies;  // the robot first, then the scene's
  std::vector<Mechanism> mechanisms;
  std::vector<btMultiBodyJointMotor*> arm_motors, finger_motors;
  std::vector<int> arm_links, finger_links;
  ArmDynamics dynamics;

  std::int64_t steps = 0;
  operation::Controller controller;
  operation::Hand hand;
  std::int64_t hand_step = 0;      // when it was given
  std::int64_t boundary_step = 0;  // of the last boundary: contact points have to be found again after it
  Reference reference;
  JointState reference_now;  // of `steps`
  AnchorNormals anchors;
  ContactWindow contacts;
  JointVector arm_torque;                    // given by the controller in the last step
  std::vector<std::vector<double>> efforts;  // body + 1, part
  bool canonical = false;                    // nothing moved since the last boundary
  std::vector<Command> log;
  bool keeps_log = true;

  mutable std::shared_ptr<const CollisionModel> collision_model;  // made when first asked for
  mutable std::vector<std::vector<Transform>> poses;              // body + 1, part
  mutable std::vector<std::vector<std::int64_t>> pose_stamps;
  std::int64_t stamp = 1;  // poses with another one are stale
};

}  // namespace stampede
