// How far the arm can take a part, and with which grasps: what starts, skills and predicates ask of a world as it
// stands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/motion/part_way.h"
#include "engine/start/interfaces.h"

namespace stampede {

// Grasps of an object, best first, at most `most`. `follow`: only those from which the arm can go with the part the
// whole way; where there are none, those from which it can go 3/4 of it, or 1/2, 1/4, 1/8. `from`, `to`: the positions
// of its joint at the ends of that way; each grasp then says its `reach`.
std::vector<GraspCandidate> grasps_to_go(const WorldView& view, const CollisionState& space, const std::string& object,
                                         const std::optional<PartWay>& follow, double from, double to, RandomKey key,
                                         int most);

// How a part moves from where its joint is to where its number `to` says, and is then let go; nothing: it has none.
std::optional<PartWay> way_to(const WorldView& view, const std::string& name, const std::string& to);

// How a part goes from where its joint is to `position`, its handle free to turn in the hand by `pivot` rad.
PartWay way_of_part(const WorldView& view, const std::string& name, double position, double pivot);

// Where plans start: the reference, or the arm itself where contact keeps it away from its reference.
JointVector planning_start(const World& world, int robot = 0);

}  // namespace stampede
