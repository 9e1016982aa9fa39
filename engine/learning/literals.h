// An action as literals over its parameters. Room-internal.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "engine/learning/lifting.h"

namespace stampede::learning {

struct LiftedLiteral {
  LiftedAtom atom;
  bool negated = false;
  friend auto operator<=>(const LiftedLiteral&, const LiftedLiteral&) = default;
};
using Literals = std::set<LiftedLiteral>;

// A constant stands in the predicate's name (`on@2=table`).
struct ActionLiterals {
  Literals precondition;          // traits of parameters among them; no (in)equalities
  Literals effect;                // unconditional ones
  std::vector<Formula> compound;  // further parts of the precondition: quantified, disjunctions
};
ActionLiterals literals_of(const Action& action);

// The literal with its slots replaced; nothing where one of them has no place.
bool replaced(LiftedLiteral& literal, const std::vector<int>& slot_of);
Formula formula_of(const LiftedLiteral& literal, const Action& action);  // over the action's parameters
std::string to_text(const LiftedLiteral& literal, const Action& action);

}  // namespace stampede::learning
