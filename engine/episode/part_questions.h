// What a skill may ask before it takes hold of a part, or while it holds one: how far can the arm take it?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/episode/interfaces.h"
#include "engine/episode/rollout.h"

namespace stampede {

// Grasps of an object, best first, at most `most`. `follow`: only those from which the arm can go with the part the
// whole way; where there are none, those from which it can go 3/4 of it, or 1/2, 1/4, 1/8. `from`, `to`: the positions
// of its joint at the ends of that way; each grasp then says its `reach`.
std::vector<GraspCandidate> grasps_to_go(const WorldView& view, const CollisionState& space, const std::string& object,
                                         const std::optional<PartWay>& follow, double from, double to, RandomKey key,
                                         int most);

// How a part moves from where its joint is to where its number `to` says, and is then let go; nothing: it has none.
std::optional<PartWay> way_to(const WorldView& view, const std::string& name, const std::string& to);

// Of ReachOfPart and FindGrasp; nothing: the call is no question. `touchable` as of plan_call. Repeatable: a pure
// function of its arguments.
std::optional<RobotAnswer> answer_to(Rollout& rollout, const RobotCall& call, const std::vector<PartRef>& touchable,
                                     RandomKey key);

}  // namespace stampede
