#include "engine/start/effects.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "engine/symbolic/evaluation.h"

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

// Takes a formula in negation normal form apart.
class PreconditionLiterals {
 public:
  PreconditionLiterals(const symbolic::View& view, Binding binding) : view_(view), binding_(std::move(binding)) {}

  void add(const Formula& formula, int choice = -1) {
    using Kind = Formula::Kind;
    switch (formula.kind) {
      case Kind::always:
      case Kind::never:
        return;
      case Kind::disjunction:
      case Kind::exists:
        if (choice < 0) choice = choices_++;
        break;
      default:
        break;
    }
    switch (formula.kind) {
      case Kind::exists:
      case Kind::forall:
        symbolic::for_each_binding(formula.variables, view_, binding_, [&] {
          add(formula.parts.at(0), choice);
          return true;
        });
        return;
      case Kind::conjunction:
      case Kind::disjunction:
        for (const Formula& part : formula.parts) add(part, choice);
        return;
      default:
        add_literal(formula, choice);
    }
  }
  std::vector<PreconditionRecord> literals() { return std::move(literals_); }

 private:
  void add_literal(const Formula& formula, int choice) {
    const bool negated = formula.kind == Formula::Kind::negation;
    const Formula& atom = negated ? formula.parts.at(0) : formula;
    const std::string& name = atom.kind == Formula::Kind::equal ? kEqual : atom.predicate;
    Fact fact = symbolic::ground_atom(name, atom.terms, binding_);
    if (!seen_.insert({choice, negated, fact}).second) return;
    const bool held = symbolic::evaluate(formula, view_, binding_);
    literals_.push_back({std::move(fact), negated, held, choice});
  }

  static inline const std::string kEqual = "=";
  const symbolic::View& view_;
  Binding binding_;
  int choices_ = 0;
  std::set<std::tuple<int, bool, Fact>> seen_;
  std::vector<PreconditionRecord> literals_;
};

}  // namespace

std::vector<PreconditionRecord> ground_precondition(const Action& action, const std::vector<std::string>& arguments,
                                                    const Facts& before, const Domain& domain,
                                                    const std::vector<TypedObject>& objects) {
  const symbolic::View view{before, domain, objects};
  PreconditionLiterals found(view, binding_of(action, arguments));
  found.add(symbolic::negation_normal(action.precondition));
  return found.literals();
}

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

std::vector<CountedEffects> counted_effects(const Action& action, const std::vector<std::string>& arguments,
                                            const Facts& before, const Domain& domain,
                                            const std::vector<TypedObject>& objects) {
  std::vector<CountedEffects> counted;
  Binding binding = binding_of(action, arguments);
  for (const Effect& effect : action.effects) {
    if (effect.at_least == 0) continue;
    CountedEffects& one = counted.emplace_back();
    Expansion{before, domain, objects, one.literals}.expand(effect, 0, binding);
    one.enough = std::min(static_cast<std::size_t>(effect.at_least), one.literals.size());
  }
  return counted;
}

}  // namespace stampede
