// What a stored episode says in symbols, at any of its frames; no scripts are needed.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/bddl/export.h"
#include "engine/record/record.h"
#include "engine/start/abstract_state.h"
#include "engine/symbolic/task_planner.h"

namespace stampede {

struct StoredSymbols {
  Domain domain;
  Problem problem;  // as the episode began
};

// Throws Error for an episode without a problem: no start was found.
StoredSymbols read_symbols(const EpisodeRecord& episode);

// The same problem with the facts of a frame. `known`: with what was known to hold instead.
Problem problem_at(const StoredSymbols& symbols, const AbstractState& state, bool known = false);
// As comment lines: what holds and is not known, what was believed and is not so.
std::string unknown_facts(const AbstractState& state, const Domain& domain);

// One frame of an episode, with all that tells what it means. Lifetime: that of its parts.
struct EpisodeMoment {
  const EpisodeRecord& episode;
  const Scene& scene;
  const StoredSymbols& symbols;
  const AbstractState& state;  // at that frame
};

// The moment as a BDDL problem. `leave_out`: predicates whose atoms are taken out of the goal where it is a
// conjunction; remarks say so.
BddlExport bddl_at(const EpisodeMoment& moment, const BddlMapping& mapping, const std::vector<std::string>& leave_out);
// With comments before the text: what its words mean compared to ours, and what is not in it.
std::string with_notes(const BddlExport& result);
// The same by each of these mappings. What a dialect cannot say goes to `refusals`, a line each.
std::string bddl_text(const EpisodeMoment& moment, const std::vector<BddlMapping>& mappings,
                      const std::vector<std::string>& leave_out, std::string& refusals);

// Frames at which skills begin and end, in order: 0, each boundary, the last one.
struct Boundary {
  std::int64_t frame = 0;
  Plan rest;  // skills executed from here on
};
std::vector<Boundary> skill_boundaries(const EpisodeRecord& episode, const Domain& domain);

}  // namespace stampede
