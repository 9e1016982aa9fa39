// How far the fingers may open.
#include <algorithm>

#include "engine/motion/planner.h"

namespace stampede {
namespace {

constexpr double kStep_m = 0.001;
constexpr double kBeside_m = 0.0015;                         // left between a finger and what is beside it
constexpr double kLeast_m = kRoomToLetGo_m - 2 * kBeside_m;  // to let go

bool among(const std::vector<CollisionPair>& pairs, const CollisionPair& pair) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const CollisionPair& other) {
    return other.robot_part == pair.robot_part && other.other == pair.other;
  });
}

}  // namespace

double widest_opening(const CollisionState& state, const JointVector& q, double wanted_m, bool lets_go) {
  const double least = std::min(wanted_m, state.opening() + (lets_go ? kLeast_m : 0));
  const std::vector<CollisionPair> touched = state.contacts(q);
  CollisionState wider = state;
  for (double opening = state.opening() + kStep_m; opening < wanted_m + kBeside_m; opening += kStep_m) {
    wider.set_opening(opening);
    const auto contacts = wider.contacts(q);
    const bool met =
        std::any_of(contacts.begin(), contacts.end(), [&](const CollisionPair& pair) { return !among(touched, pair); });
    if (met) return std::clamp(opening - kStep_m - kBeside_m, least, wanted_m);
  }
  return wanted_m;
}

}  // namespace stampede
