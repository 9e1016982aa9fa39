#include "engine/episode/effects.h"

#include <algorithm>

namespace stampede {
namespace {

Fact ground(const Effect& effect, const Binding& binding) {
  Fact fact{effect.predicate, {}};
  for (const Term& term : effect.terms) fact.arguments.push_back(term.variable ? binding.at(term.name) : term.name);
  return fact;
}

struct Expansion {
  const Facts& before;
  const Domain& domain;
  const std::vector<TypedObject>& objects;
  std::vector<Literal>& out;

  void expand(const Effect& effect, std::size_t variable, Binding& binding) const {
    if (variable < effect.forall.size()) {
      const Parameter& parameter = effect.forall[variable];
      for (const TypedObject& candidate : objects) {
        if (!parameter.type.empty() && !domain.is_a(candidate.type, parameter.type)) continue;
        const auto has = [&](const std::string& trait) { return before.contains({trait, {candidate.name}}); };
        if (!std::all_of(parameter.traits.begin(), parameter.traits.end(), has)) continue;
        binding[parameter.name] = candidate.name;
        expand(effect, variable + 1, binding);
      }
      binding.erase(parameter.name);
      return;
    }
    if (!holds(effect.when, before, domain, objects, binding)) return;
    Literal literal{ground(effect, binding), effect.negated};
    const auto same = [&](const Literal& other) { return other.fact == literal.fact; };
    const auto found = std::find_if(out.begin(), out.end(), same);
    if (found == out.end())
      out.push_back(std::move(literal));
    else if (!literal.negated)
      found->negated = false;  // PDDL: adding wins over deleting
  }
};

}  // namespace

Binding binding_of(const Action& action, const std::vector<std::string>& arguments) {
  Binding binding;
  for (std::size_t i = 0; i < action.parameters.size() && i < arguments.size(); ++i)
    binding[action.parameters[i].name] = arguments[i];
  return binding;
}

std::vector<Literal> ground_effects(const Action& action, const std::vector<std::string>& arguments,
                                    const Facts& before, const Domain& domain,
                                    const std::vector<TypedObject>& objects) {
  std::vector<Literal> literals;
  Binding binding = binding_of(action, arguments);
  for (const Effect& effect : action.effects) Expansion{before, domain, objects, literals}.expand(effect, 0, binding);
  return literals;
}

}  // namespace stampede
