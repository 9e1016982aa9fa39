// Plans on what is known. Where that is not enough, what nobody could see so far is assumed.
#pragma once

#include <functional>

#include "engine/base/random.h"
#include "engine/start/planning.h"
#include "engine/symbolic/task_planner.h"

namespace stampede {

// What may be assumed: facts that nobody could see so far, of things of which nothing is known that could change.
Facts conceivable(const FactTracker& facts);

// What nobody could see so far and is not assumed all the same, for something else is known of its first thing.
struct NotAssumed {
  Fact fact, known;
};
std::vector<NotAssumed> not_assumed(const FactTracker& facts);
// Those that an explanation misses, why there is no plan: `; nobody can see whether (lies_at ball place1), but …`.
std::string why_not_assumed(const std::vector<NotAssumed>& facts, const std::string& explanation);

// The start of `problem` as it is known, with what of `assumed` may still be so.
void keep_known(Problem& problem, const FactTracker& facts, const Facts& assumed);

struct AssumingPlan {
  PlanOutcome outcome;
  Facts assumed;  // what the plan rests on; empty: known facts alone
};

// A plan on what is known; failing that, on one conceivable fact of each thing too, combined in an order drawn from
// `key`. What the plan does not need is not assumed. Without a plan: the outcome of what is known.
AssumingPlan plan_assuming(const PlanningTask& known, const Facts& conceivable, RandomKey key,
                           const std::function<PlanOutcome(const PlanningTask&)>& planner);

}  // namespace stampede
