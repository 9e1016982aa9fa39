// Satisficing planning over a domain and a problem.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "engine/symbolic/symbols.h"

namespace stampede {

std::string to_text(const Plan& plan);  // one `(pick block1 table)` a line

struct PlanLimits {
  std::int64_t expansions = 1'000'000;
  std::int64_t memory_bytes = 2'000'000'000;
  std::int64_t improve =
      20'000;  // expansions: at most so many for a second plan, and as many to shorten the better one
};

enum class PlanEnd {
  solved,
  unsolvable,       // proved: no plan exists without the forbidden actions
  expansion_limit,  // given up: there may be one
  memory_limit,     // given up, in grounding or in search
  no_answer,        // another's program ended without a plan, for reasons of its own
};
std::string to_text(PlanEnd end);  // `solved`, `unsolvable (proved)`, `gave up at the limit of expansions`, … of memory

struct PlanOutcome {
  bool solved = false;
  Plan plan;
  std::string explanation;  // not solved: the goal literal and the missing action or fact, for people
  std::int64_t expanded = 0, evaluated = 0;
  PlanEnd end = PlanEnd::unsolvable;
  std::int64_t cost = 0;  // of the plan
};

// Grounds by relaxed reachability, then lazy greedy best-first search with h_FF, open goals, landmarks and preferred
// operators (Hoffmann, Nebel, JAIR 2001, doi:10.1613/jair.855; Helmert, JAIR 2006, doi:10.1613/jair.1705; Richter,
// Westphal, JAIR 2010, doi:10.1613/jair.2972); where that is long without a plan, best-first width search (Lipovetzky,
// Geffner, AAAI 2017); then improves the plan's cost. Of crowds of objects that nothing tells apart a few are tried
// first; such a plan is validated with all. A goal that already holds has the empty plan. `forbidden`: ground
// actions not to be used. Repeatable: a pure function of its arguments.
PlanOutcome solve(const Domain& domain, const Problem& problem, const PlanLimits& limits = {},
                  const std::set<PlanStep>& forbidden = {});

// Up to `k` plans, the first as `solve` finds it; no two take the same ground actions, in whatever order. Fewer when
// there are no more, or when `limits.expansions` are spent by all together.
std::vector<Plan> solve_many(const Domain& domain, const Problem& problem, int k, const PlanLimits& limits = {});

// The sum of the steps' costs. Throws Error for unknown actions and for cost functions without a value.
std::int64_t plan_cost(const Domain& domain, const Problem& problem, const Plan& plan);

struct Validation {
  bool valid = false;
  int failed_step = -1;     // -1: all steps apply (then the goal is what fails)
  std::string explanation;  // first action and precondition that fail, or the goal literals that do
};
Validation validate(const Domain& domain, const Problem& problem, const Plan& plan);

}  // namespace stampede
