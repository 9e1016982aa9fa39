#include "engine/sim/contact_finder.h"

#include <algorithm>

#include "engine/sim/bullet_convert.h"

namespace stampede {
namespace {

// Bullet's own pools are 7 MB that each new world clears. A scene has some hundred pairs; more of them go to the heap.
btDefaultCollisionConstructionInfo small_pools() {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = info.m_defaultMaxCollisionAlgorithmPoolSize = 256;
  return info;
}

}  // namespace

bool PairFilter::needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  const auto* one = static_cast<const btCollisionObject*>(a->m_clientObject);
  const auto* two = static_cast<const btCollisionObject*>(b->m_clientObject);
  if (one->getUserIndex() == two->getUserIndex())
    return one->getUserIndex() == kRobot && links.contains(std::minmax({one->getUserIndex2(), two->getUserIndex2()}));
  return !(one->isStaticObject() && two->isStaticObject());
}

bool Dispatcher::apart(const btCollisionObject& one, const btCollisionObject& other) const {
  constexpr double kNear_m = 0.015;  // more than two links go towards each other in a step
  const Transform at_one = from_bullet(one.getWorldTransform()), at_other = from_bullet(other.getWorldTransform());
  for (const Piece& a : links[static_cast<std::size_t>(one.getUserIndex2())]) {
    const Transform at_a = product(at_one, a.object_from_shape);
    for (const Piece& b : links[static_cast<std::size_t>(other.getUserIndex2())])
      if (closer_than(a.convex, at_a, b.convex, product(at_other, b.object_from_shape), kNear_m)) return false;
  }
  return true;
}

double contact_margin(const btCollisionObject& one, const btCollisionObject& other) {
  const auto usual = [](const btCollisionObject& object) {
    return object.getCollisionShape()->getContactBreakingThreshold(gContactBreakingThreshold);
  };
  constexpr btScalar kOfRobot = 0.002;
  const bool of_robot = one.getUserIndex() == kRobot || other.getUserIndex() == kRobot;
  return std::max(of_robot ? kOfRobot : 0, std::min(usual(one), usual(other)));
}

btPersistentManifold* Dispatcher::getNewManifold(const btCollisionObject* one, const btCollisionObject* other) {
  btPersistentManifold* manifold = btCollisionDispatcher::getNewManifold(one, other);
  manifold->setContactBreakingThreshold(contact_margin(*one, *other));
  return manifold;
}

void Dispatcher::look_at(btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo& info) {
  const auto& one = *static_cast<const btCollisionObject*>(pair.m_pProxy0->m_clientObject);
  const auto& other = *static_cast<const btCollisionObject*>(pair.m_pProxy1->m_clientObject);
  const bool links = one.getUserIndex() == kRobot && other.getUserIndex() == kRobot;
  if (!links || !static_cast<const Dispatcher&>(dispatcher).apart(one, other))
    return defaultNearCallback(pair, dispatcher, info);
  if (pair.m_algorithm == nullptr) return;
  btManifoldArray manifolds;  // what they touched at when they were near must not outlive that
  pair.m_algorithm->getAllContactManifolds(manifolds);
  for (int i = 0; i < manifolds.size(); ++i) dispatcher.clearManifold(manifolds[i]);
}

ContactFinder::ContactFinder()
    : configuration(small_pools()), dispatcher(&configuration), world(&dispatcher, &broadphase, &configuration) {
  world.setForceUpdateAllAabbs(false);  // what stands still does
  broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
  world.getDispatchInfo().m_deterministicOverlappingPairs = true;  // else results depend on the broadphase's history
}

ContactFinder::~ContactFinder() {
  // Bullet's lists hold plain pointers: emptied before the owners let go.
  for (auto it = objects.rbegin(); it != objects.rend(); ++it)
    if ((*it)->getBroadphaseHandle()) world.removeCollisionObject(it->get());
}

void ContactFinder::rebuild() {
  btCollisionObjectArray& present = world.getCollisionObjectArray();
  std::vector<std::pair<int, int>> filters;
  for (int i = 0; i < present.size(); ++i) {
    btBroadphaseProxy* proxy = present[i]->getBroadphaseHandle();
    filters.emplace_back(proxy->m_collisionFilterGroup, proxy->m_collisionFilterMask);
    broadphase.getOverlappingPairCache()->cleanProxyFromPairs(proxy, &dispatcher);
    broadphase.destroyProxy(proxy, &dispatcher);
    present[i]->setBroadphaseHandle(nullptr);
  }
  broadphase.resetPool(&dispatcher);
  for (int i = 0; i < present.size(); ++i) {
    btCollisionObject* object = present[i];
    btVector3 lower, upper;
    object->getCollisionShape()->getAabb(object->getWorldTransform(), lower, upper);
    const auto& [group, mask] = filters[static_cast<std::size_t>(i)];
    object->setBroadphaseHandle(broadphase.createProxy(lower, upper, object->getCollisionShape()->getShapeType(),
                                                       object, group, mask, &dispatcher));
  }
}

void ContactFinder::forget_pairs(btCollisionObject& object) {
  if (!object.getBroadphaseHandle()) return;
  broadphase.getOverlappingPairCache()->cleanProxyFromPairs(object.getBroadphaseHandle(), &dispatcher);
  world.updateSingleAabb(&object);
}

}  // namespace stampede
