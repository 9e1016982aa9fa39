// Truth of formulas in explicit sets of facts: the plain, readable semantics that the planner is tested against.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "engine/symbolic/symbols.h"

namespace stampede::symbolic {

// Lifetime: refers to what it was made from.
struct View {
  const Facts& facts;
  const Domain& domain;
  const std::vector<TypedObject>& objects;
};

// Throws Error when a variable is bound by nothing.
const std::string& value_of(const Term& term, const Binding& binding);
Fact ground_atom(const std::string& predicate, const std::vector<Term>& terms, const Binding& binding);
bool evaluate(const Formula& formula, const View& view, Binding& binding);  // binding is as before on return
bool admits(const Parameter& parameter, const TypedObject& object, const View& view);
// What keeps an object from standing for a parameter: "table is not openable, which ?part must be"; empty: nothing.
std::string argument_fault(const Parameter& parameter, const std::string& object, const View& view);

// Calls `visit` for every binding of the variables to objects of their types and traits, in the objects' order, until
// it returns false. Result: false if it did.
template <typename Visit>
bool for_each_binding(const std::vector<Parameter>& variables, const View& view, Binding& binding, Visit&& visit,
                      std::size_t from = 0) {
  if (from == variables.size()) return visit();
  const std::string& name = variables[from].name;
  const auto shadowed = binding.find(name);
  const std::string before = shadowed == binding.end() ? std::string() : shadowed->second;
  const bool was_bound = shadowed != binding.end();
  bool go_on = true;
  for (const TypedObject& object : view.objects) {
    if (!admits(variables[from], object, view)) continue;
    binding[name] = object.name;
    go_on = for_each_binding(variables, view, binding, visit, from + 1);
    if (!go_on) break;
  }
  if (was_bound) {
    binding[name] = before;
  } else {
    binding.erase(name);
  }
  return go_on;
}

// Negations pushed down to atoms and equalities.
Formula negation_normal(const Formula& formula, bool negated = false);

// Strata of the derived predicates, lowest first; each stratum sorted by name.
// Throws Error when a derived predicate depends on its own negation.
std::vector<std::vector<const Predicate*>> strata(const Domain& domain);

// Adds the derived facts of the predicates named, and of those that they are derived from, to facts that have none.
// Returns those added, for whoever takes them out again.
std::vector<Fact> add_derived(Facts& facts, const Domain& domain, const std::vector<TypedObject>& objects,
                              const std::set<std::string>& predicates);
// The derived predicates that a formula is about, itself or through their definitions.
void collect_derived(const Formula& formula, const Domain& domain, std::set<std::string>& predicates);

// What a ground action changes, in facts with the derived ones that its effects' conditions mention.
struct Change {
  Facts added, removed;  // what is in both is added
};
Change change_of(const Action& action, const std::vector<std::string>& arguments, const View& view);

// The problem's objects together with the domain's constants, sorted by name.
std::vector<TypedObject> all_objects(const Domain& domain, const std::vector<TypedObject>& objects);

}  // namespace stampede::symbolic
