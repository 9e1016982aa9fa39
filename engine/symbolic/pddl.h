// PDDL text: writing what Fast Downward and VAL accept, and reading it back.
#pragma once

#include <string>
#include <string_view>

#include "engine/symbolic/task_planner.h"

namespace stampede {

// Names: `chest.top_drawer` is written `chest--top_drawer`, one to one; everything in lower case; every variable and
// object has a type, `object` where nothing is narrower; the emitted requirements are exactly those used. Traits become
// unary predicates in preconditions. Same domain, same bytes.
// `not_complete`: what success asks beside the goal, as a comment `; not complete: …` before it.
// Throws Error for names that PDDL does not have (or keeps for itself), or that differ only in case.
std::string to_pddl(const Domain& domain);
std::string to_pddl(const Problem& problem, const Domain& domain, const std::string& not_complete = {});
std::string to_pddl(const Formula& formula);
std::string to_pddl_name(std::string_view name);  // chest.top_drawer: chest--top_drawer
std::string to_pddl(const Plan& plan);        // one `(open chest--top_drawer)` a line: the names of the problem's text
std::string to_text(const Formula& formula);  // with our names, for messages: (open chest.top_drawer)

// PDDL 2.2 without numbers and time, from any author: `:adl` and its parts, derived predicates, and action costs that
// are whole numbers or functions of objects whose values the problem states. Nested `when` and `forall` effects are
// flattened. A cost of an action is honoured whether or not the problem states a metric.
// Throws Error with file, line, column and cure; also for `either`, names that differ only in case, a missing goal or
// `(:goal ())` (`(:goal (and))` asks for nothing), types that cannot fit, derived facts in init, lists nested deeper
// than 500. Reading what was written gives an equal value.
Domain domain_from_pddl(std::string_view text, const std::string& file);
Problem problem_from_pddl(std::string_view text, const std::string& file, const Domain& domain);
Formula formula_from_pddl(std::string_view text, const std::string& place);
// One `(action argument …)` a line, with or without a time before it (`0.0: (pick cup table) [1]`); comments after `;`.
// Names as in PDDL or as in ours: `chest--top_drawer` and `chest.top_drawer` are one.
Plan plan_from_text(std::string_view text, const std::string& file);

// The domain under the name `stampede-HASH`, of its own content: equal domains have equal names, and bytes.
Domain named_by_content(Domain domain);

// What a problem needs of its domain: the actions that can come about from its start and bear on its goal, the
// predicates, traits and functions that these, the goal and derived predicates in use mention, and the types of what
// remains. A plan of one is a plan of the other.
Domain task_sized(const Domain& domain, const Problem& problem);
// The problem without facts and values that the (task-sized) domain has no words for.
Problem restricted(Problem problem, const Domain& domain);

}  // namespace stampede
