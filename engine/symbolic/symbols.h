// Types, predicates, actions and formulas: the vocabulary that facts, goals, skills and PDDL share.
#pragma once

#include <compare>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace stampede {

// A ground atom: predicate and names of objects.
struct Fact {
  std::string predicate;
  std::vector<std::string> arguments;
  friend auto operator<=>(const Fact&, const Fact&) = default;
};
std::string to_text(const Fact& fact);  // (on block1 table)

using Facts = std::set<Fact>;

// A typed variable; traits are further static unary predicates that its value must have.
struct Parameter {
  std::string name;  // without the leading ?
  std::string type;  // empty: any
  std::vector<std::string> traits;
  friend bool operator==(const Parameter&, const Parameter&) = default;
};

struct Term {
  bool variable = false;
  std::string name;
  friend auto operator<=>(const Term&, const Term&) = default;
};

struct Formula {
  enum class Kind { always, never, atom, equal, negation, conjunction, disjunction, exists, forall };
  Kind kind = Kind::always;
  std::string predicate;             // atom
  std::vector<Term> terms;           // atom, equal
  std::vector<Formula> parts;        // negation: 1, conjunction, disjunction; exists, forall: 1
  std::vector<Parameter> variables;  // exists, forall
  friend bool operator==(const Formula&, const Formula&) = default;
};

Formula atom(std::string predicate, std::vector<Term> terms);
Formula negation(Formula part);
Formula conjunction(std::vector<Formula> parts);  // of none: always; of one: that one
Formula disjunction(std::vector<Formula> parts);  // of none: never; of one: that one

// One literal of an effect, possibly conditional and quantified (one level each).
struct Effect {
  std::vector<Parameter> forall;
  Formula when;  // always: unconditional
  std::string predicate;
  std::vector<Term> terms;
  bool negated = false;
  int at_least = 0;  // of a forall: so many of its literals are enough afterwards, 0: all. Plans count on all.
  friend bool operator==(const Effect&, const Effect&) = default;
};

struct Action {
  std::string name;  // PDDL action; skill or skill_case
  std::string skill, case_name;
  std::vector<Parameter> parameters;
  Formula precondition;
  std::vector<Effect> effects;
  int cost = 1;
  bool distinct = true;                                        // parameters bind to distinct objects
  std::vector<std::pair<std::string, std::string>> may_equal;  // pairs exempt from `distinct`
  std::string cost_function = {};                              // not empty: its value at cost_terms instead of `cost`
  std::vector<Term> cost_terms = {};
  friend bool operator==(const Action&, const Action&) = default;
};

struct PlanStep {  // an action with its arguments
  std::string action;
  std::vector<std::string> arguments;
  friend auto operator<=>(const PlanStep&, const PlanStep&) = default;
};
using Plan = std::vector<PlanStep>;

// fixed: read once (static). start: a condition on how an episode begins, tested then and never again: no fact.
enum class PredicateKind { basic, derived, fixed, start };

struct Predicate {
  std::string name;
  std::vector<Parameter> parameters;
  PredicateKind kind = PredicateKind::basic;
  Formula derived;    // over the parameters; derived only
  std::string label;  // "the {obj} is on the {surface}"
  friend bool operator==(const Predicate&, const Predicate&) = default;
};

struct TypedObject {
  std::string name, type;
  friend auto operator<=>(const TypedObject&, const TypedObject&) = default;
};

struct Domain {
  std::string name;
  std::map<std::string, std::string> types;  // type -> parent; the root's parent is `object`
  std::vector<std::string> traits;           // static unary predicates by themselves
  std::vector<Predicate> predicates;         // sorted by name
  std::vector<Action> actions;               // sorted by name
  std::vector<TypedObject> constants;        // objects that actions name; sorted by name, every problem has them
  std::vector<Predicate> functions = {};     // whole numbers that a problem gives and costs are made of; sorted by name
  bool is_a(const std::string& type, const std::string& ancestor) const;  // reflexive; every type is an `object`
  const Predicate* predicate(const std::string& predicate_name) const;
  const Action* action(const std::string& action_name) const;
  friend bool operator==(const Domain&, const Domain&) = default;
};

struct Problem {
  std::string name;
  std::vector<TypedObject> objects;  // sorted by name, the domain's constants among them
  Facts init;                        // closed world; traits, attributes and static facts included, derived ones not
  Formula goal;
  std::map<Fact, int> values = {};  // of the domain's functions
  friend bool operator==(const Problem&, const Problem&) = default;
};

// Truth of a formula in a set of facts that includes derived ones. `binding` maps free variables to objects.
using Binding = std::map<std::string, std::string>;
bool holds(const Formula& formula, const Facts& facts, const Domain& domain, const std::vector<TypedObject>& objects,
           const Binding& binding = {});

// The facts plus all derived ones (stratified, to the fixed point). Throws Error on unstratified definitions.
Facts with_derived(const Facts& basic, const Domain& domain, const std::vector<TypedObject>& objects);

// Literals of a formula that do not hold, as texts, for messages: what a person would have to make true.
std::vector<std::string> unmet(const Formula& formula, const Facts& facts, const Domain& domain,
                               const std::vector<TypedObject>& objects, const Binding& binding = {});

// The facts after applying a ground action's declared effects (precondition not tested). Derived facts of the input
// are ignored and the result has none: call with_derived.
Facts apply(const Action& action, const std::vector<std::string>& arguments, const Facts& facts, const Domain& domain,
            const std::vector<TypedObject>& objects);

}  // namespace stampede
