#include "engine/sim/anchors.h"

#include <btBulletCollisionCommon.h>

namespace stampede {

void AnchorNormals::before_step(const btCollisionWorld& world) {
  const auto& objects = world.getCollisionObjectArray();
  before_.resize(static_cast<std::size_t>(objects.size()));
  for (int i = 0; i < objects.size(); ++i)
    before_[static_cast<std::size_t>(i)] = objects[i]->getWorldTransform().getBasis();
}

void AnchorNormals::after_step(btCollisionDispatcher& dispatcher) {
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    const int count = manifold.getNumContacts();
    if (count == 0 || (manifold.getContactPoint(0).m_contactPointFlags & BT_CONTACT_FLAG_FRICTION_ANCHOR) == 0)
      continue;
    const btCollisionObject& body = *manifold.getBody0();
    const btMatrix3x3& before = before_[static_cast<std::size_t>(body.getWorldArrayIndex())];
    if (body.getWorldTransform().getBasis() == before) continue;
    const btMatrix3x3 turn = body.getWorldTransform().getBasis() * before.transpose();
    for (int p = 0; p < count; ++p) {
      btManifoldPoint& point = manifold.getContactPoint(p);
      point.m_normalWorldOnB = (turn * point.m_normalWorldOnB).normalized();
      point.m_lateralFrictionDir1 = turn * point.m_lateralFrictionDir1;
      point.m_lateralFrictionDir2 = turn * point.m_lateralFrictionDir2;
    }
  }
}

}  // namespace stampede
