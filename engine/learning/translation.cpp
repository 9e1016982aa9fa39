// A learned domain in true words.
#include <algorithm>
#include <optional>

#include "engine/learning/abstraction.h"
#include "engine/symbolic/evaluation.h"

namespace stampede::learning {
namespace {

const PredicateLink* link_to(const Mapping& mapping, const std::string& learned) {
  for (const PredicateLink& one : mapping.links)
    if (one.learned == learned && !one.parts.empty()) return &one;
  return nullptr;
}

// A true type, a true trait, or nothing.
Parameter in_true_types(Parameter parameter, const Mapping& mapping, const Domain& truth) {
  for (const TypeLink& one : mapping.types) {
    if (one.learned != parameter.type || one.truth.empty()) continue;
    const bool type = truth.types.contains(one.truth);
    return {parameter.name, type ? one.truth : "object",
            type ? std::vector<std::string>{} : std::vector<std::string>{one.truth}};
  }
  if (!truth.types.contains(parameter.type)) parameter.type = "object";
  parameter.traits.clear();
  return parameter;
}

class ActionTranslation {
 public:
  ActionTranslation(const Action& learned, const Mapping& mapping, const Domain& truth, std::vector<std::string>& notes)
      : mapping_(mapping), truth_(truth), notes_(notes), action_(learned) {
    for (Parameter& one : action_.parameters) add_parameter(one);
    own_ = action_.parameters.size();
    Formula condition = symbolic::negation_normal(learned.precondition);
    for (const Parameter& one : learned.parameters)
      for (const std::string& trait : one.traits)
        condition = conjunction({atom(trait, {{true, one.name}}), std::move(condition)});
    action_.precondition = condition_of(condition);
    for (Formula& guard : guards_) action_.precondition = conjunction({guard, action_.precondition});
    action_.effects.clear();
    for (const Effect& effect : learned.effects) add_effects(effect);
    action_.cost_function.clear();
    action_.cost = 1;
    keep_distinct();
  }
  Action result() { return std::move(action_); }

 private:
  void note(const std::string& text) { notes_.push_back(action_.name + ": " + text); }

  // Traits become conditions, as the translated domain knows them as plain predicates.
  void add_parameter(Parameter& parameter) {
    parameter = in_true_types(parameter, mapping_, truth_);
    for (const std::string& trait : parameter.traits) guards_.push_back(atom(trait, {{true, parameter.name}}));
    parameter.traits.clear();
  }

  // The parameter that stands for the only object of a type; made when it is first needed.
  Term only_one(const std::string& type) {
    for (const Parameter& one : action_.parameters)
      if (one.type == type) return {true, one.name};
    action_.parameters.push_back({"the_" + type, type, {}});
    return {true, "the_" + type};
  }

  // The true atom of a part; arguments that nothing stands for are variables, added to `open`.
  Formula atom_of(const LinkPart& part, const std::vector<Term>& terms, std::vector<Parameter>& open) {
    std::vector<Term> said;
    for (std::size_t i = 0; i < part.argument_of.size(); ++i) {
      if (part.argument_of[i] >= 0) {
        said.push_back(terms.at(static_cast<std::size_t>(part.argument_of[i])));
      } else if (!part.only_of[i].empty()) {
        said.push_back(only_one(part.only_of[i]));
      } else {
        open.push_back({"some_" + std::to_string(++variables_), "object", {}});
        said.push_back({true, open.back().name});
      }
    }
    return atom(part.truth, std::move(said));
  }

  Formula literal_of(const LinkPart& part, const std::vector<Term>& terms) {
    std::vector<Parameter> open;
    Formula formula = atom_of(part, terms, open);
    if (!open.empty()) {
      Formula some;
      some.kind = Formula::Kind::exists;
      some.variables = std::move(open);
      some.parts = {std::move(formula)};
      formula = std::move(some);
    }
    return part.negated ? negation(std::move(formula)) : formula;
  }

  // In negation normal form. What means nothing asks for nothing.
  Formula condition_of(const Formula& formula) {
    using Kind = Formula::Kind;
    if (formula.kind == Kind::atom) return meaning_of(formula).value_or(Formula{});
    if (formula.kind == Kind::negation && formula.parts[0].kind == Kind::atom) {
      std::optional<Formula> inner = meaning_of(formula.parts[0]);
      return inner ? negation(std::move(*inner)) : Formula{};
    }
    Formula result = formula;
    for (Formula& part : result.parts) part = condition_of(part);
    std::vector<Formula> typed;
    for (Parameter& one : result.variables) {
      one = in_true_types(one, mapping_, truth_);
      for (const std::string& trait : one.traits) typed.push_back(atom(trait, {{true, one.name}}));
      one.traits.clear();
    }
    if (!typed.empty()) guard(result, std::move(typed));
    return result;
  }

  static void guard(Formula& quantified, std::vector<Formula> typed) {
    if (quantified.kind == Formula::Kind::exists) {
      typed.push_back(quantified.parts[0]);
      quantified.parts[0] = conjunction(std::move(typed));
    } else {
      std::vector<Formula> either = {negation(conjunction(std::move(typed))), quantified.parts[0]};
      quantified.parts[0] = disjunction(std::move(either));
    }
  }

  std::optional<Formula> meaning_of(const Formula& formula) {
    const PredicateLink* link = link_to(mapping_, formula.predicate);
    if (link == nullptr) {
      note("`" + formula.predicate + "` is left out of the condition: it means nothing");
      return std::nullopt;
    }
    std::vector<Formula> parts;
    for (const LinkPart& one : link->parts) parts.push_back(literal_of(one, formula.terms));
    return conjunction(std::move(parts));
  }

  void add_effects(const Effect& effect) {
    const PredicateLink* link = link_to(mapping_, effect.predicate);
    if (link == nullptr) return note("`" + effect.predicate + "` is left out of the effects: it means nothing");
    for (const LinkPart& part : link->parts) {
      Effect one;
      for (const Parameter& variable : effect.forall) {
        one.forall.push_back(in_true_types(variable, mapping_, truth_));
        one.forall.back().traits.clear();
      }
      one.when = condition_of(symbolic::negation_normal(effect.when));
      std::vector<Parameter> open;
      Formula changed = atom_of(part, effect.terms, open);
      one.predicate = std::move(changed.predicate);
      one.terms = std::move(changed.terms);
      one.negated = effect.negated != part.negated;
      if (!open.empty() && !one.negated) {
        note("`" + effect.predicate + "` is left out of the effects: it does not say of what `" + part.truth +
             "` becomes true");
        continue;
      }
      one.forall.insert(one.forall.end(), open.begin(), open.end());
      action_.effects.push_back(std::move(one));
      if (effect.negated) return;  // of a conjunction that no longer holds, the first part
    }
  }

  // Parameters that were added may be equal to any.
  void keep_distinct() {
    if (!action_.distinct) return;
    for (std::size_t i = own_; i < action_.parameters.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        action_.may_equal.emplace_back(action_.parameters[j].name, action_.parameters[i].name);
  }

  const Mapping& mapping_;
  const Domain& truth_;
  std::vector<std::string>& notes_;
  Action action_;
  std::size_t own_ = 0;
  std::vector<Formula> guards_;
  int variables_ = 0;
};

// Makes a true predicate derived where the learned domain derives the one that means it, and nothing else does.
void derive(Domain& domain, const Predicate& learned, const Mapping& mapping, const Domain& truth,
            std::vector<std::string>& notes) {
  const PredicateLink* link = link_to(mapping, learned.name);
  if (link == nullptr || link->parts.size() != 1) return;
  const LinkPart& part = link->parts[0];
  if (part.argument_of.size() != learned.parameters.size()) return;
  const auto at = std::find_if(domain.predicates.begin(), domain.predicates.end(),
                               [&](const Predicate& one) { return one.name == part.truth; });
  if (at == domain.predicates.end() || at->kind == PredicateKind::derived) return;
  Action carrier;
  carrier.name = learned.name;
  carrier.parameters = learned.parameters;
  carrier.precondition = part.negated ? negation(learned.derived) : learned.derived;
  carrier.distinct = false;
  Action translated = ActionTranslation(carrier, mapping, truth, notes).result();
  std::vector<Parameter> parameters;
  for (const int argument : part.argument_of) {
    if (argument < 0) return;
    parameters.push_back(translated.parameters[static_cast<std::size_t>(argument)]);
  }
  if (translated.parameters.size() > parameters.size()) {  // the only ones of their types
    Formula some;
    some.kind = Formula::Kind::exists;
    some.variables.assign(translated.parameters.begin() + static_cast<std::ptrdiff_t>(parameters.size()),
                          translated.parameters.end());
    some.parts = {translated.precondition};
    translated.precondition = std::move(some);
  }
  at->kind = PredicateKind::derived;
  at->parameters = std::move(parameters);
  at->derived = std::move(translated.precondition);
}

}  // namespace

Translation in_true_words(const Domain& learned, const Mapping& mapping, const Domain& truth) {
  Translation result;
  result.domain.name = learned.name;
  result.domain.types = truth.types;
  for (Predicate one : truth.predicates) {
    if (one.kind == PredicateKind::start) continue;
    one.kind = PredicateKind::basic;
    one.derived = {};
    for (Parameter& parameter : one.parameters) parameter = {parameter.name, "object", {}};
    result.domain.predicates.push_back(std::move(one));
  }
  for (const std::string& trait : truth.traits)
    result.domain.predicates.push_back({trait, {{"x", "object", {}}}, PredicateKind::basic, {}, {}});
  std::sort(result.domain.predicates.begin(), result.domain.predicates.end(),
            [](const Predicate& a, const Predicate& b) { return a.name < b.name; });
  for (const Predicate& one : learned.predicates)
    if (one.kind == PredicateKind::derived) derive(result.domain, one, mapping, truth, result.notes);
  for (const Action& one : learned.actions)
    result.domain.actions.push_back(ActionTranslation(one, mapping, truth, result.notes).result());
  return result;
}

}  // namespace stampede::learning
