// OMPL's geometric planners by their own names, on our state space and checker. Room-internal.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/random.h"
#include "engine/motion/checker.h"
#include "engine/motion/rrt.h"

namespace stampede {

// `BITstar`, `RRTConnect` …, sorted: all geometric planners of OMPL 1.5 that need no more than a space and a checker
// and run in one thread.
std::vector<std::string> ompl_planner_names();

// Why OMPL has it and we do not offer it; empty: there is no such reason.
std::string why_not_offered(std::string_view planner);

// Until the first path, or `options.iterations` turns of the planner's loop; optimising planners stop there too.
// Result: waypoints from start to goal, not shortened; empty: none was found. `planner`: one of those names.
// Repeatable: a pure function of its arguments; one at a time in a process, as OMPL seeds its generators in the order
// in which they are made.
std::vector<JointVector> plan_with_ompl(const std::string& planner, const PathQuery& query, const TreeOptions& options,
                                        RandomKey key);

}  // namespace stampede
