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

// `a b - type c`: from item `from` on. Variables are without their `?`.
std::vector<Parameter> read_typed(const Node& list, std::size_t from, bool variables, const Domain* domain);
Formula read_formula(const Node& node, const std::vector<Parameter>& scope, const Vocabulary& vocabulary);
// One effect or `(and …)` of them, flattened to single literals; costs go to `cost`.
void read_effects(const Node& node, const std::vector<Parameter>& scope, const Vocabulary& vocabulary, Effect outer,
                  std::vector<Effect>& effects, int& cost);
// Moves leading atoms `(trait ?v)` of these variables from a conjunction into the variables' traits.
void take_traits(Formula& formula, std::vector<Parameter>& variables, const Domain* domain);
[[noreturn]] void fail(const Node& node, const std::string& what, const std::string& hint = {});

}  // namespace stampede::symbolic
