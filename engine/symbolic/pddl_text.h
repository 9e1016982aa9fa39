// Small pieces that reading and writing PDDL share: names and formulas as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/nearest.h"
#include "engine/symbolic/symbols.h"

namespace stampede::symbolic {

// plain: `chest.top_drawer`, for messages; pddl: `chest--top_drawer`, lower case.
enum class Names { plain, pddl };

std::string name_text(std::string_view name, Names names);
std::string name_from_pddl(std::string_view name);
// ?a - block ?b - object; as plain text without `- object` where nothing is typed. VAL's type checker takes no untyped
// variable in a typed domain.
std::string variables_text(const std::vector<Parameter>& variables, Names names);
std::string atom_text(const std::string& predicate, const std::vector<Term>& terms, Names names);
std::string formula_text(const Formula& formula, Names names);
// Whether this is how `always` (a forall) or `never` (an exists) is written inside another formula.
bool is_constant(const Formula& formula, Formula::Kind quantifier);

// One conjunct for each trait of each parameter, in order: what a quantifier or an action says before its own formula.
std::vector<Formula> trait_guards(const std::vector<Parameter>& parameters);
// Pairs of parameters that must differ (Action::distinct) and could be the same object, as inequalities.
std::vector<Formula> inequalities(const Action& action, const Domain& domain);
bool could_be_equal(const Parameter& a, const Parameter& b, const Domain& domain);

// A letter; then letters, digits, `_` and `-`, as PDDL's names are. `4` and `0.25` are none.
bool is_pddl_name(std::string_view name);

// Throws Error for names that PDDL does not have or keeps for itself, and for two that differ only in case.
void check_names(const Domain& domain);
void check_names(const Problem& problem);

using stampede::did_you_mean;

}  // namespace stampede::symbolic
