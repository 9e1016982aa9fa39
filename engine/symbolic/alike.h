// Problems with crowds of objects that are alike. Room-internal.
#pragma once

#include <optional>
#include <set>

#include "engine/symbolic/task_planner.h"

namespace stampede::symbolic {

// The problem without most objects of its crowds: of those that neither the goal, nor the domain, nor a forbidden step
// names, and that no fact the domain speaks of tells apart, a few stay. A plan of it is often one of the whole problem,
// and found in a fraction of the time; whether it is must be validated. Nothing: there is no crowd.
// Colour refinement (Weisfeiler, Leman, 1968) finds who is alike.
std::optional<Problem> without_crowds(const Domain& domain, const Problem& problem,
                                      const std::set<PlanStep>& forbidden);

}  // namespace stampede::symbolic
