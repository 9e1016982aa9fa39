// Rays through the simulated world: what a range finder would meet.
#include "engine/sim/bullet_convert.h"
#include "engine/sim/impl.h"

namespace stampede {

std::optional<RayHit> World::ray(const Vector3& from, const Vector3& to) const {
  btCollisionWorld::ClosestRayResultCallback nearest(to_bullet(from), to_bullet(to));
  impl_->finder.world.rayTest(nearest.m_rayFromWorld, nearest.m_rayToWorld, nearest);
  if (!nearest.hasHit()) return std::nullopt;
  const btCollisionObject& object = *nearest.m_collisionObject;
  return RayHit{{object.getUserIndex(), object.getUserIndex2()}, nearest.m_closestHitFraction * (to - from).norm()};
}

}  // namespace stampede
