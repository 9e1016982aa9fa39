// What it takes to try plans in physics; whoever asks for a score hands it in, so that nothing here runs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "db/research/symbols_of.h"

namespace stampede::research {

// Plans for a problem in true words; what it says is executed.
using TrueWordsPlanner = std::function<PlanOutcome(const Domain& truth, const Problem& problem)>;

struct PhysicalRun {
  bool success = false;
  std::string reason, detail;  // as in catalogues; `refused_call`: no skill takes the arguments of a step
};

// The held-out episodes again, in their order, with this planner in place of the engine's (empty: the engine's).
using RunHeldOut = std::function<std::vector<PhysicalRun>(const std::vector<HeldOutEpisode>& episodes,
                                                          const TrueWordsPlanner& planner)>;

}  // namespace stampede::research
