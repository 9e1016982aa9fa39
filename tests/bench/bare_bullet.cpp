#include "tests/bench/bare_bullet.h"

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyGearConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>

#include <vector>

#include "engine/sim/bullet_convert.h"
#include "engine/sim/shapes.h"

namespace stampede {

struct BareBullet::NotOneBody final : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
    const auto* one = static_cast<const btCollisionObject*>(a->m_clientObject);
    const auto* two = static_cast<const btCollisionObject*>(b->m_clientObject);
    return one->getUserIndex() != two->getUserIndex() && !(one->isStaticObject() && two->isStaticObject());
  }
};

struct BareBullet::Impl {
  explicit Impl(const Scene& scene_in) : scene(scene_in), world(&dispatcher, &broadphase, &solver, &configuration) {
    world.setGravity(to_bullet(scene.gravity));
    broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
    world.getSolverInfo().m_numIterations = 20;
    world.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const Body& body = scene.bodies[b];
      const Part& part = body.parts[0];
      const double mass = body.free ? part.mass : 0;
      const btVector3 moments = body.free ? to_bullet(Vector3(part.inertia.diagonal())) : btVector3(0, 0, 0);
      btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, make_part_shape(part, Transform::Identity(), shapes),
                                                    moments);
      info.m_startWorldTransform = to_bullet(body.world_from_body);
      rigid.push_back(std::make_unique<btRigidBody>(info));
      rigid.back()->setUserIndex(static_cast<int>(b));
      rigid.back()->setFriction(part.surface.friction);
      rigid.back()->setActivationState(DISABLE_DEACTIVATION);
      rigid.back()->setCollisionFlags(rigid.back()->getCollisionFlags() | btCollisionObject::CF_HAS_FRICTION_ANCHOR);
      world.addRigidBody(rigid.back().get());
    }
    build_robot();
  }

  ~Impl() {
    for (auto& constraint : constraints) world.removeMultiBodyConstraint(constraint.get());
    world.removeMultiBody(robot.get());
    for (auto& collider : colliders) world.removeCollisionObject(collider.get());
    for (auto& body : rigid) world.removeRigidBody(body.get());
  }

  // One link for each part of the robot, its frame at the centre of mass, with the part's axes.
  void build_robot() {
    const Body& body = scene.robot.body;
    const int links = static_cast<int>(body.parts.size()) - 1;
    robot = std::make_unique<btMultiBody>(links, 1.0, btVector3(1, 1, 1), true, false);
    robot->setBaseWorldTransform(to_bullet(body.world_from_body));
    for (int link = 0; link < links; ++link) {
      const Part& part = body.parts[static_cast<std::size_t>(link) + 1];
      const Part& parent = body.parts[static_cast<std::size_t>(part.parent)];
      const Transform& joint = part.joint.parent_from_joint;
      const btQuaternion turn = to_bullet(Quaternion(Matrix3(joint.linear().transpose())));
      const Vector3 from = part.parent == 0 ? Vector3(Vector3::Zero()) : parent.centre_of_mass;
      const btVector3 to_pivot = to_bullet(Vector3(joint.translation() - from));
      const btVector3 to_centre = to_bullet(part.centre_of_mass);
      const btVector3 axis = to_bullet(Vector3(part.joint.axis.normalized()));
      const double mass = std::max(part.mass, 1e-3);
      const btVector3 moments = to_bullet(Vector3(part.inertia.diagonal().cwiseMax(1e-6)));
      if (part.joint.kind == JointKind::hinge)
        robot->setupRevolute(link, mass, moments, part.parent - 1, turn, axis, to_pivot, to_centre, true);
      else if (part.joint.kind == JointKind::slider)
        robot->setupPrismatic(link, mass, moments, part.parent - 1, turn, axis, to_pivot, to_centre, true);
      else
        robot->setupFixed(link, mass, moments, part.parent - 1, turn, to_pivot, to_centre);
    }
    robot->finalizeMultiDof();
    robot->setLinearDamping(0);
    robot->setAngularDamping(0);
    robot->setHasSelfCollision(false);
    world.addMultiBody(robot.get());
    for (int link = 0; link < links; ++link) add_link(link);
    gear =
        add<btMultiBodyGearConstraint>(robot.get(), finger_links[0], robot.get(), finger_links[1], btVector3(0, 0, 0),
                                       btVector3(0, 0, 0), btMatrix3x3::getIdentity(), btMatrix3x3::getIdentity());
    gear->setGearRatio(-1);
    gear->setErp(0.2);
    gear->setMaxAppliedImpulse(50.0 / scene.physics_hz);
    gear->setRelativePositionTarget(0);
    gear->finalizeMultiDof();
    btAlignedObjectArray<btQuaternion> rotations;
    btAlignedObjectArray<btVector3> origins;
    robot->forwardKinematics(rotations, origins);
    robot->updateCollisionObjectWorldTransforms(rotations, origins);
  }

  void add_link(int link) {
    const Part& part = scene.robot.body.parts[static_cast<std::size_t>(link) + 1];
    auto collider = std::make_unique<btMultiBodyLinkCollider>(robot.get(), link);
    collider->setCollisionShape(make_part_shape(part, Transform(Eigen::Translation3d(-part.centre_of_mass)), shapes));
    collider->setUserIndex(-1);
    collider->setFriction(part.surface.friction);
    collider->setActivationState(DISABLE_DEACTIVATION);
    robot->getLink(link).m_collider = collider.get();
    world.addCollisionObject(collider.get(), 1, -1);
    colliders.push_back(std::move(collider));
    if (part.joint.kind == JointKind::fixed) return;
    robot->setJointPos(link, part.joint.initial);
    add<btMultiBodyJointLimitConstraint>(robot.get(), link, part.joint.lower, part.joint.upper);
    auto* motor = add<btMultiBodyJointMotor>(robot.get(), link, 0, 0);
    motor->setErp(0.2);
    (part.joint.kind == JointKind::hinge ? arm_motors : finger_motors).push_back(motor);
    if (part.joint.kind == JointKind::slider) finger_links.push_back(link);
  }

  template <typename Constraint, typename... Arguments>
  Constraint* add(Arguments&&... arguments) {
    auto constraint = std::make_unique<Constraint>(std::forward<Arguments>(arguments)...);
    Constraint* added = constraint.get();
    world.addMultiBodyConstraint(added);
    constraints.push_back(std::move(constraint));
    return added;
  }

  const Scene& scene;
  ShapeStore shapes;
  NotOneBody filter;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btMultiBodyConstraintSolver solver;
  btMultiBodyDynamicsWorld world;
  std::vector<std::unique_ptr<btRigidBody>> rigid;
  std::unique_ptr<btMultiBody> robot;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders;
  std::vector<std::unique_ptr<btMultiBodyConstraint>> constraints;
  std::vector<btMultiBodyJointMotor*> arm_motors, finger_motors;
  std::vector<int> finger_links;
  btMultiBodyGearConstraint* gear = nullptr;
};

BareBullet::BareBullet(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
BareBullet::~BareBullet() = default;

void BareBullet::step(const JointState& target) {
  const double dt = 1.0 / impl_->scene.physics_hz;
  for (std::size_t j = 0; j < impl_->arm_motors.size(); ++j) {
    btMultiBodyJointMotor& motor = *impl_->arm_motors[j];
    motor.setPositionTarget(target.position[static_cast<Eigen::Index>(j)], 1);
    motor.setVelocityTarget(target.velocity[static_cast<Eigen::Index>(j)], 1);
    motor.setMaxAppliedImpulse(impl_->scene.robot.limits[j].effort * dt);
  }
  for (btMultiBodyJointMotor* finger : impl_->finger_motors) {
    finger->setPositionTarget(0.04, 1);
    finger->setMaxAppliedImpulse(20 * dt);
  }
  impl_->world.stepSimulation(dt, 0);
}

}  // namespace stampede
