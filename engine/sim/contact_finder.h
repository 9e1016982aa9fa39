// Bullet's world, which finds what touches. Private to engine/sim.
#pragma once

#include <btBulletCollisionCommon.h>

#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "engine/sim/convex.h"
#include "engine/sim/shapes.h"

namespace stampede {

constexpr int kRobot = -1;  // an object's user index is its body, the second one its part

// What stands behind a proxy of Bullet's.
btCollisionObject& object_of(const btBroadphaseProxy& proxy);

// Points of contact further apart than this, m, or that slid so far, are forgotten: a fiftieth of the smaller shape, as
// in Bullet; but those of a robot not within 2 mm, for Bullet tells of boxes only once they lie in each other, and one
// step without any would free what a hand presses. (So far the edge of a hole would be remembered, too.)
double contact_margin(const btCollisionObject& one, const btCollisionObject& other);

// Pairs that Bullet need not look at: parts of one body, but for links of a robot that can meet; static with static.
struct PairFilter final : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
  std::set<std::pair<int, int>> links;  // of the robot
};

// Points of contact of each pair of objects, numbered in the order of their creation.
using ContactPoints = std::map<std::pair<int, int>, std::vector<btManifoldPoint>>;

// A point at which two touched in the step before, and where it was found.
struct LostContact {
  const btPersistentManifold* manifold = nullptr;
  const btCollisionObject *one = nullptr, *other = nullptr;
  btManifoldPoint point;
};

// Links are near each other all the time, in the eyes of boxes along the axes: most are told apart here, cheaply.
struct Dispatcher final : btCollisionDispatcher {
  explicit Dispatcher(btCollisionConfiguration* configuration) : btCollisionDispatcher(configuration) {
    setNearCallback(look_at);
  }
  btPersistentManifold* getNewManifold(const btCollisionObject* one, const btCollisionObject* other) override;
  static void look_at(btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo& info);
  bool apart(const btCollisionObject& one, const btCollisionObject& other);
  // Searches on from this pair's points of `kept`.
  void put_back(btBroadphasePair& pair, const btDispatcherInfo& info);
  void find_again(btBroadphasePair& pair, const LostContact& lost, const btDispatcherInfo& info);
  struct Piece {
    Convex convex;
    Transform object_from_shape;
  };
  struct Link {
    std::vector<Piece> pieces;
    double radius = 0;  // m, from the link's origin to the furthest that a piece can reach
    void add(Piece piece);
  };
  std::vector<Link> links;  // per part of the robot
  ContactPoints kept;       // those that the next search goes on from

 private:
  btPersistentManifold* manifold_at(const btManifoldPoint& point) const;
  // Pieces that just touch, for a moment, so that it is told of: `first` is whose side of the point comes first.
  void press_together(btBroadphasePair& pair, const btCollisionObject& first, const btManifoldPoint& point,
                      const btDispatcherInfo& info);

  // Two links where they were looked at last: so far apart that they are none the nearer until they have moved as far.
  struct Looked {
    bool known = false, far = false;
    Transform one_from_other;
  };
  static bool within(const Link& one, const Link& other, const Transform& one_from_other, double distance);

  std::vector<Looked> looked_;  // by the numbers of both
  btManifoldArray listed_;      // of the pair that is looked at
};

struct ContactFinder {
  ContactFinder();
  ~ContactFinder();
  ContactFinder(const ContactFinder&) = delete;
  ContactFinder& operator=(const ContactFinder&) = delete;

  ContactPoints points();
  // Takes every object out and puts it back in creation order: trees, pairs, ids and manifolds are then those of a
  // world that was just built, whatever came before. The next find() goes on from these points: found one a step, those
  // of a grasp would let what it holds turn meanwhile.
  void rebuild(ContactPoints kept);
  void find();
  // What was moved by hand touches nothing until contacts are found anew.
  void forget_pairs(btCollisionObject& object);

  // Order matters: destroyed from the bottom up, Bullet's world before what it points to.
  ShapeStore shapes;
  PairFilter filter;
  btDefaultCollisionConfiguration configuration;
  Dispatcher dispatcher;
  btDbvtBroadphase broadphase;
  btCollisionWorld world;
  std::vector<std::unique_ptr<btCollisionObject>> objects;  // in creation order: Bullet sorts pairs by it

 private:
  // What a robot touches and what a step forgets: a point that slid too far, in whose place an anchored one has kept
  // out what was found, or boxes that just touch are not told of. A hand that grips would shut by millimetres
  // meanwhile.
  void find_lost();

  std::vector<LostContact> touched_;  // before the last find(); those that it lost
};

}  // namespace stampede
