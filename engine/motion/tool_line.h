// A path of the tool on which something goes with the hand.
#pragma once

#include <functional>

#include "engine/motion/planner.h"

namespace stampede {

// Puts what goes with the hand where it is at a share of the path.
using GoesAlong = std::function<void(CollisionState& space, double share)>;

// As plan_tool_path, which asks of a path of a hand that takes nothing along.
PlannedMotion plan_tool_path_with(const CollisionState& state, const JointVector& start,
                                  const std::function<Transform(double)>& world_from_tip, const LineOptions& line,
                                  const GoesAlong& goes_along, const MotionLimits& limits, RandomKey key);

}  // namespace stampede
