// Points at which fast things will meet within the step. Private to engine/sim.
#pragma once

#include <utility>
#include <vector>

#include "engine/sim/movers.h"

class btCollisionWorld;
class btPersistentManifold;
struct btBroadphasePair;
template <typename T>
class btAlignedObjectArray;

namespace stampede {

// What moves fast meets things between two steps, at points that are not the nearest ones yet: the far rim of a plate
// that comes down on one side, a floor millimetres below what falls. So such bodies' contacts are looked for where they
// will be as well, first unhindered, then held up at the points that are known by then. These points lie apart for now;
// the solver lets them come together and no further (speculative contacts, as in Catto, Continuous Collision, GDC
// 2013).
class Encounters {
 public:
  Encounters(btCollisionWorld& world, const Movers& movers, const Vector3& gravity, double dt)
      : world_(world), movers_(movers), gravity_(gravity), dt_(dt) {}
  void find();    // at the start of a step, among what Bullet found there
  void forget();  // at its end

 private:
  struct Side;
  Side side_of(btCollisionObject& object) const;
  void hold_up(Side& one, Side& other, const btAlignedObjectArray<btPersistentManifold*>& manifolds) const;
  void meet_ahead(btBroadphasePair& pair, double way);

  btCollisionWorld& world_;
  const Movers& movers_;
  Vector3 gravity_;
  double dt_;
  std::vector<double> ways_;                                     // m that each mover's points may go in a step
  std::vector<std::pair<btPersistentManifold*, double>> found_;  // with their usual margins, m
};

}  // namespace stampede
