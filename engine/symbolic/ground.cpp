#include "engine/symbolic/ground.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/stopping.h"
#include "engine/symbolic/reachability.h"
#include "engine/symbolic/simplify.h"

namespace stampede::symbolic {
namespace {

// What is known of an atom's truth over all reachable states.
enum class Truth { always, never, changes };

class Builder {
 public:
  Builder(GroundTask& task, const std::set<PlanStep>& forbidden)
      : task_(task), lifted_(task.lifted), forbidden_(forbidden), reach_(lifted_) {}

  void run(std::int64_t memory_bytes) {
    if (!reach_.run(memory_bytes)) {
      task_.out_of_memory = true;
      task_.fullest = fullest();
      return;
    }
    judge_atoms();
    number_facts();
    for (const Instance& one : reach_.instances()) {
      heed_stop();
      if (lifted_.schemas[one.schema].action >= 0) {
        build_operator(one);
      } else {
        build_axiom(one);
      }
    }
    layer_axioms();
    build_goal();
    simplify(task_);
  }

 private:
  std::string fullest() const {
    std::int64_t all = 0;
    std::size_t most = 0;
    for (std::size_t i = 0; i < lifted_.schemas.size(); ++i) {
      all += reach_.instances_of(static_cast<int>(i));
      if (reach_.instances_of(static_cast<int>(i)) > reach_.instances_of(static_cast<int>(most))) most = i;
    }
    std::string text = std::to_string(all) + " ground formulas";
    if (all == 0) return text;
    const Schema& schema = lifted_.schemas[most];
    text += ", " + std::to_string(reach_.instances_of(static_cast<int>(most))) + " of them of ";
    if (schema.action >= 0) {
      text += "the action `" + lifted_.domain->actions[schema.action].name + "`";
    } else if (lifted_.domain->predicate(lifted_.predicates[schema.head.predicate]) != nullptr) {
      text += "the derived predicate `" + lifted_.predicates[schema.head.predicate] + "`";
    } else {
      text += "a quantified condition";
    }
    return text + " over " + std::to_string(schema.domains.size()) + " variables";
  }

  void judge_atoms() {
    const std::size_t count = reach_.atoms();
    std::vector<char> added(count, 0), removed(count, 0);
    for (const Instance& one : reach_.instances()) {
      heed_stop();
      const Schema& schema = lifted_.schemas[one.schema];
      std::vector<int> binding = one.binding;
      for (const LiftedEffect& effect : schema.effects) {
        reach_.for_each(schema, effect, binding, [&] {
          const int atom = reach_.find(effect.atom, binding);
          if (atom >= 0) (effect.negated ? removed : added)[atom] = 1;
        });
      }
    }
    truth_.assign(count, Truth::always);
    for (std::size_t i = 0; i < count; ++i) {
      const int atom = static_cast<int>(i);
      if (lifted_.derived[reach_.predicate(atom)]) {
        truth_[i] = Truth::changes;
      } else if (reach_.initially(atom) ? removed[i] : added[i]) {
        truth_[i] = Truth::changes;
      }
    }
  }

  void number_facts() {
    fact_.assign(reach_.atoms(), -1);
    for (const bool derived : {false, true}) {
      for (std::size_t i = 0; i < reach_.atoms(); ++i) {
        const int atom = static_cast<int>(i);
        if (truth_[i] != Truth::changes || (lifted_.derived[reach_.predicate(atom)] != 0) != derived) continue;
        fact_[i] = static_cast<int>(task_.atoms.size());
        task_.atoms.push_back(as_atom(atom));
        if (!derived && reach_.initially(atom)) task_.initial.push_back(fact_[i]);
      }
      if (!derived) task_.basic = static_cast<int>(task_.atoms.size());
    }
    task_.facts = static_cast<int>(task_.atoms.size());
    for (std::size_t i = 0; i < reach_.atoms(); ++i) task_.reachable.push_back(as_atom(static_cast<int>(i)));
  }

  LiftedAtom as_atom(int atom) const {
    LiftedAtom result{reach_.predicate(atom), {}};
    for (const int argument : reach_.arguments(atom)) result.terms.push_back({false, argument});
    return result;
  }

  // Appends the literals that can be false; false when one can never hold.
  bool literals(const Conjunct& conjunct, const std::vector<int>& binding, Literals& out) const {
    const auto value = [&](const LiftedTerm& term) { return term.variable ? binding[term.id] : term.id; };
    for (const Equality& one : conjunct.equalities) {
      if ((value(one.left) == value(one.right)) != one.equal) return false;
    }
    for (const LiftedAtom& one : conjunct.positive) {
      const int atom = reach_.find(one, binding);
      if (atom < 0) return false;
      if (truth_[atom] == Truth::changes) out.push_back(2 * fact_[atom]);
    }
    for (const LiftedAtom& one : conjunct.negative) {
      const int atom = reach_.find(one, binding);
      if (atom < 0) continue;
      if (truth_[atom] == Truth::always) return false;
      out.push_back(2 * fact_[atom] + 1);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    for (std::size_t i = 1; i < out.size(); ++i) {
      if ((out[i] ^ 1) == out[i - 1]) return false;
    }
    return true;
  }

  bool is_forbidden(const Schema& schema, const Instance& instance) const {
    if (forbidden_.empty()) return false;
    PlanStep step{lifted_.domain->actions[schema.action].name, {}};
    for (int i = 0; i < schema.parameters; ++i) step.arguments.push_back(lifted_.objects[instance.binding[i]].name);
    return forbidden_.contains(step);
  }

  bool find_cost(const Schema& schema, const Instance& instance, int& cost) const {
    const Action& action = lifted_.domain->actions[schema.action];
    cost = action.cost;
    if (action.cost_function.empty()) return true;
    Fact of{action.cost_function, {}};
    for (const Term& term : action.cost_terms) {
      int object = -1;
      for (int i = 0; i < schema.parameters; ++i) {
        if (term.variable && action.parameters[i].name == term.name) object = instance.binding[i];
      }
      of.arguments.push_back(object < 0 ? term.name : lifted_.objects[object].name);
    }
    const auto found = lifted_.problem->values.find(of);
    if (found == lifted_.problem->values.end()) return false;
    cost = found->second;
    return true;
  }

  void build_operator(const Instance& instance) {
    const Schema& schema = lifted_.schemas[instance.schema];
    if (is_forbidden(schema, instance)) return;
    Operator op;
    if (!find_cost(schema, instance, op.cost)) return;
    op.schema = instance.schema;
    if (!literals(schema.body, instance.binding, op.precondition)) return;
    std::vector<int> binding = instance.binding;
    for (const LiftedEffect& effect : schema.effects) {
      reach_.for_each(schema, effect, binding, [&] {
        const int atom = reach_.find(effect.atom, binding);
        if (atom < 0 || truth_[atom] != Truth::changes) return;
        Literals when;
        if (!literals(effect.when, binding, when)) return;
        const Literal literal = 2 * fact_[atom] + (effect.negated ? 1 : 0);
        if (when.empty()) {
          op.effects.push_back(literal);
        } else {
          op.conditional.push_back({std::move(when), literal});
        }
      });
    }
    std::sort(op.effects.begin(), op.effects.end());
    op.effects.erase(std::unique(op.effects.begin(), op.effects.end()), op.effects.end());
    Literals kept;
    for (const Literal literal : op.effects) {  // an addition wins over a removal of the same fact
      if ((literal & 1) != 0 && !kept.empty() && kept.back() == literal - 1) continue;
      kept.push_back(literal);
    }
    op.effects = std::move(kept);
    if (op.effects.empty() && op.conditional.empty()) return;
    op.binding.assign(instance.binding.begin(), instance.binding.begin() + schema.parameters);
    task_.operators.push_back(std::move(op));
  }

  void build_axiom(const Instance& instance) {
    const Schema& schema = lifted_.schemas[instance.schema];
    Axiom axiom;
    if (!literals(schema.body, instance.binding, axiom.body)) return;
    axiom.head = fact_[reach_.find(schema.head, instance.binding)];
    task_.axioms.push_back(std::move(axiom));
  }

  // Layers by predicate: negated uses lie strictly below (the domain's strata, with auxiliary predicates among them).
  void layer_axioms() {
    std::vector<int> layer(lifted_.predicates.size(), 0);
    const int most = static_cast<int>(layer.size());
    for (bool changed = true; changed;) {
      changed = false;
      for (const Schema& schema : lifted_.schemas) {
        if (schema.action >= 0) continue;
        int& own = layer[schema.head.predicate];
        const int before = own;
        for (const LiftedAtom& one : schema.body.positive) own = std::max(own, layer[one.predicate]);
        for (const LiftedAtom& one : schema.body.negative) {
          if (lifted_.derived[one.predicate]) own = std::max(own, layer[one.predicate] + 1);
        }
        changed |= own != before;
        if (own > most) {
          throw Error("predicate " + lifted_.predicates[schema.head.predicate], "is derived from its own negation");
        }
      }
    }
    for (Axiom& axiom : task_.axioms) axiom.layer = layer[task_.atoms[axiom.head].predicate];
    std::stable_sort(task_.axioms.begin(), task_.axioms.end(),
                     [](const Axiom& a, const Axiom& b) { return a.layer < b.layer; });
  }

  void build_goal() {
    for (const LiftedAtom& one : lifted_.goal.positive) {
      const int atom = reach_.find(one, {});
      if (atom < 0) {
        task_.impossible.push_back(one);
      } else if (truth_[atom] == Truth::changes) {
        task_.goal.push_back(2 * fact_[atom]);
      }
    }
    for (const LiftedAtom& one : lifted_.goal.negative) {
      const int atom = reach_.find(one, {});
      if (atom >= 0 && truth_[atom] == Truth::always) {
        task_.undeniable.push_back(one);
      } else if (atom >= 0) {
        task_.goal.push_back(2 * fact_[atom] + 1);
      }
    }
    std::sort(task_.goal.begin(), task_.goal.end());
    task_.goal.erase(std::unique(task_.goal.begin(), task_.goal.end()), task_.goal.end());
  }

  GroundTask& task_;
  const LiftedTask& lifted_;
  const std::set<PlanStep>& forbidden_;
  Reachability reach_;
  std::vector<Truth> truth_;
  std::vector<int> fact_;
};

}  // namespace

Fact GroundTask::fact(const LiftedAtom& atom) const {
  Fact result{lifted.predicates[atom.predicate], {}};
  for (const LiftedTerm& term : atom.terms) result.arguments.push_back(lifted.objects[term.id].name);
  return result;
}

PlanStep GroundTask::step(int op) const {
  PlanStep result{lifted.domain->actions[lifted.schemas[operators[op].schema].action].name, {}};
  for (const int id : operators[op].binding) result.arguments.push_back(lifted.objects[id].name);
  return result;
}

GroundTask ground(LiftedTask lifted, const std::set<PlanStep>& forbidden, std::int64_t memory_bytes) {
  GroundTask task;
  task.lifted = std::move(lifted);
  Builder(task, forbidden).run(memory_bytes);
  return task;
}

}  // namespace stampede::symbolic
