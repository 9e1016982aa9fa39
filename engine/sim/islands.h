// Which movers touch each other, directly or through others: such islands are solved for themselves. Private to
// engine/sim.
#pragma once

#include <span>
#include <vector>

#include "engine/sim/movers.h"

class btCollisionWorld;
class btPersistentManifold;

namespace stampede {

struct Touching {
  int island = 0;
  int first = 0, second = 0;  // objects of the world
  btPersistentManifold* manifold = nullptr;
  bool on_link = false;
  double deep_m = 0;   // half as far as the deepest of all points of these two lies in the other
  double weights = 1;  // of all of them that bear
  bool narrow = true;  // all points of these two lie along a line: nothing else resists turning about it

  double weight(double depth) const;  // of what the two bear together, that a point so deep has to bear
};

struct Island {
  int number = 0;  // Mover::island
  std::span<const Touching> touching;
};

class Islands {
 public:
  Islands(btCollisionWorld& world, Movers& movers) : world_(world), movers_(movers) {}
  void find();  // of all that is awake, in an order that knows nothing of the past
  const std::vector<Island>& all() const { return islands_; }

 private:
  int root(int mover) const;
  void unite(int one, int other);
  void find_touching();
  void look_at_points();
  bool in_bond(int island) const;

  btCollisionWorld& world_;
  Movers& movers_;
  std::vector<Touching> touching_;
  std::vector<Island> islands_;
  std::vector<Vector3> points_;
  std::vector<double> depths_;
};

}  // namespace stampede
