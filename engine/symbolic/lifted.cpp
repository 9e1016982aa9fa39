#include "engine/symbolic/lifted.h"

#include <algorithm>
#include <set>

#include "engine/base/error.h"
#include "engine/symbolic/evaluation.h"
#include "engine/symbolic/pddl_text.h"
#include "engine/symbolic/rule_parts.h"

namespace stampede::symbolic {
namespace {

using Kind = Formula::Kind;
using Scope = std::map<std::string, LiftedTerm>;

constexpr std::size_t kMostDisjuncts = 8;        // beyond it a disjunction becomes a predicate of its own
constexpr std::int64_t kMostGround = 1'000'000;  // bindings of quantifiers that are written out
constexpr std::int64_t kMostBindings = 100'000;  // of a rule's variables, before it is split

class Lifter {
 public:
  Lifter(const Domain& domain, const Problem& problem) : domain_(domain), problem_(problem) {}

  LiftedTask run() {
    task_.domain = &domain_;
    task_.problem = &problem_;
    task_.objects = all_objects(domain_, problem_.objects);
    for (std::size_t i = 0; i < task_.objects.size(); ++i) objects_[task_.objects[i].name] = static_cast<int>(i);
    name_predicates();
    for (const Fact& fact : problem_.init) lift_init(fact);
    for (const Predicate& predicate : domain_.predicates) {
      if (predicate.kind == PredicateKind::derived) lift_derived(predicate);
    }
    for (std::size_t i = 0; i < domain_.actions.size(); ++i) lift_action(domain_.actions[i], static_cast<int>(i));
    lift_goal();
    return std::move(task_);
  }

 private:
  int name_predicate(const std::string& name, std::size_t arity) {
    const auto [at, is_new] = predicates_.try_emplace(name, static_cast<int>(task_.predicates.size()));
    if (is_new) {
      task_.predicates.push_back(name);
      task_.fluent.push_back(0);
      task_.derived.push_back(0);
      arity_.push_back(arity);
    }
    return at->second;
  }

  void name_predicates() {
    for (const Predicate& predicate : domain_.predicates) {
      const int id = name_predicate(predicate.name, predicate.parameters.size());
      task_.derived[id] = task_.fluent[id] = predicate.kind == PredicateKind::derived;
    }
    for (const std::string& trait : domain_.traits) name_predicate(trait, 1);
    for (const Fact& fact : problem_.init) name_predicate(fact.predicate, fact.arguments.size());
    for (const Action& action : domain_.actions) {
      for (const Effect& effect : action.effects) {
        const int id = name_predicate(effect.predicate, effect.terms.size());
        if (task_.derived[id]) {
          throw Error("action " + action.name, "has the derived predicate `" + effect.predicate + "` in its effect",
                      "state the basic facts that it is derived from");
        }
        task_.fluent[id] = 1;
      }
    }
  }

  int object(const std::string& name) const {
    const auto found = objects_.find(name);
    if (found != objects_.end()) return found->second;
    std::vector<std::string> known;
    for (const TypedObject& one : task_.objects) known.push_back(one.name);
    throw Error(problem_.name, "unknown object `" + name + "`", did_you_mean(name, known));
  }

  LiftedTerm term(const Term& from, const Scope& scope) const {
    if (!from.variable) return {false, object(from.name)};
    const auto found = scope.find(from.name);
    if (found == scope.end()) throw Error("?" + from.name, "nothing binds this variable");
    return found->second;
  }

  LiftedAtom lift_atom(const std::string& predicate, const std::vector<Term>& terms, const Scope& scope) const {
    const auto found = predicates_.find(predicate);
    if (found == predicates_.end()) {
      throw Error(domain_.name, "unknown predicate `" + predicate + "`", did_you_mean(predicate, task_.predicates));
    }
    if (arity_[found->second] != terms.size()) {
      throw Error(domain_.name, "`" + predicate + "` takes " + std::to_string(arity_[found->second]) +
                                    " arguments, got " + std::to_string(terms.size()));
    }
    LiftedAtom result{found->second, {}};
    for (const Term& one : terms) result.terms.push_back(term(one, scope));
    return result;
  }

  void lift_init(const Fact& fact) {
    LiftedAtom result{predicates_.at(fact.predicate), {}};
    if (task_.derived[result.predicate]) return;
    for (const std::string& argument : fact.arguments) result.terms.push_back({false, object(argument)});
    task_.init.push_back(std::move(result));
  }

  std::vector<int> values(const Parameter& parameter) const {
    std::vector<int> found;
    for (std::size_t i = 0; i < task_.objects.size(); ++i) {
      if (admits(parameter, task_.objects[i], {problem_.init, domain_, task_.objects})) {
        found.push_back(static_cast<int>(i));
      }
    }
    return found;
  }

  int new_variable(std::vector<int> domain) {
    variables_.push_back(std::move(domain));
    return static_cast<int>(variables_.size()) - 1;
  }

  Scope bind_parameters(const std::vector<Parameter>& parameters, Scope scope, std::vector<int>* ids = nullptr) {
    for (const Parameter& parameter : parameters) {
      const int id = new_variable(values(parameter));
      scope[parameter.name] = {true, id};
      if (ids != nullptr) ids->push_back(id);
    }
    return scope;
  }

  bool is_static_truth(const LiftedAtom& lifted) const {
    Fact fact{task_.predicates[lifted.predicate], {}};
    for (const LiftedTerm& one : lifted.terms) fact.arguments.push_back(task_.objects[one.id].name);
    return problem_.init.contains(fact);
  }

  // A literal; decided at once where it is static and ground, so that expanded quantifiers stay small.
  std::vector<Conjunct> literal(const LiftedAtom& lifted, bool negated) const {
    const bool ground =
        std::none_of(lifted.terms.begin(), lifted.terms.end(), [](const LiftedTerm& one) { return one.variable; });
    if (ground && !task_.fluent[lifted.predicate]) {
      if (is_static_truth(lifted) != negated) return {Conjunct{}};
      if (!keep_false_) return {};
    }
    Conjunct result;
    (negated ? result.negative : result.positive).push_back(lifted);
    return {result};
  }

  static void append(Conjunct& a, const Conjunct& b) {
    a.positive.insert(a.positive.end(), b.positive.begin(), b.positive.end());
    a.negative.insert(a.negative.end(), b.negative.begin(), b.negative.end());
    a.equalities.insert(a.equalities.end(), b.equalities.begin(), b.equalities.end());
    a.extra.insert(a.extra.end(), b.extra.begin(), b.extra.end());
  }

  // Disjunctive normal form of a formula in negation normal form.
  std::vector<Conjunct> normal(const Formula& formula, const Scope& scope) {
    switch (formula.kind) {
      case Kind::always:
        return {Conjunct{}};
      case Kind::never:
        return {};
      case Kind::atom:
        return literal(lift_atom(formula.predicate, formula.terms, scope), false);
      case Kind::equal:
        return equality(formula, scope, true);
      case Kind::negation: {
        const Formula& inner = formula.parts.at(0);
        if (inner.kind == Kind::equal) return equality(inner, scope, false);
        return literal(lift_atom(inner.predicate, inner.terms, scope), true);
      }
      case Kind::conjunction: {
        std::vector<Conjunct> all = {Conjunct{}};
        for (const Formula& part : formula.parts) all = product(std::move(all), normal(part, scope));
        return all;
      }
      case Kind::disjunction: {
        std::vector<Conjunct> all;
        for (const Formula& part : formula.parts) {
          for (Conjunct& one : normal(part, scope)) {
            if (is_true(one)) return {Conjunct{}};
            all.push_back(std::move(one));
          }
        }
        return all;
      }
      case Kind::exists: {
        std::vector<int> extra;
        const Scope inner = bind_parameters(formula.variables, scope, &extra);
        std::vector<Conjunct> all = normal(formula.parts.at(0), inner);
        for (Conjunct& one : all) one.extra.insert(one.extra.end(), extra.begin(), extra.end());
        return all;
      }
      case Kind::forall: {
        if (is_denied_rather(formula.parts.at(0), scope)) return denied(formula, scope);
        count_ground(formula);
        std::vector<Conjunct> all = {Conjunct{}};
        expand(formula, 0, scope, all);
        return all;
      }
    }
    return {};
  }

  static bool is_true(const Conjunct& one) {
    return one.positive.empty() && one.negative.empty() && one.equalities.empty() && one.extra.empty();
  }

  // In conditions of actions, `for all x, not A(x) or B(x)` becomes the denial of `some x with A(x) and not B(x)`: then
  // joins over A find the few bindings that matter, where one by one all would be written out for each action.
  // Definitions are written out, because a predicate may depend on itself but not on its own denial.
  bool is_denied_rather(const Formula& body, const Scope& scope) const {
    const bool is_lifted = std::any_of(scope.begin(), scope.end(), [](const auto& one) { return one.second.variable; });
    const bool is_literal = body.kind == Kind::atom || body.kind == Kind::equal || body.kind == Kind::negation;
    return in_action_ && is_lifted && !is_literal;
  }

  std::vector<Conjunct> denied(const Formula& formula, const Scope& scope) {
    const std::vector<Conjunct> failing = normal(negation_normal(formula, true), scope);
    if (failing.empty()) return {Conjunct{}};
    if (std::any_of(failing.begin(), failing.end(), is_true)) return {};
    Conjunct result;
    result.negative.push_back(as_predicate(failing).positive.front());
    return {result};
  }

  // A formula that is written out for each binding of its variables must not fill the memory.
  void count_ground(const Formula& formula) {
    std::vector<std::size_t> choices;
    for (const Parameter& one : formula.variables) choices.push_back(values(one).size());
    count_ground("a formula", choices, [&] { return formula_text(formula, Names::plain); });
  }

  // So must an effect, and its bindings are gone through for each instance of its action.
  void count_ground(const LiftedEffect& effect, const Action& action) {
    std::vector<std::size_t> choices;
    for (const int id : effect.forall) choices.push_back(variables_[static_cast<std::size_t>(id)].size());
    count_ground("an effect", choices, [&] {
      return "`" + task_.predicates[static_cast<std::size_t>(effect.atom.predicate)] + "` by action `" + action.name +
             "`";
    });
  }

  template <typename Text>
  void count_ground(const std::string& what, const std::vector<std::size_t>& choices, const Text& text) {
    std::int64_t count = 1;
    for (const std::size_t one : choices) {
      const auto more = static_cast<std::int64_t>(one);
      count = more > 0 && count > kMostGround / more ? kMostGround + 1 : count * more;
    }
    ground_ += count;
    if (ground_ <= kMostGround) return;
    throw TooManyGround(what + " over " + std::to_string(choices.size()) + " variables and " +
                        std::to_string(task_.objects.size()) + " objects has more than " + std::to_string(kMostGround) +
                        " ground instances: " + text().substr(0, 200));
  }

  void expand(const Formula& forall, std::size_t from, const Scope& scope, std::vector<Conjunct>& all) {
    if (from == forall.variables.size()) {
      all = product(std::move(all), normal(forall.parts.at(0), scope));
      return;
    }
    for (const int value : values(forall.variables[from])) {
      Scope inner = scope;
      inner[forall.variables[from].name] = {false, value};
      expand(forall, from + 1, inner, all);
    }
  }

  std::vector<Conjunct> equality(const Formula& formula, const Scope& scope, bool equal) const {
    const Equality one{term(formula.terms.at(0), scope), term(formula.terms.at(1), scope), equal};
    if (!one.left.variable && !one.right.variable) {
      if ((one.left.id == one.right.id) != equal) return {};
      return {Conjunct{}};
    }
    Conjunct result;
    result.equalities.push_back(one);
    return {result};
  }

  std::vector<Conjunct> product(std::vector<Conjunct> a, std::vector<Conjunct> b) {
    if (b.size() == 1) {  // by far the most: nothing is copied
      for (Conjunct& left : a) append(left, b.front());
      return a;
    }
    if (b.size() > 1 && a.size() * b.size() > kMostDisjuncts) b = {as_predicate(b)};
    std::vector<Conjunct> all;
    for (const Conjunct& left : a) {
      for (const Conjunct& right : b) append(all.emplace_back(left), right);
    }
    return all;
  }

  // An auxiliary derived predicate over the free variables of a disjunction.
  Conjunct as_predicate(const std::vector<Conjunct>& disjuncts) {
    std::set<int> free, bound;
    for (const Conjunct& one : disjuncts) {
      bound.insert(one.extra.begin(), one.extra.end());
      free.merge(variables_of(one));
    }
    for (const int id : bound) free.erase(id);
    const LiftedAtom head = new_head(free);
    for (const Conjunct& one : disjuncts) add_rule(head, one);
    Conjunct result;
    result.positive.push_back(head);
    return result;
  }

  std::int64_t bindings_of(const std::set<int>& variables) const {
    std::int64_t count = 1;
    for (const int id : variables) {
      const auto choices = std::max<std::int64_t>(1, static_cast<std::int64_t>(variables_[id].size()));
      count = count > kMostBindings / choices ? kMostBindings + 1 : count * choices;
    }
    return count;
  }

  // A rule with many bindings is split: what speaks of a variable that its head does not have becomes a rule of its
  // own over the variables beside it (bucket elimination: Dechter, Artificial Intelligence 113, 1999; for grounding:
  // Helmert, Artificial Intelligence 173, 2009). A chain of n objects then needs n joins of two.
  void add_rule(const LiftedAtom& head, Conjunct body) {
    while (true) {
      std::set<int> kept, all = variables_of(body);
      for (const LiftedTerm& one : head.terms) {
        if (one.variable) kept.insert(one.id);
      }
      all.insert(kept.begin(), kept.end());
      if (bindings_of(all) <= kMostBindings) break;
      std::set<int> beside;
      const int next = least_bound(body, kept, beside);
      if (next < 0 || beside.size() + 1 >= all.size()) break;
      split(body, next, beside);
    }
    add_plain_rule(head, body);
  }

  void split(Conjunct& body, int id, const std::set<int>& beside) {
    Conjunct rest;
    take_apart(body, rest, id);
    const LiftedAtom head = new_head(beside);
    add_plain_rule(head, body);
    body = std::move(rest);
    body.positive.push_back(head);
  }

  // Of an auxiliary derived predicate over these variables.
  LiftedAtom new_head(const std::set<int>& variables) {
    const std::string name = "one of " + std::to_string(task_.predicates.size());  // a space: no author's name has one
    LiftedAtom head{name_predicate(name, variables.size()), {}};
    task_.fluent[head.predicate] = task_.derived[head.predicate] = 1;
    for (const int id : variables) head.terms.push_back({true, id});
    return head;
  }

  void add_plain_rule(const LiftedAtom& head, const Conjunct& body) {
    Schema schema;
    schema.head = head;
    schema.body = body;
    schema.domains = variables_;
    compact(schema);
    task_.schemas.push_back(std::move(schema));
  }

  // Renumbers the variables so that only those in use remain, parameters (and head) first.
  static void compact(Schema& schema) {
    std::vector<int> number(schema.domains.size(), -1);
    std::vector<std::vector<int>> domains;
    const auto use = [&](LiftedTerm& t) {
      if (!t.variable) return;
      if (number[t.id] < 0) {
        number[t.id] = static_cast<int>(domains.size());
        domains.push_back(schema.domains[t.id]);
      }
      t.id = number[t.id];
    };
    const auto use_id = [&](int& id) {
      LiftedTerm t{true, id};
      use(t);
      id = t.id;
    };
    const auto use_conjunct = [&](Conjunct& one) {
      for (int& id : one.extra) use_id(id);
      for (LiftedAtom& at : one.positive) std::for_each(at.terms.begin(), at.terms.end(), use);
      for (LiftedAtom& at : one.negative) std::for_each(at.terms.begin(), at.terms.end(), use);
      for (Equality& at : one.equalities) use(at.left), use(at.right);
    };
    for (int i = 0; i < schema.parameters; ++i) {
      LiftedTerm t{true, i};
      use(t);
    }
    std::for_each(schema.head.terms.begin(), schema.head.terms.end(), use);
    use_conjunct(schema.body);
    for (LiftedEffect& effect : schema.effects) {
      for (int& id : effect.forall) use_id(id);
      use_conjunct(effect.when);
      std::for_each(effect.atom.terms.begin(), effect.atom.terms.end(), use);
    }
    schema.domains = std::move(domains);
  }

  void lift_derived(const Predicate& predicate) {
    variables_.clear();
    const Scope scope = bind_parameters(predicate.parameters, {});
    LiftedAtom head{predicates_.at(predicate.name), {}};
    for (std::size_t i = 0; i < predicate.parameters.size(); ++i) head.terms.push_back({true, static_cast<int>(i)});
    for (const Conjunct& one : normal(negation_normal(predicate.derived), scope)) add_rule(head, one);
  }

  void lift_action(const Action& action, int index) {
    variables_.clear();
    in_action_ = true;
    const Scope scope = bind_parameters(action.parameters, {});
    std::vector<Formula> parts = inequalities(action, domain_);
    parts.push_back(action.precondition);
    const std::vector<Conjunct> bodies = normal(negation_normal(conjunction(std::move(parts))), scope);
    std::vector<LiftedEffect> effects;
    for (const Effect& effect : action.effects) lift_effect(action, effect, scope, effects);
    for (const Conjunct& body : bodies) {
      Schema schema;
      schema.action = index;
      schema.parameters = static_cast<int>(action.parameters.size());
      schema.domains = variables_;
      schema.body = body;
      schema.effects = effects;
      compact(schema);
      task_.schemas.push_back(std::move(schema));
    }
  }

  void lift_effect(const Action& action, const Effect& effect, const Scope& scope, std::vector<LiftedEffect>& effects) {
    LiftedEffect lifted;
    lifted.negated = effect.negated;
    const Scope inner = bind_parameters(effect.forall, scope, &lifted.forall);
    lifted.atom = lift_atom(effect.predicate, effect.terms, inner);
    lifted.conditional = effect.when.kind != Kind::always;
    for (Conjunct& when : normal(negation_normal(effect.when), inner)) {
      effects.push_back(lifted);
      effects.back().forall.insert(effects.back().forall.end(), when.extra.begin(), when.extra.end());
      effects.back().when = std::move(when);
      if (!effects.back().forall.empty()) count_ground(effects.back(), action);
    }
  }

  void lift_goal() {
    variables_.clear();
    in_action_ = false;
    const Formula goal = negation_normal(problem_.goal);
    std::vector<Conjunct> disjuncts = normal(goal, {});
    if (disjuncts.empty()) {  // once more, so that the literal to blame is at hand for the explanation
      keep_false_ = true;
      disjuncts = normal(goal, {});
    }
    if (disjuncts.size() == 1 && disjuncts.front().extra.empty()) {
      task_.goal = disjuncts.front();
    } else {
      task_.goal = as_predicate(disjuncts);
    }
  }

  const Domain& domain_;
  const Problem& problem_;
  LiftedTask task_;
  bool keep_false_ = false, in_action_ = false;
  std::int64_t ground_ = 0;  // bindings of quantifiers written out so far
  std::map<std::string, int> objects_, predicates_;
  std::vector<std::size_t> arity_;
  std::vector<std::vector<int>> variables_;  // of the schema in the making: the domain of each
};

}  // namespace

LiftedTask lift(const Domain& domain, const Problem& problem) { return Lifter(domain, problem).run(); }

}  // namespace stampede::symbolic
