// Plans made with a learned domain, run by the engine.
#pragma once

#include <vector>

#include "db/research/physics.h"
#include "scripting/library/roots.h"

namespace stampede::program {

// The held-out episodes again, from their tasks, variations and seeds, with this planner in place of ours (empty:
// ours), and replanning by it: failed skills are tried again as `stampede run` does. In the episodes' order. Goals that
// must be reached in an order are planned for without it: learned domains have no words for that.
// Throws Error for tasks that the scripts do not have.
std::vector<research::PhysicalRun> run_in_physics(const std::vector<research::HeldOutEpisode>& episodes,
                                                  const Roots& roots, int workers,
                                                  const research::TrueWordsPlanner& planner);

}  // namespace stampede::program
