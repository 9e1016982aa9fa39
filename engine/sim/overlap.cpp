#include "engine/sim/overlap.h"

#include <algorithm>

#include "engine/sim/collision_query.h"
#include "engine/sim/depth.h"

namespace stampede {

std::optional<Overlap> deepest_overlap(const CollisionState& state, const JointVector& q) {
  std::optional<Overlap> deepest;
  CollisionQuery query(state);
  query.visit(q, [&](const CollisionPair& pair) {
    const double depth = query.depth(pair);
    if (!deepest || depth > deepest->depth) deepest = Overlap{pair.robot_part, pair.other, depth};
    return false;
  });
  return deepest;
}

std::vector<Overlap> overlapping_bodies(const CollisionState& state, double most_m) {
  std::vector<Overlap> all;
  const auto joined = [](const Body& one, const Body& other) { return one.joined_to == other.name; };
  CollisionQuery::visit_bodies(state, most_m, [&](PartRef a, PartRef b, const auto& depth_of) {
    const Body &one = state.scene().body_at(a.body), &other = state.scene().body_at(b.body);
    if ((one.fixture && other.fixture) || joined(one, other) || joined(other, one)) return;
    const double depth = depth_of();
    if (depth <= most_m) return;
    const auto known = std::ranges::find_if(all, [&](const Overlap& pair) { return pair.one == a && pair.other == b; });
    if (known == all.end())
      all.push_back({a, b, depth});
    else
      known->depth = std::max(known->depth, depth);
  });
  std::ranges::stable_sort(all, [](const Overlap& a, const Overlap& b) { return a.depth > b.depth; });
  return all;
}

void count_arm_alone(CollisionState& state) { state.allow(kWhateverTheHandMeets); }

}  // namespace stampede
