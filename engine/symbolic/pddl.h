// PDDL text: writing what Fast Downward and VAL accept, and reading it back.
#pragma once

#include <string>
#include <string_view>

#include "engine/symbolic/task_planner.h"

namespace stampede {

// Names: `chest.top_drawer` is written `chest--top_drawer`, one to one; everything in lower case; the emitted
// requirements are exactly those used. Traits become unary predicates in preconditions. Same domain, same bytes.
std::string to_pddl(const Domain& domain);
std::string to_pddl(const Problem& problem, const Domain& domain);
std::string to_pddl(const Formula& formula);

// Throws Error with file, line, column and cure. Reading what was written gives an equal value.
Domain domain_from_pddl(std::string_view text, const std::string& file);
Problem problem_from_pddl(std::string_view text, const std::string& file, const Domain& domain);
Formula formula_from_pddl(std::string_view text, const std::string& place);
Plan plan_from_text(std::string_view text, const std::string& file);

}  // namespace stampede
