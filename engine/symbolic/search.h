// Lazy greedy best-first search, and what shortens its plans.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/symbolic/heuristic.h"
#include "engine/symbolic/landmarks.h"

namespace stampede::symbolic {

struct SearchResult {
  bool solved = false, exhausted = false;  // exhausted: the whole reachable space was seen
  std::vector<int> plan;                   // operators
  std::int64_t expanded = 0, evaluated = 0;
};

// From `start` to where `goal` holds. `weight` 0: greedy, alternating between h_FF of the state that is left, and the
// open goals and the landmarks ahead of the one that is entered, each with a list of all successors and one of the
// preferred; otherwise states are ordered by steps so far + weight * h_FF alone, which finds shorter plans more slowly.
// The heuristic must have been given the same goal.
struct Query {
  Words start;
  Literals goal;
  int weight = 0;
  int bound = 0;                            // not 0: states whose steps so far + h_FF reach it are given up
  Landmarks* landmarks = nullptr;           // of this start and goal: counted too by the greedy search
  const std::vector<int>* costs = nullptr;  // by operator, as the heuristic was given; null: each step costs 1
  bool strict = false;                      // goals held too early count as never reached on the whole path
};
SearchResult lazy_search(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic,
                         const PlanLimits& limits, const Query& query);

// Best-first width search, BFWS(f5): states in the order of their novelty among those with as many open goals that have
// had as much of the last relaxed plan, then of their open goals (Lipovetzky, Geffner, AAAI 2017). Finds its way where
// heuristics know no way out of what is crowded. Of the query start and goal count; the heuristic must have been given
// the same goal.
SearchResult width_search(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic,
                          const PlanLimits& limits, const Query& query);

// Removes what the goal does not need; then replaces stretches of the plan by cheaper ones and searches for cheaper
// plans as a whole, with `expansions` in all. Never dearer than the plan given, nor longer at the same cost.
std::vector<int> shorten(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic,
                         std::vector<int> plan, std::int64_t expansions);

// Why the goal cannot be reached, for people.
std::string explain_unsolvable(const GroundTask& task, const SearchResult& result, const PlanLimits& limits);

}  // namespace stampede::symbolic
