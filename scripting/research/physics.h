// Plans made with a learned domain, run by the engine.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/record/record.h"
#include "scripting/library/roots.h"
#include "scripting/research/symbols_of.h"

namespace stampede::research {

// Plans for a problem in true words; what it says is executed.
using TrueWordsPlanner = std::function<PlanOutcome(const Domain& truth, const Problem& problem)>;

struct PhysicalRun {
  bool success = false;
  std::string reason, detail;  // as in catalogues; `refused_call`: no skill takes the arguments of a step
};

// The held-out episodes again, from their tasks, variations and seeds, with this planner in place of ours (empty:
// ours), and replanning by it: failed skills are tried again as `stampede run` does. In the episodes' order. Goals that
// must be reached in an order are planned for without it: learned domains have no words for that.
// Throws Error for tasks that the scripts do not have.
std::vector<PhysicalRun> run_in_physics(const std::vector<HeldOutEpisode>& episodes, const Roots& roots, int workers,
                                        const TrueWordsPlanner& planner);

}  // namespace stampede::research
