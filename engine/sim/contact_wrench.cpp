// What a tared wrist sensor reads, from what the solver applied in the last step.
#include "engine/base/error.h"
#include "engine/model/body_tree.h"
#include "engine/sim/bullet_convert.h"
#include "engine/sim/impl.h"

namespace stampede {
namespace {

struct Impulse {
  btVector3 force{0, 0, 0}, point{0, 0, 0};
};

// On the manifold's first body; its normals point there.
Impulse impulse_of(const btManifoldPoint& contact) {
  return {contact.m_normalWorldOnB * contact.m_appliedImpulse +
              contact.m_lateralFrictionDir1 * contact.m_appliedImpulseLateral1 +
              contact.m_lateralFrictionDir2 * contact.m_appliedImpulseLateral2,
          (contact.m_positionWorldOnA + contact.m_positionWorldOnB) / 2};
}

}  // namespace

Wrench World::contact_wrench(int robot_part) const {
  const Impl& w = *impl_;
  const Body& robot = w.scene->robot.body;
  if (robot_part < 0 || robot_part >= static_cast<int>(robot.parts.size()))
    throw Error("World::contact_wrench", "the robot has no part " + std::to_string(robot_part),
                "its parts are 0 … " + std::to_string(static_cast<int>(robot.parts.size()) - 1));
  const auto beyond = [&](const btCollisionObject& object) {
    return object.getUserIndex() == kRobot && hangs_on(robot, object.getUserIndex2(), robot_part);
  };
  const Transform& world_from_part = w.bodies.world_from_part({kRobot, robot_part});
  const btVector3 origin = to_bullet(Vector3(world_from_part.translation()));
  btVector3 force(0, 0, 0), torque(0, 0, 0);
  auto& dispatcher = const_cast<Dispatcher&>(w.finder.dispatcher);  // Bullet's readers are not const
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    const bool first = beyond(*manifold.getBody0()), second = beyond(*manifold.getBody1());
    if (first == second) continue;  // elsewhere, or between two parts of the hand
    const double sign = first ? 1 : -1;
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      if (!(manifold.getContactPoint(p).m_appliedImpulse > 0)) continue;
      const Impulse impulse = impulse_of(manifold.getContactPoint(p));
      force += sign * impulse.force;
      torque += sign * (impulse.point - origin).cross(impulse.force);
    }
  }
  for (const Torsion& torsion : w.dynamics.torsions()) {
    const bool first = beyond(*torsion.on), second = beyond(*torsion.other);
    if (first != second) torque += (first ? 1 : -1) * to_bullet(torsion.impulse);
  }
  const Matrix3 part_from_world = world_from_part.linear().transpose();
  return {part_from_world * from_bullet(force) / w.clock.dt, part_from_world * from_bullet(torque) / w.clock.dt};
}

}  // namespace stampede
