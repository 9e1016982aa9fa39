#include "engine/learning/literals.h"

#include <algorithm>

#include "engine/symbolic/evaluation.h"
#include "engine/symbolic/pddl.h"

namespace stampede::learning {
namespace {

// False: it names a variable that is no parameter.
bool lift(const std::string& predicate, const std::vector<Term>& terms, const Action& action, LiftedAtom& atom) {
  atom = {predicate, {}};
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (!terms[i].variable) {
      atom.predicate += "@" + std::to_string(i + 1) + "=" + terms[i].name;
      continue;
    }
    const auto at = std::find_if(action.parameters.begin(), action.parameters.end(),
                                 [&](const Parameter& one) { return one.name == terms[i].name; });
    if (at == action.parameters.end()) return false;
    atom.slots.push_back(static_cast<int>(at - action.parameters.begin()));
  }
  return true;
}

void collect(const Formula& formula, const Action& action, ActionLiterals& found) {
  using Kind = Formula::Kind;
  if (formula.kind == Kind::always) return;
  if (formula.kind == Kind::conjunction) {
    for (const Formula& part : formula.parts) collect(part, action, found);
    return;
  }
  const bool negated = formula.kind == Kind::negation;
  const Formula& inner = negated ? formula.parts.front() : formula;
  if (inner.kind == Kind::equal) return;
  LiftedLiteral literal;
  literal.negated = negated;
  if (inner.kind == Kind::atom && lift(inner.predicate, inner.terms, action, literal.atom)) {
    found.precondition.insert(std::move(literal));
  } else {
    found.compound.push_back(formula);
  }
}

}  // namespace

ActionLiterals literals_of(const Action& action) {
  ActionLiterals found;
  for (std::size_t i = 0; i < action.parameters.size(); ++i)
    for (const std::string& trait : action.parameters[i].traits)
      found.precondition.insert({{trait, {static_cast<int>(i)}}, false});
  collect(symbolic::negation_normal(action.precondition), action, found);
  for (const Effect& effect : action.effects) {
    if (!effect.forall.empty() || effect.when.kind != Formula::Kind::always) continue;
    LiftedLiteral literal;
    literal.negated = effect.negated;
    if (lift(effect.predicate, effect.terms, action, literal.atom)) found.effect.insert(std::move(literal));
  }
  return found;
}

bool replaced(LiftedLiteral& literal, const std::vector<int>& slot_of) {
  for (int& slot : literal.atom.slots) {
    slot = slot_of[static_cast<std::size_t>(slot)];
    if (slot < 0) return false;
  }
  return true;
}

Formula formula_of(const LiftedLiteral& literal, const Action& action) {
  std::vector<Term> terms;
  const std::string& name = literal.atom.predicate;
  std::size_t at = name.find('@');
  const std::string predicate = name.substr(0, at);
  std::size_t next_slot = 0;
  const auto add_slot = [&] {
    terms.push_back({true, action.parameters[static_cast<std::size_t>(literal.atom.slots[next_slot++])].name});
  };
  while (at != std::string::npos) {
    const std::size_t equals = name.find('=', at), end = name.find('@', equals);
    const std::size_t place = std::stoul(name.substr(at + 1, equals - at - 1));
    while (terms.size() + 1 < place) add_slot();
    terms.push_back({false, name.substr(equals + 1, end == std::string::npos ? end : end - equals - 1)});
    at = end;
  }
  while (next_slot < literal.atom.slots.size()) add_slot();
  Formula formula = atom(predicate, std::move(terms));
  return literal.negated ? negation(std::move(formula)) : formula;
}

std::string to_text(const LiftedLiteral& literal, const Action& action) {
  return stampede::to_text(formula_of(literal, action));
}

}  // namespace stampede::learning
