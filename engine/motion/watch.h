// What motions look at while they run. Room-internal.
#pragma once

#include <optional>
#include <set>
#include <utility>

#include "engine/sim/world.h"

namespace stampede {

std::int64_t steps_of(double seconds, const World& world);

// From the reference's present state to rest, in a tenth of a second or as fast as the joints can.
Trajectory brake(const World& world, int robot);

// The contacts that a hand, and what it holds, has with anything else.
class ContactWatch {
 public:
  ContactWatch(const World& world, std::optional<PartRef> held, int robot);
  void forget_held() { held_.reset(); }
  // One that was not there when the watch began and is harder than `new_force`, or any harder than `most_force`, N;
  // 0: does not count.
  bool met(const World& world, double new_force, double most_force) const;
  // What all else does to them along a direction, mean over the last window, N: negative where they press.
  double force_along(const World& world, const Vector3& direction) const;

 private:
  bool mine(PartRef part) const { return hand_.contains(part) || held_ == part; }
  std::set<PartRef> hand_;
  std::optional<PartRef> held_;
  std::set<std::pair<PartRef, PartRef>> known_;
};

// Fingers on their way to an opening.
class FingerWatch {
 public:
  void begin(const World& world, double opening, int robot);
  bool arrived(const World& world) const;
  bool stopped(const World& world);  // not moved for a while, or too long on the way; to be asked once a step

 private:
  double opening_ = 0, last_m_ = 0;
  int robot_ = 0;
  std::int64_t count_ = 0, still_ = 0;
};

}  // namespace stampede
