// Lazy greedy best-first search, and what shortens its plans.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/symbolic/heuristic.h"

namespace stampede::symbolic {

struct SearchResult {
  bool solved = false, exhausted = false;  // exhausted: the whole reachable space was seen
  std::vector<int> plan;                   // operators
  std::int64_t expanded = 0, evaluated = 0;
};

// From `start` until `goal` holds (the heuristic is for the task's own goal).
SearchResult lazy_greedy(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic,
                         const PlanLimits& limits);

// Removes what the goal does not need, then looks for shorter ways between states of the plan; never longer.
std::vector<int> shorten(const GroundTask& task, const Semantics& semantics, std::vector<int> plan,
                         std::int64_t expansions);

// Why the goal cannot be reached, for people.
std::string explain_unsolvable(const GroundTask& task, const SearchResult& result, const PlanLimits& limits);

int cost_of(const GroundTask& task, int op);

}  // namespace stampede::symbolic
