#include "engine/learning/calls.h"

#include <algorithm>

#include "engine/symbolic/pddl_text.h"
#include "engine/symbolic/solutions.h"

namespace stampede::learning {

std::set<Call> applicable_calls(const Action& action, const symbolic::View& view) {
  std::vector<Formula> parts = symbolic::trait_guards(action.parameters);
  for (Formula& one : symbolic::inequalities(action, view.domain)) parts.push_back(std::move(one));
  parts.push_back(action.precondition);
  std::set<Call> found;
  Binding binding;
  symbolic::for_each_solution(action.parameters, symbolic::negation_normal(conjunction(std::move(parts))), view,
                              binding, [&] {
                                Call call;
                                for (const Parameter& one : action.parameters) call.push_back(binding.at(one.name));
                                found.insert(std::move(call));
                                return found.size() < kMostCalls;
                              });
  return found;
}

Facts in_words_of(const Domain& domain, const Facts& facts, const std::vector<TypedObject>& objects) {
  Facts basic;
  for (const Fact& fact : facts) {
    const Predicate* predicate = domain.predicate(fact.predicate);
    const bool trait = std::find(domain.traits.begin(), domain.traits.end(), fact.predicate) != domain.traits.end();
    const bool known = trait || (predicate != nullptr && predicate->parameters.size() == fact.arguments.size());
    if (known && (trait || predicate->kind != PredicateKind::derived)) basic.insert(fact);
  }
  return with_derived(basic, domain, objects);
}

GroundChange change_by(const Action& action, const Call& call, const Domain& domain, const Facts& facts,
                       const std::vector<TypedObject>& objects) {
  const Facts after = with_derived(apply(action, call, facts, domain, objects), domain, objects);
  GroundChange change;
  std::set_difference(after.begin(), after.end(), facts.begin(), facts.end(),
                      std::inserter(change.added, change.added.end()));
  std::set_difference(facts.begin(), facts.end(), after.begin(), after.end(),
                      std::inserter(change.removed, change.removed.end()));
  return change;
}

}  // namespace stampede::learning
