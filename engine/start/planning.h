// From a task and the facts to a planning problem, ordered goals included.
#pragma once

#include "engine/start/fact_tracker.h"
#include "engine/start/task.h"

namespace stampede {

struct PlanningTask {
  Domain domain;
  Problem problem;
};

// Found while a ground action was tried: this thing was in its way. `facts` say where it is; an action that ends one of
// them moves it out of the way.
struct Obstruction {
  PlanStep action;
  std::string blocker;
  std::vector<Fact> facts;
  Vector3 at = Vector3::Zero();  // where it was: elsewhere it is no longer in the way
};

// `reached` parts of an ordered goal are done already. An ordered goal becomes fluents `stage_1 …` that conditional
// effects advance, and `out_of_order`, which must stay false; each part must be a conjunction of ground literals.
// Obstructions become fluents `obstructed_1 …` that must end before their action; without any the problem is the plain
// one that catalogues keep. Relations that the goal asks for (relations.h) become effects of the skills that make them;
// `by_any`: whichever of their things these put down, not the first alone.
PlanningTask planning_task(const Task& task, const Domain& domain, const FactTracker& facts, int reached,
                           const std::vector<Obstruction>& obstructions = {}, bool by_any = false);

// A ground action drawn at random: each action that has any with equal chance, then each binding of its parameters to
// objects of their types and traits; with `applicable` only those whose precondition holds. Result: nothing when no
// action has one.
std::optional<PlanStep> random_step(const Domain& domain, const FactTracker& facts, bool applicable, RandomKey key);

// The goal and the facts as a problem of the world's own domain, whatever is asked beside the goal.
Problem world_problem(const Task& task, const FactTracker& facts);
// What success asks beside the goal, in words: its parts in order, the task's own test. Empty: nothing.
std::string beside_goal(const Task& task);

// The plan that a task's explicit `steps` mean at this moment: missing trailing arguments (empty names) are bound by
// the precondition. Throws Error when nothing or more than one binding fits, with the candidates.
PlanStep resolve_step(const PlanStep& step, const Domain& domain, const FactTracker& facts);

}  // namespace stampede
