// Points at which fast things will meet within the step. Private to engine/sim.
#pragma once

#include <utility>
#include <vector>

#include "engine/sim/movers.h"

class btPersistentManifold;
struct btBroadphasePair;

namespace stampede {

struct ContactFinder;

// What moves fast meets things between two steps, at points that are not the nearest ones yet: the far rim of a plate
// that comes down on one side, a floor millimetres below what falls. So such bodies' contacts are looked for where they
// will be as well, first unhindered, then held up at the points that are known by then. No look goes so far that thin
// things would be found on the wrong side of each other. These points lie apart for now; the solver lets them come
// together and no further (speculative contacts, as in Catto, Continuous Collision, GDC 2013).
class Encounters {
 public:
  Encounters(ContactFinder& finder, const Movers& movers, const Vector3& gravity, double dt)
      : finder_(finder), movers_(movers), gravity_(gravity), dt_(dt) {}
  void find();    // at the start of a step, among what Bullet found there
  void forget();  // at its end

 private:
  struct Side;
  class Meeting;
  Side side_of(btCollisionObject& object) const;
  void meet_ahead(btBroadphasePair& pair);

  ContactFinder& finder_;
  const Movers& movers_;
  Vector3 gravity_;
  double dt_;
  std::vector<double> ways_;                                     // m that each mover's points may go in a step
  std::vector<std::pair<btPersistentManifold*, double>> found_;  // with their usual margins, m
};

}  // namespace stampede
