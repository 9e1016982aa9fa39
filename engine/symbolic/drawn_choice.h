// Plans whose choices among equals are drawn.
#pragma once

#include "engine/base/random.h"
#include "engine/symbolic/task_planner.h"

namespace stampede {

// As solve(), but which of several equal objects a plan takes, and in which order, depends on `key`: objects of one
// type of which the same is known trade their names before the search, and trade them back after it. Constants of the
// domain keep theirs. Repeatable: a pure function of its arguments.
PlanOutcome solve_drawn(const Domain& domain, const Problem& problem, const std::set<PlanStep>& forbidden,
                        RandomKey key);

}  // namespace stampede
