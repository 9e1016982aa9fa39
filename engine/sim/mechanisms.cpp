// Joints of furniture: friction, damping, return springs, detents, latches and couplings.
#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/sim/impl.h"

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

}  // namespace

// What the joint alone would have to accelerate, in the start pose: for implicit damping only.
static double inertia_of(const World::Impl& impl, PartRef ref) {
  const Body& body = impl.body(ref.body);
  const Transform& joint = impl.world_from_part(ref);
  const Part& mover = impl.part(ref);
  const Vector3 axis = joint.linear() * mover.joint.axis.normalized();
  double sum = 0;
  for (int p = ref.part; p < static_cast<int>(body.parts.size()); ++p) {
    if (!descends_from(body, p, ref.part)) continue;
    const Part& part = impl.part({ref.body, p});
    if (!(part.mass > 0)) continue;
    const Transform& pose = impl.world_from_part({ref.body, p});
    const Vector3 arm = (pose * part.centre_of_mass - joint.translation()).cross(axis);
    const Vector3 local_axis = pose.linear().transpose() * axis;
    const double lead = lead_of(mover.joint);
    sum += mover.joint.kind == JointKind::slider
               ? part.mass
               : local_axis.dot(part.inertia * local_axis) + part.mass * (arm.squaredNorm() + lead * lead);
  }
  return sum;
}

void World::Impl::build_mechanisms() {
  const auto add_motor = [&](const Mechanism& mechanism) {
    return &dynamics.add_motor(*mechanism.tree, static_cast<int>(mechanism.dof));
  };
  for (int index = 0; index < static_cast<int>(scene->bodies.size()); ++index) {
    const Body& description = body(index);
    for (int p = 0; p < static_cast<int>(description.parts.size()); ++p) {
      const PartSlot& here = slot({index, p});
      if (here.dof < 0) continue;
      const Joint& joint = part({index, p}).joint;
      Mechanism mechanism;
      mechanism.part = {index, p};
      mechanism.tree = here.tree;
      mechanism.dof = static_cast<std::size_t>(here.dof);
      mechanism.inertia = inertia_of(*this, mechanism.part);
      mechanism.brake = add_motor(mechanism);
      if (joint.spring_force > 0 || joint.detent > 0) {
        mechanism.spring = add_motor(mechanism);
        mechanism.spring->erp = kSpringErp;
        mechanism.spring->position_gain = 1;
        mechanism.spring->fastest = kSpringSpeed;
      }
      const auto joint_named = [&](const std::string& name, const std::string& what) {
        for (int other = static_cast<int>(description.parts.size()) - 1; other >= 0; --other) {
          const Part& candidate = part({index, other});
          if (other != p && slot({index, other}).dof >= 0 && (candidate.joint.name == name || candidate.name == name))
            return other;
        }
        throw Error(description.name, "the " + what + " of '" + joint.name + "' names no joint '" + name + "'",
                    "name another moving joint of the same object");
      };
      if (joint.stiffness * dt * dt > kStiffest * mechanism.inertia)
        throw Error(description.name, "the stiffness of '" + joint.name + "' is too great for what it moves",
                    "at most " + std::to_string(kStiffest * mechanism.inertia / (dt * dt)) + ", or more mass");
      if (!joint.follows.empty()) {
        const int leader = joint_named(joint.follows, "coupling");
        dynamics.add_gear(*here.tree, {here.dof, slot({index, leader}).dof, kFollowErp, kLockForce, joint.follow_ratio,
                                       joint.follow_offset});
      }
      if (!joint.latch_key.empty()) {
        const int key = joint_named(joint.latch_key, "latch");
        mechanism.key_dof = slot({index, key}).dof;
        mechanism.key_initial = part({index, key}).joint.initial;
        mechanism.relock_below = std::max(joint.latch_close, joint.lower + kRelockRange * (joint.upper - joint.lower));
        mechanism.locked = joint.initial <= mechanism.relock_below;
      }
      mechanisms.push_back(mechanism);
    }
  }
}

void World::Impl::move_mechanisms() {
  for (Mechanism& mechanism : mechanisms) {
    const Joint& joint = part(mechanism.part).joint;
    const double q = mechanism.tree->position[mechanism.dof];
    const double v = mechanism.tree->velocity[mechanism.dof];
    if (mechanism.key_dof >= 0) {
      const double key = mechanism.tree->position[static_cast<std::size_t>(mechanism.key_dof)];
      const double turned = (key - mechanism.key_initial) / (joint.latch_open - mechanism.key_initial);  // 1: opens
      if (mechanism.locked && turned >= 1)
        mechanism.locked = false;
      else if (!mechanism.locked && turned <= kKeyBack && q <= mechanism.relock_below)
        mechanism.locked = true;
    }
    mechanism.brake->erp = kLockErp;
    mechanism.brake->position = joint.lower;
    mechanism.brake->position_gain = mechanism.locked ? 1 : 0;
    mechanism.brake->most_force = mechanism.locked ? kLockForce : joint.friction;
    mechanism.torque = -joint.stiffness * (q - joint.spring_target);
    if (joint.damping > 0)  // implicit: the speed at the end of the step is what is damped
      mechanism.torque -= joint.damping * v / (1 + dt * joint.damping / mechanism.inertia);
    mechanism.tree->torque[mechanism.dof] += mechanism.torque;
    if (mechanism.spring) {
      const double nearest = q < (joint.lower + joint.upper) / 2 ? joint.lower : joint.upper;
      const bool detent = joint.detent > 0;
      mechanism.spring->position = detent ? nearest : joint.spring_target;
      mechanism.spring->most_force = detent ? joint.detent : joint.spring_force;
    }
  }
}

}  // namespace stampede
