#include "engine/symbolic/symbols.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/symbolic/evaluation.h"
#include "engine/symbolic/solutions.h"

namespace stampede {

std::string to_text(const Fact& fact) {
  std::string text = "(" + fact.predicate;
  for (const std::string& argument : fact.arguments) text += " " + argument;
  return text + ")";
}

Formula atom(std::string predicate, std::vector<Term> terms) {
  Formula formula;
  formula.kind = Formula::Kind::atom;
  formula.predicate = std::move(predicate);
  formula.terms = std::move(terms);
  return formula;
}

Formula negation(Formula part) {
  Formula formula;
  formula.kind = Formula::Kind::negation;
  formula.parts.push_back(std::move(part));
  return formula;
}

namespace {

Formula of_parts(Formula::Kind kind, Formula::Kind of_none, std::vector<Formula> parts) {
  if (parts.size() == 1) return std::move(parts.front());
  Formula formula;
  formula.kind = parts.empty() ? of_none : kind;
  formula.parts = std::move(parts);
  return formula;
}

template <typename Named>
const Named* find_named(const std::vector<Named>& sorted, const std::string& name) {
  for (const Named& one : sorted) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

}  // namespace

Formula conjunction(std::vector<Formula> parts) {
  return of_parts(Formula::Kind::conjunction, Formula::Kind::always, std::move(parts));
}

Formula disjunction(std::vector<Formula> parts) {
  return of_parts(Formula::Kind::disjunction, Formula::Kind::never, std::move(parts));
}

bool Domain::is_a(const std::string& type, const std::string& ancestor) const {
  if (ancestor.empty() || ancestor == "object" || type == ancestor) return true;
  std::string at = type;
  for (std::size_t steps = 0; steps <= types.size(); ++steps) {  // bounded: a cycle must not hang us
    const auto found = types.find(at);
    if (found == types.end()) return false;
    at = found->second;
    if (at == ancestor) return true;
  }
  return false;
}

const Predicate* Domain::predicate(const std::string& predicate_name) const {
  return find_named(predicates, predicate_name);
}

const Action* Domain::action(const std::string& action_name) const { return find_named(actions, action_name); }

bool holds(const Formula& formula, const Facts& facts, const Domain& domain, const std::vector<TypedObject>& objects,
           const Binding& binding) {
  Binding local = binding;
  return symbolic::evaluate(formula, {facts, domain, objects}, local);
}

Facts apply(const Action& action, const std::vector<std::string>& arguments, const Facts& facts, const Domain& domain,
            const std::vector<TypedObject>& objects) {
  if (arguments.size() != action.parameters.size()) {
    throw Error(action.name, "takes " + std::to_string(action.parameters.size()) + " arguments, got " +
                                 std::to_string(arguments.size()));
  }
  Facts basic;
  for (const Fact& fact : facts) {
    const Predicate* predicate = domain.predicate(fact.predicate);
    if (predicate == nullptr || predicate->kind != PredicateKind::derived) basic.insert(fact);
  }
  std::set<std::string> needed;
  for (const Effect& effect : action.effects) symbolic::collect_derived(effect.when, domain, needed);
  const std::vector<Fact> derived = symbolic::add_derived(basic, domain, objects, needed);
  const symbolic::Change change = symbolic::change_of(action, arguments, {basic, domain, objects});
  for (const Fact& fact : derived) basic.erase(fact);
  for (const Fact& fact : change.removed) basic.erase(fact);
  basic.insert(change.added.begin(), change.added.end());  // after the removals: PDDL lets an addition win
  return basic;
}

namespace symbolic {

Change change_of(const Action& action, const std::vector<std::string>& arguments, const View& view) {
  Binding binding;
  for (std::size_t i = 0; i < arguments.size(); ++i) binding[action.parameters[i].name] = arguments[i];
  Change change;
  for (const Effect& effect : action.effects) {
    for_each_solution(effect.forall, negation_normal(effect.when), view, binding, [&] {
      (effect.negated ? change.removed : change.added).insert(ground_atom(effect.predicate, effect.terms, binding));
      return true;
    });
  }
  return change;
}

}  // namespace symbolic

}  // namespace stampede
