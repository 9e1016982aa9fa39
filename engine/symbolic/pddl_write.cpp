#include <algorithm>
#include <map>
#include <set>

#include "engine/symbolic/pddl.h"
#include "engine/symbolic/pddl_text.h"

// What PDDL has no words for (traits of parameters, skills, labels) is written in comments that start with `;@`, so
// that reading gives back what was written; every other tool skips them.

namespace stampede {
namespace {

using symbolic::Names;

std::string pddl(const std::string& name) { return symbolic::name_text(name, Names::pddl); }

void collect_requirements(const Formula& formula, std::set<std::string>& used) {
  using Kind = Formula::Kind;
  const bool has_guards = !symbolic::trait_guards(formula.variables).empty();
  if (formula.kind == Kind::equal) used.insert(":equality");
  if (formula.kind == Kind::always) used.insert({":equality", ":universal-preconditions"});
  if (formula.kind == Kind::never) used.insert({":equality", ":existential-preconditions"});
  if (formula.kind == Kind::disjunction) used.insert(":disjunctive-preconditions");
  if (formula.kind == Kind::exists) used.insert(":existential-preconditions");
  if (formula.kind == Kind::forall) used.insert(":universal-preconditions");
  if (formula.kind == Kind::forall && has_guards) used.insert(":disjunctive-preconditions");
  if (formula.kind == Kind::negation) {
    const Kind inner = formula.parts.at(0).kind;
    if (inner != Kind::equal) used.insert(":negative-preconditions");
    if (inner == Kind::conjunction) used.insert(":disjunctive-preconditions");
  }
  for (const Formula& part : formula.parts) collect_requirements(part, used);
}

// Of a precondition or goal: `(and)` by itself needs nothing.
void collect_whole(const Formula& formula, std::set<std::string>& used) {
  if (formula.kind != Formula::Kind::always) collect_requirements(formula, used);
}

bool has_costs(const Domain& domain) {
  return !domain.functions.empty() || std::any_of(domain.actions.begin(), domain.actions.end(), [](const Action& a) {
    return a.cost != 1 || !a.cost_function.empty();
  });
}

// Every variable and constant is written with its type, `object` at least.
bool has_types(const Domain& domain) {
  const auto declares = [](const auto& one) { return !one.parameters.empty(); };
  return !domain.types.empty() || !domain.traits.empty() || !domain.constants.empty() ||
         std::any_of(domain.predicates.begin(), domain.predicates.end(), declares) ||
         std::any_of(domain.actions.begin(), domain.actions.end(), declares);
}

std::set<std::string> requirements(const Domain& domain) {
  std::set<std::string> used = {":strips"};
  if (has_types(domain)) used.insert(":typing");
  for (const Predicate& predicate : domain.predicates) {
    if (predicate.kind != PredicateKind::derived) continue;
    used.insert(":derived-predicates");
    collect_requirements(predicate.derived, used);
  }
  for (const Action& action : domain.actions) {
    collect_whole(action.precondition, used);
    if (!symbolic::inequalities(action, domain).empty()) used.insert(":equality");
    for (const Effect& effect : action.effects) {
      if (!effect.forall.empty() || effect.when.kind != Formula::Kind::always) used.insert(":conditional-effects");
      if (effect.when.kind != Formula::Kind::always) collect_requirements(effect.when, used);
    }
  }
  if (has_costs(domain)) used.insert(":action-costs");
  return used;
}

// In the order of the PDDL manuals, so that the line reads as people expect.
std::string requirements_text(const std::set<std::string>& used) {
  std::string text = "(:requirements";
  for (const char* key : {":strips", ":typing", ":negative-preconditions", ":disjunctive-preconditions", ":equality",
                          ":existential-preconditions", ":universal-preconditions", ":conditional-effects",
                          ":derived-predicates", ":action-costs"}) {
    if (used.contains(key)) text += std::string(" ") + key;
  }
  return text + ")";
}

std::string types_text(const Domain& domain) {
  if (domain.types.empty()) return {};
  std::string text = "  (:types";
  for (const auto& [type, parent] : domain.types) {
    text += "\n    " + pddl(type) + " - " + (parent.empty() ? "object" : pddl(parent));
  }
  return text + ")\n";
}

std::string objects_text(const char* word, const std::vector<TypedObject>& objects) {
  if (objects.empty()) return {};
  std::string text = std::string("  (:") + word;
  for (const TypedObject& object : objects) {
    text += "\n    " + pddl(object.name) + " - " + (object.type.empty() ? "object" : pddl(object.type));
  }
  return text + ")\n";
}

std::string traits_note(const std::vector<Parameter>& parameters) {
  std::string text;
  for (const Parameter& parameter : parameters) {
    for (const std::string& trait : parameter.traits) text += " " + pddl(parameter.name) + ":" + pddl(trait);
  }
  return text.empty() ? text : " traits" + text;
}

std::string predicates_text(const Domain& domain) {
  if (domain.traits.empty() && domain.predicates.empty()) return {};
  std::string text = "  (:predicates";
  for (const std::string& trait : domain.traits) text += "\n    (" + pddl(trait) + " ?x - object) ;@ trait";
  for (const Predicate& predicate : domain.predicates) {
    if (predicate.kind == PredicateKind::start) continue;  // never a fact
    const std::string variables = symbolic::variables_text(predicate.parameters, Names::pddl);
    text += "\n    (" + pddl(predicate.name) + (variables.empty() ? "" : " " + variables) + ")";
    std::string note;
    if (predicate.kind == PredicateKind::fixed) note += " fixed";
    note += traits_note(predicate.parameters);
    if (!predicate.label.empty()) note += " label " + predicate.label;
    if (!note.empty()) text += " ;@" + note;
  }
  return text + "\n  )\n";
}

std::string derived_text(const Predicate& predicate) {
  const std::string variables = symbolic::variables_text(predicate.parameters, Names::pddl);
  std::string body = symbolic::formula_text(predicate.derived, Names::pddl);
  const std::vector<Formula> guards = symbolic::trait_guards(predicate.parameters);
  if (!guards.empty()) {
    std::string guarded = "(and";
    for (const Formula& guard : guards) guarded += " " + to_pddl(guard);
    body = guarded + " " + body + ")";
  }
  return "  (:derived (" + pddl(predicate.name) + (variables.empty() ? "" : " " + variables) + ")\n    " + body + ")\n";
}

std::string effect_text(const Effect& effect) {
  std::string text = symbolic::atom_text(effect.predicate, effect.terms, Names::pddl);
  if (effect.negated) text = "(not " + text + ")";
  const std::vector<Formula> guards = symbolic::trait_guards(effect.forall);
  if (!guards.empty()) {
    std::string condition = "(and";
    for (const Formula& guard : guards) condition += " " + to_pddl(guard);
    if (effect.when.kind != Formula::Kind::always) condition += " " + symbolic::formula_text(effect.when, Names::pddl);
    text = "(when " + condition + ") " + text + ")";
  } else if (effect.when.kind != Formula::Kind::always) {
    text = "(when " + symbolic::formula_text(effect.when, Names::pddl) + " " + text + ")";
  }
  if (effect.forall.empty()) return text;
  return "(forall (" + symbolic::variables_text(effect.forall, Names::pddl) + ") " + text + ")";
}

// `guards N`: the first N conjuncts of the precondition were generated from the parameters.
std::string action_note(const Action& action, std::size_t guards) {
  std::string note;
  if (!action.skill.empty()) note += " skill " + pddl(action.skill);
  if (!action.case_name.empty()) note += " case " + pddl(action.case_name);
  if (action.distinct) note += " distinct";
  for (const auto& [a, b] : action.may_equal) note += " may_equal " + pddl(a) + " " + pddl(b);
  if (guards > 0) note += " guards " + std::to_string(guards);
  note += traits_note(action.parameters);
  return note.empty() ? note : " ;@" + note;
}

std::string action_text(const Action& action, const Domain& domain, bool costs) {
  std::vector<Formula> conjuncts = symbolic::trait_guards(action.parameters);
  for (Formula& unequal : symbolic::inequalities(action, domain)) conjuncts.push_back(std::move(unequal));
  const std::size_t guards = conjuncts.size();
  const Formula& own = action.precondition;
  if (own.kind == Formula::Kind::conjunction) {
    conjuncts.insert(conjuncts.end(), own.parts.begin(), own.parts.end());
  } else if (own.kind != Formula::Kind::always) {
    conjuncts.push_back(own);
  }
  std::string text = "  (:action " + pddl(action.name) + action_note(action, guards) + "\n    :parameters (" +
                     symbolic::variables_text(action.parameters, Names::pddl) + ")\n    :precondition (and";
  for (const Formula& one : conjuncts) text += "\n      " + symbolic::formula_text(one, Names::pddl);
  text += ")\n    :effect (and";
  for (const Effect& effect : action.effects) {
    text += "\n      " + effect_text(effect);
    if (effect.at_least > 0)
      text += "  ; " + std::to_string(effect.at_least) + " of them are enough afterwards; a plan counts on all";
  }
  const std::string cost = action.cost_function.empty()
                               ? std::to_string(action.cost)
                               : symbolic::atom_text(action.cost_function, action.cost_terms, Names::pddl);
  if (costs) text += "\n      (increase (total-cost) " + cost + ")";
  return text + "))\n";
}

std::string functions_text(const Domain& domain) {
  if (!has_costs(domain)) return {};
  std::string text = "  (:functions (total-cost) - number";
  for (const Predicate& function : domain.functions) {
    const std::string variables = symbolic::variables_text(function.parameters, Names::pddl);
    text += " (" + pddl(function.name) + (variables.empty() ? "" : " " + variables) + ") - number";
  }
  return text + ")\n";
}

std::string values_text(const Problem& problem) {
  std::string text;
  for (const auto& [of, value] : problem.values) {
    text += "\n    (= " + pddl(to_text(of)) + " " + std::to_string(value) + ")";
  }
  return text;
}

}  // namespace

std::string to_pddl(const Formula& formula) {
  return formula.kind == Formula::Kind::always ? "(and)" : symbolic::formula_text(formula, Names::pddl);
}

std::string to_text(const Formula& formula) { return symbolic::formula_text(formula, Names::plain); }

std::string to_pddl_name(std::string_view name) { return symbolic::name_text(name, Names::pddl); }

std::string to_pddl(const Plan& plan) {
  std::string text;
  for (const PlanStep& step : plan) text += pddl(to_text(Fact{step.action, step.arguments})) + "\n";
  return text;
}

std::string to_pddl(const Domain& domain) {
  symbolic::check_names(domain);
  std::string text = "(define (domain " + pddl(domain.name) + ")\n";
  text += "  " + requirements_text(requirements(domain)) + "\n" + types_text(domain);
  text += objects_text("constants", domain.constants) + predicates_text(domain) + functions_text(domain);
  for (const Predicate& predicate : domain.predicates) {
    if (predicate.kind == PredicateKind::derived) text += derived_text(predicate);
  }
  for (const Action& action : domain.actions) text += action_text(action, domain, has_costs(domain));
  return text + ")\n";
}

std::string to_pddl(const Problem& problem, const Domain& domain, const std::string& not_complete) {
  symbolic::check_names(problem);
  std::set<std::string> used;
  collect_whole(problem.goal, used);
  const std::set<std::string> known = requirements(domain);
  const bool more = !std::includes(known.begin(), known.end(), used.begin(), used.end());
  std::vector<TypedObject> objects;
  for (const TypedObject& object : problem.objects) {
    if (std::find(domain.constants.begin(), domain.constants.end(), object) == domain.constants.end()) {
      objects.push_back(object);
    }
  }
  std::string text = "(define (problem " + pddl(problem.name) + ")\n  (:domain " + pddl(domain.name) + ")\n";
  if (more) {
    used.insert(known.begin(), known.end());
    text += "  " + requirements_text(used) + "\n";
  }
  text += objects_text("objects", objects) + "  (:init";
  if (has_costs(domain)) text += "\n    (= (total-cost) 0)" + values_text(problem);
  for (const Fact& fact : problem.init) text += "\n    " + pddl(to_text(fact));
  text += ")\n";
  if (!not_complete.empty()) {
    std::string line = not_complete;
    std::replace(line.begin(), line.end(), '\n', ' ');
    text += "  ; not complete: " + line + "\n";
  }
  text += "  (:goal " + to_pddl(problem.goal) + ")\n";
  if (has_costs(domain)) text += "  (:metric minimize (total-cost))\n";
  return text + ")\n";
}

}  // namespace stampede
