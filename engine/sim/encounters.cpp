#include "engine/sim/encounters.h"

#include <btBulletCollisionCommon.h>

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "engine/sim/bullet_convert.h"
#include "engine/sim/contact_finder.h"

namespace stampede {
namespace {

constexpr double kFar_m = 5e-4;   // within a step: less is slow
constexpr double kInto_m = 2e-4;  // less deep in each other they are not looked at again
constexpr double kStill = 1;      // times the speed of rest
constexpr int kLooks = 4;         // as many points as a manifold has
constexpr int kSweeps = 8;

}  // namespace

// One of two that meet: how it goes on until the end of the step.
struct Encounters::Side {
  btCollisionObject* object = nullptr;
  const FreeBody* body = nullptr;  // none: it stands still
  Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
  Transform now = Transform::Identity();
  Matrix3 inverse_inertia = Matrix3::Zero();

  Vector3 velocity_at(const Vector3& point) const { return linear + angular.cross(point - now.translation()); }
  double lightness_at(const Vector3& point, const Vector3& normal) const {
    if (!body) return 0;
    const Vector3 turn = (point - now.translation()).cross(normal);
    return 1 / body->mass + turn.dot(inverse_inertia * turn);
  }
  void push(const Vector3& point, const Vector3& impulse) {
    if (!body) return;
    linear += impulse / body->mass;
    angular += inverse_inertia * (point - now.translation()).cross(impulse);
  }
};

Encounters::Side Encounters::side_of(btCollisionObject& object) const {
  Side side;
  side.object = &object;
  side.now = from_bullet(object.getWorldTransform());
  const MoverLink node = MoverLink::of(&object);
  if (node.mover < 0) return side;
  const Mover& mover = movers_[node.mover];
  if (!mover.free || mover.asleep) return side;
  side.body = mover.free;
  side.linear = mover.free->linear + dt_ * gravity_;
  side.angular = mover.free->angular;
  const Matrix3 turn = side.now.linear();
  side.inverse_inertia = turn * mover.free->moments.cwiseInverse().asDiagonal() * turn.transpose();
  return side;
}

// Takes from the speeds what the points between the two do not let happen.
void Encounters::hold_up(Side& one, Side& other, const btManifoldArray& manifolds) const {
  std::vector<double> impulses;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    std::size_t next = 0;
    for (int m = 0; m < manifolds.size(); ++m) {
      const double side = manifolds[m]->getBody0() == one.object ? 1 : -1;
      for (int p = 0; p < manifolds[m]->getNumContacts(); ++p) {
        const btManifoldPoint& point = manifolds[m]->getContactPoint(p);
        const Vector3 normal = side * from_bullet(point.m_normalWorldOnB);  // towards `one`
        const Vector3 at = from_bullet(point.m_positionWorldOnB);
        if (next == impulses.size()) impulses.push_back(0);
        double& impulse = impulses[next++];
        const double lightness = one.lightness_at(at, normal) + other.lightness_at(at, normal);
        const double speed = normal.dot(one.velocity_at(at) - other.velocity_at(at));
        const double wanted = -std::max(0.0, static_cast<double>(point.getDistance())) / dt_;
        const double before = std::exchange(impulse, std::max(0.0, impulse + (wanted - speed) / lightness));
        one.push(at, (impulse - before) * normal);
        other.push(at, (before - impulse) * normal);
      }
    }
  }
}

void Encounters::meet_ahead(btBroadphasePair& pair, double way) {
  btCollisionObject* const objects[] = {static_cast<btCollisionObject*>(pair.m_pProxy0->m_clientObject),
                                        static_cast<btCollisionObject*>(pair.m_pProxy1->m_clientObject)};
  const btScalar usual = contact_margin(*objects[0], *objects[1]);
  const btScalar margin = std::max(usual, static_cast<btScalar>(way));
  btManifoldArray manifolds;
  const auto find = [&] {  // the algorithm of two compounds does not know all of its own
    manifolds.resize(0);
    btDispatcher& dispatcher = *world_.getDispatcher();
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
      btPersistentManifold* manifold = dispatcher.getManifoldByIndexInternal(m);
      const bool either = manifold->getBody0() == objects[0] && manifold->getBody1() == objects[1];
      if (!either && (manifold->getBody0() != objects[1] || manifold->getBody1() != objects[0])) continue;
      manifold->setContactBreakingThreshold(margin);
      manifolds.push_back(manifold);
    }
  };
  const auto go_on = [&](const Side& side) {
    if (!side.body) return;
    Transform pose = side.now;
    pose.translation() += dt_ * side.linear;
    pose.linear() = turned_by(pose.linear(), side.angular, dt_);
    side.object->setWorldTransform(to_bullet(pose));
  };
  find();
  for (int look = 0; look < kLooks; ++look) {
    Side one = side_of(*objects[0]), other = side_of(*objects[1]);
    if (look > 0) hold_up(one, other, manifolds);
    go_on(one);
    go_on(other);
    const btCollisionObjectWrapper on_one(nullptr, one.object->getCollisionShape(), one.object,
                                          one.object->getWorldTransform(), -1, -1);
    const btCollisionObjectWrapper on_other(nullptr, other.object->getCollisionShape(), other.object,
                                            other.object->getWorldTransform(), -1, -1);
    btManifoldResult points(&on_one, &on_other);
    pair.m_algorithm->processCollision(&on_one, &on_other, world_.getDispatchInfo(), &points);
    find();  // there may be others now
    double deepest = 0;
    for (int m = 0; m < manifolds.size(); ++m)
      for (int p = 0; p < manifolds[m]->getNumContacts(); ++p)
        deepest = std::max(deepest, -static_cast<double>(manifolds[m]->getContactPoint(p).getDistance()));
    for (const Side* side : {&one, &other}) side->object->setWorldTransform(to_bullet(side->now));
    for (int m = 0; m < manifolds.size(); ++m)
      manifolds[m]->refreshContactPoints(manifolds[m]->getBody0()->getWorldTransform(),
                                         manifolds[m]->getBody1()->getWorldTransform());
    if (deepest < kInto_m) break;
  }
  for (int m = 0; m < manifolds.size(); ++m) found_.emplace_back(manifolds[m], usual);
}

void Encounters::find() {
  found_.clear();
  const std::vector<Mover>& movers = movers_.all();
  ways_.assign(movers.size(), 0);
  bool any = false;
  for (std::size_t m = 0; m < movers.size(); ++m) {
    const Mover& mover = movers[m];
    if (!mover.free || mover.asleep || !mover.free->object->getBroadphaseHandle()) continue;
    btVector3 centre;
    btScalar radius = 0;
    mover.free->object->getCollisionShape()->getBoundingSphere(centre, radius);
    ways_[m] = dt_ * (mover.free->linear.norm() + (radius + centre.length()) * mover.free->angular.norm());
    any = any || ways_[m] > kFar_m;
  }
  if (!any) return;
  const auto way = [&](const MoverLink& node) {
    return node.mover < 0 ? 0 : ways_[static_cast<std::size_t>(node.mover)];
  };
  const auto driven = [&](const MoverLink& node) {
    if (node.mover < 0) return false;
    const Mover& mover = movers_[node.mover];
    return mover.tree && (!mover.may_sleep || !mover.slower(kStill));
  };
  btBroadphasePairArray& pairs = world_.getBroadphase()->getOverlappingPairCache()->getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i) {
    const auto& one = *static_cast<const btCollisionObject*>(pairs[i].m_pProxy0->m_clientObject);
    const auto& other = *static_cast<const btCollisionObject*>(pairs[i].m_pProxy1->m_clientObject);
    const MoverLink first = MoverLink::of(&one), second = MoverLink::of(&other);
    const double both = way(first) + way(second);
    if (both <= kFar_m || !pairs[i].m_algorithm || driven(first) || driven(second) || movers_.bonded(one, other))
      continue;
    meet_ahead(pairs[i], both);
  }
}

void Encounters::forget() {
  for (auto& [manifold, usual] : found_) manifold->setContactBreakingThreshold(usual);
  found_.clear();
}

}  // namespace stampede
