#include "engine/sim/mechanisms.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace stampede {
namespace {

constexpr double kSpringErp = 0.1;
constexpr double kSpringSpeed = 0.3;  // m/s or rad/s at most
constexpr double kLockForce = 500;    // N or N m
constexpr double kLockErp = 0.2;
constexpr double kKeyBack = 0.6;  // of the way from its rest to latch_open: hysteresis of the key
constexpr double kFollowErp = 0.2;
constexpr double kStiffest = 0.5;      // of inertia / dt^2: a spring beyond it would shake what it carries
constexpr double kRelockRange = 0.01;  // of the joint's range, where latch_close says nothing

bool descends_from(const Body& body, int part, int ancestor) {
  for (int at = part; at >= 0; at = body.parts[static_cast<std::size_t>(at)].parent)
    if (at == ancestor) return true;
  return false;
}

// What the joint alone would have to accelerate, in the start pose: for implicit damping only.
double inertia_of(const Bodies& bodies, PartRef ref) {
  const Body& body = bodies.body(ref.body);
  const Transform& joint = bodies.world_from_part(ref);
  const Part& mover = bodies.part(ref);
  const Vector3 axis = joint.linear() * mover.joint.axis.normalized();
  double sum = 0;
  for (int p = ref.part; p < static_cast<int>(body.parts.size()); ++p) {
    if (!descends_from(body, p, ref.part)) continue;
    const Part& part = bodies.part({ref.body, p});
    if (!(part.mass > 0)) continue;
    const Transform& pose = bodies.world_from_part({ref.body, p});
    const Vector3 arm = (pose * part.centre_of_mass - joint.translation()).cross(axis);
    const Vector3 local_axis = pose.linear().transpose() * axis;
    const double lead = lead_of(mover.joint);
    sum += mover.joint.kind == JointKind::slider
               ? part.mass
               : local_axis.dot(part.inertia * local_axis) + part.mass * (arm.squaredNorm() + lead * lead);
  }
  return sum;
}

// Another moving joint of the same body; `what` asks for it.
int joint_named(const Bodies& bodies, PartRef asking, const std::string& name, const std::string& what) {
  const Body& description = bodies.body(asking.body);
  for (int other = static_cast<int>(description.parts.size()) - 1; other >= 0; --other) {
    const Part& candidate = bodies.part({asking.body, other});
    if (other != asking.part && bodies.slot({asking.body, other}).dof >= 0 &&
        (candidate.joint.name == name || candidate.name == name))
      return other;
  }
  throw Error(description.name,
              "the " + what + " of '" + bodies.part(asking).joint.name + "' names no joint '" + name + "'",
              "name another moving joint of the same object");
}

Mechanism build_mechanism(const Bodies& bodies, PartRef ref, Movers& movers, double dt) {
  const PartSlot& here = bodies.slot(ref);
  const Joint& joint = bodies.part(ref).joint;
  const auto dof_of = [&](int part) { return bodies.slot({ref.body, part}).dof; };
  Mechanism mechanism;
  mechanism.part = ref;
  mechanism.tree = here.tree;
  mechanism.dof = static_cast<std::size_t>(here.dof);
  mechanism.inertia = inertia_of(bodies, ref);
  mechanism.brake = &movers.add_motor(*here.tree, here.dof);
  if (joint.spring_force > 0 || joint.detent > 0) {
    mechanism.spring = &movers.add_motor(*here.tree, here.dof);
    mechanism.spring->erp = kSpringErp;
    mechanism.spring->position_gain = 1;
    mechanism.spring->fastest = kSpringSpeed;
  }
  if (joint.stiffness * dt * dt > kStiffest * mechanism.inertia)
    throw Error(bodies.body(ref.body).name, "the stiffness of '" + joint.name + "' is too great for what it moves",
                "at most " + std::to_string(kStiffest * mechanism.inertia / (dt * dt)) + ", or more mass");
  if (!joint.follows.empty()) {
    const int leader = joint_named(bodies, ref, joint.follows, "coupling");
    movers.add_gear(*here.tree,
                    {here.dof, dof_of(leader), kFollowErp, kLockForce, joint.follow_ratio, joint.follow_offset});
  }
  if (!joint.latch_key.empty()) {
    const int key = joint_named(bodies, ref, joint.latch_key, "latch");
    mechanism.key_dof = dof_of(key);
    mechanism.key_initial = bodies.part({ref.body, key}).joint.initial;
    mechanism.relock_below = std::max(joint.latch_close, joint.lower + kRelockRange * (joint.upper - joint.lower));
    mechanism.locked = joint.initial <= mechanism.relock_below;
  }
  return mechanism;
}

}  // namespace

std::vector<Mechanism> build_mechanisms(const Bodies& bodies, Movers& movers, double dt) {
  std::vector<Mechanism> mechanisms;
  for (int index = 0; index < bodies.count(); ++index)
    for (int p = 0; p < static_cast<int>(bodies.body(index).parts.size()); ++p)
      if (bodies.slot({index, p}).dof >= 0) mechanisms.push_back(build_mechanism(bodies, {index, p}, movers, dt));
  return mechanisms;
}

void Mechanism::turn_lock(const Joint& joint) {
  if (key_dof < 0) return;
  const double key = tree->position[static_cast<std::size_t>(key_dof)];
  const double turned = (key - key_initial) / (joint.latch_open - key_initial);  // 1: opens
  if (locked && turned >= 1)
    locked = false;
  else if (!locked && turned <= kKeyBack && tree->position[dof] <= relock_below)
    locked = true;
}

void Mechanism::give_forces(const Joint& joint, double dt) {
  const double q = tree->position[dof], v = tree->velocity[dof];
  brake->erp = kLockErp;
  brake->position = joint.lower;
  brake->position_gain = locked ? 1 : 0;
  brake->most_force = locked ? kLockForce : joint.friction;
  torque = -joint.stiffness * (q - joint.spring_target);
  if (joint.damping > 0)  // implicit: the speed at the end of the step is what is damped
    torque -= joint.damping * v / (1 + dt * joint.damping / inertia);
  tree->torque[dof] += torque;
  if (!spring) return;
  const double nearest = q < (joint.lower + joint.upper) / 2 ? joint.lower : joint.upper;
  const bool detent = joint.detent > 0;
  spring->position = detent ? nearest : joint.spring_target;
  spring->most_force = detent ? joint.detent : joint.spring_force;
}

}  // namespace stampede
