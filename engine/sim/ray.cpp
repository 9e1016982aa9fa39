// Rays through the simulated world: what a range finder would meet.
#include "engine/sim/impl.h"

namespace stampede {
namespace {

struct Nearest : btCollisionWorld::ClosestRayResultCallback {
  using ClosestRayResultCallback::ClosestRayResultCallback;
  bool needsCollision(btBroadphaseProxy* proxy) const override {
    return static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex3() == 1;  // it collides
  }
};

}  // namespace

std::optional<RayHit> World::ray(const Vector3& from, const Vector3& to) const {
  Nearest nearest(to_bullet(from), to_bullet(to));
  impl_->world.rayTest(nearest.m_rayFromWorld, nearest.m_rayToWorld, nearest);
  if (!nearest.hasHit()) return std::nullopt;
  const btCollisionObject& object = *nearest.m_collisionObject;
  return RayHit{{object.getUserIndex(), object.getUserIndex2()}, nearest.m_closestHitFraction * (to - from).norm()};
}

}  // namespace stampede
