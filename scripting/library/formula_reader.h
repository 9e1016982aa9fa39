// Literals, formulas and effects of definition files as C++ values, with every rule on them checked.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/geometry/value.h"
#include "engine/start/declared.h"
#include "engine/start/task.h"

namespace stampede {

// Where a formula stands. A schema (skill, predicate) has parameters and no objects; a task has objects.
struct FormulaContext {
  std::string file;   // `tasks/stack.lua`; lines come from the values
  std::string field;  // `goal`
  const Domain* domain = nullptr;
  bool schema = false;
  std::vector<Parameter> parameters;
  const std::map<std::string, PredicateTraits>* traits = nullptr;  // by predicate
  std::string hand = "panda.hand";                                 // fills the place of a hand that the author left out
  std::function<std::vector<std::string>(const std::string& group)> expand;  // members of `block*`; throws Error
  std::function<std::optional<std::string>(const std::string& object)> object_fault;  // nothing: any name is fine
  std::function<std::optional<std::string>(const std::string& part)> part_fault;      // of `?x.part`
};

// Does it say of something that it is held? Then nobody can want the hand to be empty as well: what is `implied` in it
// is left out.
bool asks_for_held(const Value& node, const FormulaContext& context);

// All throw Error (file:line: field: complaint, cure) at the first fault.
Formula formula_from(const Value& node, const FormulaContext& context);
std::vector<Formula> stages_from(const Value& node, const FormulaContext& context);  // in_order at the top; else empty
std::vector<Effect> effects_from(const Value& node, const FormulaContext& context);
// What holds at the start: is and is_not, groups expanded, in the author's order; and other formulas, as one.
struct Beginning {
  std::vector<Literal> literals;
  std::optional<Formula> constraint;
};
Beginning beginning_from(const Value& node, const FormulaContext& context);

// `name: type & trait & trait`; a word that is neither is an Error.
Parameter parameter_from(const std::string& text, const Domain& domain, const std::string& place);

// Index of a predicate's one parameter of type hand, -1 when there is none.
int hand_position(const std::vector<Parameter>& parameters, const Domain& domain);

}  // namespace stampede
