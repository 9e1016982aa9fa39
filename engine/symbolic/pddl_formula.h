// Formulas, typed lists and effects from parsed PDDL.
#pragma once

#include <string>
#include <vector>

#include "engine/symbolic/pddl_tokens.h"
#include "engine/symbolic/symbols.h"

namespace stampede::symbolic {

// What names are checked against; `domain` null: nothing is checked (a formula by itself).
struct Vocabulary {
  const Domain* domain = nullptr;
  const std::vector<TypedObject>* objects = nullptr;
};

// `a b - type c`: from item `from` on. Variables are without their `?`, and each may be declared once, except where the
// list only says how many there are and of what types: there the second `?x` becomes `?x_2`.
enum class Repeats { refused, renamed };
std::vector<Parameter> read_typed(const Node& list, std::size_t from, bool variables, const Domain* domain,
                                  Repeats repeats = Repeats::refused);
Formula read_atom(const Node& node, const std::vector<Parameter>& scope, const Vocabulary& vocabulary);
Formula read_formula(const Node& node, const std::vector<Parameter>& scope, const Vocabulary& vocabulary);
Term read_term(const Node& node, const std::vector<Parameter>& scope, const Vocabulary& vocabulary);
// A parameter that a term stands for, and the name of whose it is.
struct Slot {
  const Parameter& parameter;
  const std::string& of;
};
// Throws Error where the term can never be of the parameter's type.
void check_type(const Node& node, const Term& term, const Slot& slot, const std::vector<Parameter>& scope,
                const Vocabulary& vocabulary);
// Effects are flattened to single literals, each with its own `forall` and `when`; a cost goes to the action.
void read_effects(const Node& node, const std::vector<Parameter>& scope, const Vocabulary& vocabulary, Action& action);
// Moves leading atoms `(trait ?v)` of these variables from a conjunction into the variables' traits.
void take_traits(Formula& formula, std::vector<Parameter>& variables, const Domain* domain);
[[noreturn]] void fail(const Node& node, const std::string& what, const std::string& hint = {});

}  // namespace stampede::symbolic
