#include "engine/sim/encounters.h"

#include <btBulletCollisionCommon.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "engine/sim/bullet_convert.h"
#include "engine/sim/contact_finder.h"
#include "engine/sim/shapes.h"

namespace stampede {
namespace {

constexpr double kFar_m = 5e-4;              // within a step: less is slow
constexpr double kInto_m = 2e-4;             // less deep in each other they are not looked at again
constexpr double kTouching_m = kInto_m / 4;  // held up not quite: Bullet does not tell of boxes that are just apart
constexpr double kStill = 1;                 // times the speed of rest
constexpr int kLooks = 10;                   // at most
constexpr int kSweeps = 40;                  // over the points that hold them up
constexpr double kOnItsSide = 0.8;           // of the way into each other at which the far side of both is as near
constexpr int kParts = 16;                   // of a step, at most

// Of the ball about the origin of an object that holds all of it, m.
double radius_of(const btCollisionObject& object) {
  btVector3 centre;
  btScalar radius = 0;
  object.getCollisionShape()->getBoundingSphere(centre, radius);
  return radius + centre.length();
}

double deepest_of(const std::vector<btPersistentManifold*>& manifolds) {
  double deepest = 0;
  for (const btPersistentManifold* manifold : manifolds)
    for (int p = 0; p < manifold->getNumContacts(); ++p)
      deepest = std::max(deepest, -static_cast<double>(manifold->getContactPoint(p).getDistance()));
  return deepest;
}

}  // namespace

// One of two that meet: how it goes on until the end of the step.
struct Encounters::Side {
  btCollisionObject* object = nullptr;
  const FreeBody* body = nullptr;  // none: it stands still
  Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
  Transform now = Transform::Identity();
  Matrix3 inverse_inertia = Matrix3::Zero();
  double radius = 0;  // m, about its origin

  double way(double duration) const { return duration * (linear.norm() + radius * angular.norm()); }
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
  side.radius = radius_of(object);
  side.inverse_inertia = side.body->inverse_inertia();
  return side;
}

// Two that may meet within the step, and the points at which they do, where they are now.
class Encounters::Meeting {
 public:
  Meeting(ContactFinder& finder, btBroadphasePair& pair, double dt);
  btCollisionObject& object(std::size_t i) const { return *objects_[i]; }
  // Follows them through the step, held up at what is known, and learns where they touch. Returns whether that is more
  // than was known, and they would be deeper in each other than they are now.
  bool look(Side one, Side other);
  std::vector<std::pair<btPersistentManifold*, double>> put_in() const;

 private:
  struct Known {
    btPersistentManifold* manifold = nullptr;  // told apart by it
    btManifoldPoint point;
    std::array<const btCollisionObject*, 2> of;
    bool before = false;  // Bullet's own
    double borne = 0;     // N s, when they were held up last
  };
  std::vector<btPersistentManifold*> manifolds() const;
  void hold_up(Side& one, Side& other);
  void go_on(const Side& one, const Side& other, double duration);
  bool learn(const std::vector<btPersistentManifold*>& found, bool before);  // whether there are more

  ContactFinder& finder_;
  btBroadphasePair& pair_;
  double dt_;
  std::array<btCollisionObject*, 2> objects_;
  double usual_, thick_;     // m, margin of points, and how thick both are
  double margin_, deepest_;  // m, margin as far as they go, and now
  std::vector<Known> known_;
};

Encounters::Meeting::Meeting(ContactFinder& finder, btBroadphasePair& pair, double dt)
    : finder_(finder),
      pair_(pair),
      dt_(dt),
      objects_{&object_of(*pair.m_pProxy0), &object_of(*pair.m_pProxy1)},
      usual_(contact_margin(*objects_[0], *objects_[1])),
      thick_(least_thickness(*objects_[0]->getCollisionShape()) + least_thickness(*objects_[1]->getCollisionShape())),
      margin_(usual_) {
  const std::vector<btPersistentManifold*> found = manifolds();
  deepest_ = deepest_of(found);
  learn(found, true);
}

// The algorithm of two compounds does not know all of its own.
std::vector<btPersistentManifold*> Encounters::Meeting::manifolds() const {
  std::vector<btPersistentManifold*> own;
  for (int m = 0; m < finder_.dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold* manifold = finder_.dispatcher.getManifoldByIndexInternal(m);
    const btCollisionObject *one = manifold->getBody0(), *other = manifold->getBody1();
    if ((one == objects_[0] && other == objects_[1]) || (one == objects_[1] && other == objects_[0]))
      own.push_back(manifold);
  }
  return own;
}

// Notes the points that Bullet has found; of two in one place the later one counts. (With so wide a margin Bullet
// itself would take all of a small thing's for one.)
bool Encounters::Meeting::learn(const std::vector<btPersistentManifold*>& found, bool before) {
  const std::size_t known_before = known_.size();
  for (btPersistentManifold* manifold : found)
    for (int p = 0; p < manifold->getNumContacts(); ++p) {
      Known now{manifold, manifold->getContactPoint(p), {manifold->getBody0(), manifold->getBody1()}, before};
      const auto same = std::ranges::find_if(known_, [&](const Known& known) {
        return known.manifold == manifold && (known.point.m_localPointA - now.point.m_localPointA).length() < usual_;
      });
      if (same == known_.end())
        known_.push_back(now);
      else if (!same->before)
        same->point = now.point;
    }
  return known_.size() > known_before;
}

// Takes from the speeds what the points between the two do not let happen.
void Encounters::Meeting::hold_up(Side& one, Side& other) {
  struct Impulse {
    double normal = 0;
    Vector3 friction = Vector3::Zero();
  };
  std::vector<Impulse> impulses(known_.size());
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t i = 0; i < known_.size(); ++i) {
      const btManifoldPoint& point = known_[i].point;
      const double side = known_[i].of[0] == one.object ? 1 : -1;
      const Vector3 normal = side * from_bullet(point.m_normalWorldOnB);  // towards `one`
      const Vector3 at = from_bullet(point.m_positionWorldOnB);
      const Vector3 speed = one.velocity_at(at) - other.velocity_at(at);
      const double wanted = -(std::max(0.0, static_cast<double>(point.getDistance())) + kTouching_m) / dt_;
      const double lightness = one.lightness_at(at, normal) + other.lightness_at(at, normal);
      Impulse& impulse = impulses[i];
      const Impulse before = impulse;
      impulse.normal = std::max(0.0, impulse.normal + (wanted - normal.dot(speed)) / lightness);
      const Vector3 across = speed - normal.dot(speed) * normal;
      if (const double slip = across.norm(); slip > 0) {
        const Vector3 along = across / slip;
        impulse.friction -= across / (one.lightness_at(at, along) + other.lightness_at(at, along));
        const double most = point.m_combinedFriction * impulse.normal, now = impulse.friction.norm();
        if (now > most) impulse.friction *= most / now;
      }
      const Vector3 change = (impulse.normal - before.normal) * normal + impulse.friction - before.friction;
      one.push(at, change);
      other.push(at, -change);
      known_[i].borne = impulse.normal;
    }
}

// Lets Bullet look at both where they will be.
void Encounters::Meeting::go_on(const Side& one, const Side& other, double duration) {
  for (const Side* side : {&one, &other}) {
    if (!side->body) continue;
    Transform pose = side->now;
    pose.translation() += duration * side->linear;
    pose.linear() = turned_by(pose.linear(), side->angular, duration);
    side->object->setWorldTransform(to_bullet(pose));
  }
  const btCollisionObjectWrapper on_one(nullptr, one.object->getCollisionShape(), one.object,
                                        one.object->getWorldTransform(), -1, -1);
  const btCollisionObjectWrapper on_other(nullptr, other.object->getCollisionShape(), other.object,
                                          other.object->getWorldTransform(), -1, -1);
  btManifoldResult points(&on_one, &on_other);
  pair_.m_algorithm->processCollision(&on_one, &on_other, finder_.world.getDispatchInfo(), &points);
  for (const Side* side : {&one, &other}) side->object->setWorldTransform(to_bullet(side->now));
}

bool Encounters::Meeting::look(Side one, Side other) {
  hold_up(one, other);
  const double way = one.way(dt_) + other.way(dt_);  // held up at one end, the other goes faster
  const int parts = std::clamp(static_cast<int>(std::ceil(way / (kOnItsSide * thick_ / 2))), 1, kParts);
  margin_ = std::max(margin_, way);
  finder_.shapes.room = std::max(ShapeStore::kRoom, margin_);  // else their pieces' manifolds go with what is apart
  bool deeper = false, learned = false;
  for (int part = 1; part <= parts && !deeper; ++part) {
    go_on(one, other, part * dt_ / parts);
    const std::vector<btPersistentManifold*> found = manifolds();
    deeper = deepest_of(found) >= deepest_ + kInto_m;
    learned = learn(found, false) || learned;
  }
  finder_.shapes.room = ShapeStore::kRoom;
  for (Known& known : known_) {
    btManifoldPoint& point = known.point;
    point.m_positionWorldOnA = known.of[0]->getWorldTransform()(point.m_localPointA);
    point.m_positionWorldOnB = known.of[1]->getWorldTransform()(point.m_localPointB);
    point.m_distance1 = (point.m_positionWorldOnA - point.m_positionWorldOnB).dot(point.m_normalWorldOnB);
  }
  return deeper && learned;
}

// Gives the points to Bullet's manifolds, where there are too many those that bear most; returns the manifolds, with
// the margin that they had.
std::vector<std::pair<btPersistentManifold*, double>> Encounters::Meeting::put_in() const {
  std::vector<std::pair<btPersistentManifold*, double>> found;
  for (btPersistentManifold* manifold : manifolds()) {
    std::vector<const Known*> own;
    for (const Known& known : known_)
      if (known.manifold == manifold) own.push_back(&known);
    if (own.size() > MANIFOLD_CACHE_SIZE) {
      std::ranges::stable_sort(own, std::greater(), &Known::borne);
      own.resize(MANIFOLD_CACHE_SIZE);
    }
    manifold->clearManifold();
    manifold->setContactBreakingThreshold(margin_);
    for (const Known* known : own) manifold->addManifoldPoint(known->point);
    found.emplace_back(manifold, usual_);
  }
  return found;
}

void Encounters::meet_ahead(btBroadphasePair& pair) {
  Meeting meeting(finder_, pair, dt_);
  for (int look = 0; look < kLooks; ++look)
    if (!meeting.look(side_of(meeting.object(0)), side_of(meeting.object(1)))) break;
  const auto found = meeting.put_in();
  found_.insert(found_.end(), found.begin(), found.end());
}

void Encounters::find() {
  found_.clear();
  const std::vector<Mover>& movers = movers_.all();
  ways_.assign(movers.size(), 0);
  bool any = false;
  for (std::size_t m = 0; m < movers.size(); ++m) {
    const Mover& mover = movers[m];
    if (!mover.free || mover.asleep || !mover.free->object->getBroadphaseHandle()) continue;
    ways_[m] = dt_ * (mover.free->linear.norm() + radius_of(*mover.free->object) * mover.free->angular.norm());
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
  btBroadphasePairArray& pairs = finder_.broadphase.getOverlappingPairCache()->getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i) {
    const btCollisionObject &one = object_of(*pairs[i].m_pProxy0), &other = object_of(*pairs[i].m_pProxy1);
    const MoverLink first = MoverLink::of(&one), second = MoverLink::of(&other);
    const double both = way(first) + way(second);
    if (both <= kFar_m || !pairs[i].m_algorithm || driven(first) || driven(second) || movers_.bonded(one, other))
      continue;
    meet_ahead(pairs[i]);
  }
}

void Encounters::forget() {
  for (auto& [manifold, usual] : found_) manifold->setContactBreakingThreshold(usual);
  found_.clear();
}

}  // namespace stampede
