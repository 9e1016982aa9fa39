#include "engine/symbolic/solutions.h"

#include <algorithm>

#include "engine/base/stopping.h"

namespace stampede::symbolic {
namespace {

using Kind = Formula::Kind;

bool is_bound(const Formula& formula, const Binding& binding, std::vector<const Parameter*>& inner) {
  for (const Term& term : formula.terms) {
    if (!term.variable || binding.contains(term.name)) continue;
    const auto is_it = [&](const Parameter* one) { return one->name == term.name; };
    if (std::none_of(inner.begin(), inner.end(), is_it)) return false;
  }
  for (const Parameter& variable : formula.variables) inner.push_back(&variable);
  const bool all = std::all_of(formula.parts.begin(), formula.parts.end(),
                               [&](const Formula& part) { return is_bound(part, binding, inner); });
  inner.resize(inner.size() - formula.variables.size());
  return all;
}

class Solver {
 public:
  Solver(const View& view, Binding& binding, const std::function<bool()>& visit)
      : view_(view), binding_(binding), visit_(visit) {}

  struct Task {
    std::vector<const Formula*> conjuncts;  // all must hold
    std::vector<const Parameter*> unbound;  // to be bound
  };

  bool run(Task task) {
    if (!flatten(task)) return true;
    std::erase_if(task.unbound, [&](const Parameter* one) { return binding_.contains(one->name); });
    std::vector<const Parameter*> inner;
    for (const Formula*& one : task.conjuncts) {
      if (!is_bound(*one, binding_, inner)) continue;
      if (!evaluate(*one, view_, binding_)) return true;
      one = nullptr;
    }
    std::erase(task.conjuncts, nullptr);
    if (task.unbound.empty() && task.conjuncts.empty()) return visit_();
    const Formula* atom = best_atom(task);
    if (atom != nullptr) return over_facts(*atom, task);
    const auto choice = std::find_if(task.conjuncts.begin(), task.conjuncts.end(),
                                     [](const Formula* one) { return one->kind == Kind::disjunction; });
    if (choice != task.conjuncts.end()) return over_parts(**choice, task);
    return over_objects(task);
  }

 private:
  // Conjunctions and, where they hide nothing, existential quantifiers taken apart. False: one part can never hold.
  bool flatten(Task& task) const {
    for (std::size_t i = 0; i < task.conjuncts.size(); ++i) {
      const Formula* one = task.conjuncts[i];
      if (one->kind == Kind::never) return false;
      if (one->kind == Kind::exists && hides_something(*one, task)) continue;
      if (one->kind != Kind::conjunction && one->kind != Kind::exists) continue;
      task.conjuncts[i] = &kAlways;
      for (const Parameter& variable : one->variables) task.unbound.push_back(&variable);
      for (const Formula& part : one->parts) task.conjuncts.push_back(&part);
    }
    std::erase_if(task.conjuncts, [](const Formula* one) { return one->kind == Kind::always; });
    return true;
  }

  bool hides_something(const Formula& exists, const Task& task) const {
    return std::any_of(exists.variables.begin(), exists.variables.end(), [&](const Parameter& variable) {
      const auto is_it = [&](const Parameter* one) { return one->name == variable.name; };
      return binding_.contains(variable.name) || std::any_of(task.unbound.begin(), task.unbound.end(), is_it);
    });
  }

  bool is_open(const Term& term) const { return term.variable && !binding_.contains(term.name); }

  // The atom with most arguments known at its front; null where trying objects is as good.
  const Formula* best_atom(const Task& task) const {
    const Formula* best = nullptr;
    std::size_t best_known = 0;
    for (const Formula* one : task.conjuncts) {
      if (one->kind != Kind::atom) continue;
      std::size_t known = 0;
      while (known < one->terms.size() && !is_open(one->terms[known])) ++known;
      const auto open = std::count_if(one->terms.begin(), one->terms.end(), [&](const Term& t) { return is_open(t); });
      if (known == 0 && open == 1 && one->terms.size() > 1) continue;  // an object each is cheaper than all the facts
      if (best != nullptr && known <= best_known) continue;
      best = one;
      best_known = known;
    }
    return best;
  }

  static const Parameter* declared(const Term& term, const Task& task) {
    for (const Parameter* one : task.unbound) {
      if (one->name == term.name) return one;
    }
    return nullptr;
  }

  const TypedObject* object(const std::string& name) const {
    const auto found =
        std::lower_bound(view_.objects.begin(), view_.objects.end(), name,
                         [](const TypedObject& one, const std::string& text) { return one.name < text; });
    if (found != view_.objects.end() && found->name == name) return &*found;
    const auto plain = std::find_if(view_.objects.begin(), view_.objects.end(),
                                    [&](const TypedObject& one) { return one.name == name; });
    return plain == view_.objects.end() ? nullptr : &*plain;
  }

  bool over_facts(const Formula& atom, const Task& task) {
    Fact first{atom.predicate, {}};
    while (first.arguments.size() < atom.terms.size() && !is_open(atom.terms[first.arguments.size()])) {
      first.arguments.push_back(value_of(atom.terms[first.arguments.size()], binding_));
    }
    const std::size_t known = first.arguments.size();
    Task rest = task;
    std::erase(rest.conjuncts, &atom);
    for (auto at = view_.facts.lower_bound(first); at != view_.facts.end(); ++at) {
      heed_stop();
      if (at->predicate != atom.predicate || at->arguments.size() < known ||
          !std::equal(first.arguments.begin(), first.arguments.end(), at->arguments.begin())) {
        break;
      }
      std::vector<std::string> bound;
      const bool go_on = !match(atom, *at, task, bound) || run(rest);
      for (const std::string& name : bound) binding_.erase(name);
      if (!go_on) return false;
    }
    return true;
  }

  bool match(const Formula& atom, const Fact& fact, const Task& task, std::vector<std::string>& bound) {
    if (fact.arguments.size() != atom.terms.size()) return false;
    for (std::size_t i = 0; i < atom.terms.size(); ++i) {
      const Term& term = atom.terms[i];
      if (!is_open(term)) {
        if (value_of(term, binding_) != fact.arguments[i]) return false;
        continue;
      }
      const Parameter* parameter = declared(term, task);
      const TypedObject* value = object(fact.arguments[i]);
      if (parameter == nullptr) value_of(term, binding_);  // throws: nothing binds it
      if (value == nullptr || !admits(*parameter, *value, view_)) return false;
      binding_[term.name] = fact.arguments[i];
      bound.push_back(term.name);
    }
    return true;
  }

  bool over_parts(const Formula& disjunction, const Task& task) {
    for (const Formula& part : disjunction.parts) {
      Task with = task;
      std::replace(with.conjuncts.begin(), with.conjuncts.end(), &disjunction, &part);
      if (!run(std::move(with))) return false;
    }
    return true;
  }

  bool over_objects(const Task& task) {
    if (task.unbound.empty()) {  // a condition speaks of a variable that nobody declared: say so
      return evaluate(*task.conjuncts.front(), view_, binding_);
    }
    const Parameter& variable = *task.unbound.front();
    bool go_on = true;
    for (const TypedObject& one : view_.objects) {
      heed_stop();
      if (!admits(variable, one, view_)) continue;
      binding_[variable.name] = one.name;
      go_on = run(task);
      if (!go_on) break;
    }
    binding_.erase(variable.name);
    return go_on;
  }

  static inline const Formula kAlways = {};
  const View& view_;
  Binding& binding_;
  const std::function<bool()>& visit_;
};

}  // namespace

bool for_each_solution(const std::vector<Parameter>& variables, const Formula& formula, const View& view,
                       Binding& binding, const std::function<bool()>& visit) {
  Binding local = binding;  // the variables hide what has their names outside
  Solver::Task task{{&formula}, {}};
  for (const Parameter& variable : variables) {
    local.erase(variable.name);
    task.unbound.push_back(&variable);
  }
  std::swap(local, binding);
  const bool result = Solver(view, binding, visit).run(std::move(task));
  std::swap(local, binding);
  return result;
}

}  // namespace stampede::symbolic
