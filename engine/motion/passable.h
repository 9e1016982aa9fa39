// Whether a motion could be, without the search for the free way that leads to it.
#pragma once

#include <vector>

#include "engine/motion/planner.h"

namespace stampede {

// Could the arm go through these targets and on from the last, wherever it comes from? All that plan_through asks but
// the free way to the first. Repeatable; some milliseconds.
bool passable(const MotionProblem& problem, const std::vector<ToolTarget>& targets, const ThenDo& then = {});

}  // namespace stampede
