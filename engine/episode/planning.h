// From a task and the facts to a planning problem, ordered goals included.
#pragma once

#include "engine/episode/fact_tracker.h"
#include "engine/episode/interfaces.h"

namespace stampede {

struct PlanningTask {
  Domain domain;
  Problem problem;
};

// `reached` parts of an ordered goal are done already. An ordered goal becomes fluents `stage_1 …` that conditional
// effects advance, and `out_of_order`, which must stay false; each part must be a conjunction of ground literals.
PlanningTask planning_task(const Task& task, const Domain& domain, const FactTracker& facts, int reached);

// The plan that a task's explicit `steps` mean at this moment: missing trailing arguments (empty names) are bound by
// the precondition. Throws Error when nothing or more than one binding fits, with the candidates.
PlanStep resolve_step(const PlanStep& step, const Domain& domain, const FactTracker& facts);

}  // namespace stampede
