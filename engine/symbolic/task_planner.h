// Satisficing planning over a domain and a problem.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "engine/symbolic/symbols.h"

namespace stampede {

struct PlanStep {
  std::string action;
  std::vector<std::string> arguments;
  friend auto operator<=>(const PlanStep&, const PlanStep&) = default;
};
using Plan = std::vector<PlanStep>;
std::string to_text(const Plan& plan);  // one `(pick block1 table)` a line

struct PlanLimits {
  std::int64_t expansions = 1'000'000;
  std::int64_t memory_bytes = 2'000'000'000;
  std::int64_t improve = 20'000;  // expansions spent on shortening after the first plan
};

struct PlanOutcome {
  bool solved = false;
  Plan plan;
  std::string explanation;  // not solved: the goal literal and the missing action or fact, for people
  std::int64_t expanded = 0, evaluated = 0;
};

// Grounds by relaxed reachability, then greedy best-first search with h_FF and preferred operators (Hoffmann, Nebel,
// JAIR 2001, doi:10.1613/jair.855; Helmert, JAIR 2006, doi:10.1613/jair.1705), then shortens the plan.
// `forbidden`: ground actions not to be used. Repeatable: a pure function of its arguments.
PlanOutcome solve(const Domain& domain, const Problem& problem, const PlanLimits& limits = {},
                  const std::set<PlanStep>& forbidden = {});

struct Validation {
  bool valid = false;
  int failed_step = -1;     // -1: all steps apply (then the goal is what fails)
  std::string explanation;  // first action and precondition that fail, or the goal literals that do
};
Validation validate(const Domain& domain, const Problem& problem, const Plan& plan);

}  // namespace stampede
