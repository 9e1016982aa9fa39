#include "engine/sim/contact_finder.h"

#include <BulletCollision/CollisionDispatch/btCompoundCompoundCollisionAlgorithm.h>

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

constexpr btScalar kPressed_m = 0.001;

int number_of(const btCollisionObject& object) { return object.getWorldArrayIndex(); }
bool is_robot(const btCollisionObject& object) { return object.getUserIndex() == kRobot; }
// Between two shapes of several pieces without trees, Bullet's own list lacks all of them.
void list_manifolds(btCollisionAlgorithm& algorithm, btManifoldArray& manifolds) {
  manifolds.resize(0);
  algorithm.getAllContactManifolds(manifolds);
  if (auto* pieces = dynamic_cast<btCompoundCompoundCollisionAlgorithm*>(&algorithm))
    pieces->btCompoundCollisionAlgorithm::getAllContactManifolds(manifolds);
}

// As far as a point of a link has moved at most, from one place of the link to another.
double most_moved(const Dispatcher::Link& link, const Transform& from, const Transform& to) {
  return (to.translation() - from.translation()).norm() + link.radius * (to.linear() - from.linear()).norm();
}

bool same_pieces(const btManifoldPoint& one, const btManifoldPoint& other) {
  return one.m_index0 == other.m_index0 && one.m_index1 == other.m_index1;
}

}  // namespace

btCollisionObject& object_of(const btBroadphaseProxy& proxy) {
  return *static_cast<btCollisionObject*>(proxy.m_clientObject);
}

bool PairFilter::needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  const btCollisionObject &one = object_of(*a), &two = object_of(*b);
  if (one.getUserIndex() == two.getUserIndex())
    return is_robot(one) && links.contains(std::minmax({one.getUserIndex2(), two.getUserIndex2()}));
  return !(one.isStaticObject() && two.isStaticObject());
}

void Dispatcher::Link::add(Piece piece) {
  const Vector3 centre = piece.object_from_shape * piece.convex.box_centre;
  radius = std::max(radius, centre.norm() + piece.convex.box_half.norm());
  pieces.push_back(std::move(piece));
}

bool Dispatcher::within(const Link& one, const Link& other, const Transform& one_from_other, double distance) {
  return std::ranges::any_of(one.pieces, [&](const Piece& a) {
    return std::ranges::any_of(other.pieces, [&](const Piece& b) {
      return closer_than(a.convex, a.object_from_shape, b.convex, product(one_from_other, b.object_from_shape),
                         distance);
    });
  });
}

bool Dispatcher::apart(const btCollisionObject& one, const btCollisionObject& other) {
  constexpr double kNear_m = 0.015;   // more than two links go towards each other in a step
  constexpr double kFar_m = 0.06;     // what is so far apart is not looked at again soon
  constexpr double kAgain_m = 0.005;  // what is nearer may be far once it has moved so much
  const auto first = static_cast<std::size_t>(one.getUserIndex2()),
             second = static_cast<std::size_t>(other.getUserIndex2());
  const Link &link = links[first], &linked = links[second];
  const Transform now = product(from_bullet(one.getWorldTransform()).inverse(), from_bullet(other.getWorldTransform()));
  looked_.resize(links.size() * links.size());
  Looked& looked = looked_[first * links.size() + second];
  const double moved = looked.known ? most_moved(linked, looked.one_from_other, now) : 1;  // m
  if (looked.far && moved < kFar_m - kNear_m) return true;
  if (looked.far || moved > kAgain_m) looked = {true, !within(link, linked, now, kFar_m), now};
  return looked.far || !within(link, linked, now, kNear_m);
}

double contact_margin(const btCollisionObject& one, const btCollisionObject& other) {
  const auto usual = [](const btCollisionObject& object) {
    return object.getCollisionShape()->getContactBreakingThreshold(gContactBreakingThreshold);
  };
  constexpr btScalar kOfRobot = 0.002;
  const bool of_robot = is_robot(one) || is_robot(other);
  return std::max(of_robot ? kOfRobot : 0, std::min(usual(one), usual(other)));
}

btPersistentManifold* Dispatcher::getNewManifold(const btCollisionObject* one, const btCollisionObject* other) {
  btPersistentManifold* manifold = btCollisionDispatcher::getNewManifold(one, other);
  manifold->setContactBreakingThreshold(contact_margin(*one, *other));
  return manifold;
}

void Dispatcher::look_at(btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo& info) {
  const btCollisionObject &one = object_of(*pair.m_pProxy0), &other = object_of(*pair.m_pProxy1);
  const bool links = is_robot(one) && is_robot(other);
  auto& own = static_cast<Dispatcher&>(dispatcher);
  if (!links || !own.apart(one, other)) {
    defaultNearCallback(pair, dispatcher, info);
    return own.put_back(pair, info);
  }
  if (pair.m_algorithm == nullptr) return;
  btManifoldArray manifolds;  // what they touched at when they were near must not outlive that
  list_manifolds(*pair.m_algorithm, manifolds);
  for (int i = 0; i < manifolds.size(); ++i) dispatcher.clearManifold(manifolds[i]);
}

// That of the pieces which met at a point, among those of a pair; none while they do not.
btPersistentManifold* Dispatcher::manifold_at(const btManifoldPoint& point) const {
  for (int i = 0; i < listed_.size(); ++i)
    if (listed_[i]->getNumContacts() > 0 && same_pieces(listed_[i]->getContactPoint(0), point)) return listed_[i];
  return nullptr;
}

void Dispatcher::press_together(btBroadphasePair& pair, const btCollisionObject& first, const btManifoldPoint& point,
                                const btDispatcherInfo& info) {
  btCollisionObject& moved = object_of(&object_of(*pair.m_pProxy0) == &first ? *pair.m_pProxy0 : *pair.m_pProxy1);
  const btTransform stands = moved.getWorldTransform();
  moved.getWorldTransform().getOrigin() -=
      (std::max(btScalar(0), point.getDistance()) + kPressed_m) * point.m_normalWorldOnB;
  defaultNearCallback(pair, *this, info);
  moved.setWorldTransform(stands);
  list_manifolds(*pair.m_algorithm, listed_);
}

void Dispatcher::put_back(btBroadphasePair& pair, const btDispatcherInfo& info) {
  if (kept.empty() || pair.m_algorithm == nullptr) return;
  const btCollisionObject *one = &object_of(*pair.m_pProxy0), *other = &object_of(*pair.m_pProxy1);
  auto known = kept.find({number_of(*one), number_of(*other)});
  if (known == kept.end()) {
    std::swap(one, other);
    known = kept.find({number_of(*one), number_of(*other)});
  }
  if (known == kept.end()) return;
  list_manifolds(*pair.m_algorithm, listed_);
  std::vector<btPersistentManifold*> owners;
  for (const btManifoldPoint& point : known->second) {
    btPersistentManifold* owner = listed_.size() == 1 ? listed_[0] : manifold_at(point);
    if (owner == nullptr) {
      press_together(pair, *one, point, info);
      owner = manifold_at(point);
    }
    owners.push_back(owner);
  }
  for (int i = 0; i < listed_.size(); ++i) clearManifold(listed_[i]);
  for (std::size_t i = 0; i < owners.size(); ++i)
    if (owners[i] != nullptr) owners[i]->addManifoldPoint(known->second[i]);
  defaultNearCallback(pair, *this, info);
}

void Dispatcher::find_again(btBroadphasePair& pair, const LostContact& lost, const btDispatcherInfo& info) {
  defaultNearCallback(pair, *this, info);
  list_manifolds(*pair.m_algorithm, listed_);
  if (manifold_at(lost.point) != nullptr) return;
  press_together(pair, *lost.one, lost.point, info);
  defaultNearCallback(pair, *this, info);
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

ContactPoints ContactFinder::points() {
  ContactPoints all = dispatcher.kept;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    if (manifold.getNumContacts() == 0) continue;
    auto& points = all[{number_of(*manifold.getBody0()), number_of(*manifold.getBody1())}];
    for (int p = 0; p < manifold.getNumContacts(); ++p) points.push_back(manifold.getContactPoint(p));
  }
  return all;
}

void ContactFinder::find() {
  touched_.clear();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    if (manifold.getNumContacts() > 0 && (is_robot(*manifold.getBody0()) || is_robot(*manifold.getBody1())))
      touched_.push_back({&manifold, manifold.getBody0(), manifold.getBody1(), manifold.getContactPoint(0)});
  }
  world.performDiscreteCollisionDetection();
  dispatcher.kept.clear();
  find_lost();
}

void ContactFinder::find_lost() {
  std::erase_if(touched_, [&](const LostContact& before) {
    btPersistentManifold** const all = dispatcher.getInternalManifoldPointer();
    btPersistentManifold** const end = all + dispatcher.getNumManifolds();
    btPersistentManifold** const now = std::find(all, end, before.manifold);
    return now == end || (*now)->getNumContacts() > 0 || (*now)->getBody0() != before.one ||
           (*now)->getBody1() != before.other;
  });
  for (const LostContact& lost : touched_) {
    btBroadphasePair* pair = broadphase.getOverlappingPairCache()->findPair(
        const_cast<btBroadphaseProxy*>(lost.one->getBroadphaseHandle()),
        const_cast<btBroadphaseProxy*>(lost.other->getBroadphaseHandle()));
    if (pair != nullptr && pair->m_algorithm != nullptr) dispatcher.find_again(*pair, lost, world.getDispatchInfo());
  }
}

void ContactFinder::rebuild(ContactPoints kept) {
  dispatcher.kept = std::move(kept);
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
  std::erase_if(dispatcher.kept, [number = number_of(object)](const auto& pair) {
    return pair.first.first == number || pair.first.second == number;
  });
  world.updateSingleAabb(&object);
}

}  // namespace stampede
