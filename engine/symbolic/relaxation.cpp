#include "engine/symbolic/relaxation.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace stampede::symbolic {

Relaxation::Relaxation(const GroundTask& task) : nodes(2 * task.facts) {
  mark_needed(task);
  std::vector<int> effect;
  for (std::size_t i = 0; i < task.operators.size(); ++i) {
    const Operator& op = task.operators[i];
    effect.clear();
    for (const Literal one : op.effects) {
      if (needed[one]) effect.push_back(one);
    }
    add_rule(static_cast<int>(i), op.precondition, effect);
    for (const ConditionalEffect& one : op.conditional) {
      if (!needed[one.effect]) continue;
      Literals condition = op.precondition;
      condition.insert(condition.end(), one.when.begin(), one.when.end());
      std::sort(condition.begin(), condition.end());
      condition.erase(std::unique(condition.begin(), condition.end()), condition.end());
      add_rule(static_cast<int>(i), condition, {one.effect});
    }
  }
  drop_dominated();
  costly = static_cast<int>(rules.size());
  for (const Axiom& axiom : task.axioms) add_rule(-1, axiom.body, {2 * axiom.head});
  add_denials(task);
  index_uses();
}

void Relaxation::mark_needed(const GroundTask& task) {
  needed.assign(static_cast<std::size_t>(nodes), 0);
  const auto need = [&](const Literals& literals) {
    for (const Literal one : literals) needed[one] = 1;
  };
  for (const Operator& op : task.operators) {
    need(op.precondition);
    for (const ConditionalEffect& effect : op.conditional) need(effect.when);
  }
  for (const Axiom& axiom : task.axioms) need(axiom.body);
  need(task.goal);
  // Where conditions decide what happens, improving a plan must be able to ask for their being false, too.
  for (const Operator& op : task.operators) {
    for (const ConditionalEffect& effect : op.conditional) {
      for (const Literal one : effect.when) needed[one ^ 1] = 1;
    }
  }
  for (const Axiom& axiom : task.axioms) {
    for (const Literal one : axiom.body) {
      if (one >> 1 < task.basic) needed[one ^ 1] = 1;
    }
  }
  for (int fact = task.basic; fact < task.facts; ++fact) {  // denying a fact needs denials of its conditions
    if (needed[2 * fact + 1]) needed[2 * fact] = 1;
  }
  for (auto axiom = task.axioms.rbegin(); axiom != task.axioms.rend(); ++axiom) {
    if (!needed[2 * axiom->head + 1]) continue;
    for (const Literal one : axiom->body) needed[one ^ 1] = 1;
  }
}

void Relaxation::add_rule(int op, const std::vector<int>& condition, const std::vector<int>& effect) {
  Rule rule;
  rule.op = op;
  rule.begin = static_cast<int>(effects.size());
  effects.insert(effects.end(), effect.begin(), effect.end());
  rule.end = static_cast<int>(effects.size());
  rule.conditions_begin = static_cast<int>(conditions.size());
  conditions.insert(conditions.end(), condition.begin(), condition.end());
  rule.conditions_end = static_cast<int>(conditions.size());
  rules.push_back(rule);
}

// An effect is dropped where another rule has it under fewer conditions, all of them among this rule's: it can never
// be the better supporter. (Helmert's translator and heuristics do the same.) The rules so far are all operators'.
void Relaxation::drop_dominated() {
  struct Unary {
    int effect, size, rule;
  };
  std::vector<Unary> all;
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const int size = rules[i].conditions_end - rules[i].conditions_begin;
    for (int at = rules[i].begin; at < rules[i].end; ++at) all.push_back({effects[at], size, static_cast<int>(i)});
  }
  std::sort(all.begin(), all.end(), [](const Unary& a, const Unary& b) {
    return std::tie(a.effect, a.size, a.rule) < std::tie(b.effect, b.size, b.rule);
  });
  const auto conditions_of = [&](int rule) {
    return std::pair(conditions.begin() + rules[rule].conditions_begin,
                     conditions.begin() + rules[rule].conditions_end);
  };
  std::vector<std::vector<int>> kept_by_first(static_cast<std::size_t>(nodes));  // rules kept, by their first condition
  std::vector<std::vector<int>> kept_effects(rules.size());
  for (std::size_t begin = 0; begin < all.size();) {
    std::size_t end = begin;
    bool unconditional = false;
    for (; end < all.size() && all[end].effect == all[begin].effect; ++end) {
      const auto [first, last] = conditions_of(all[end].rule);
      bool dominated = unconditional;
      for (auto condition = first; condition != last && !dominated; ++condition) {
        for (const int other : kept_by_first[*condition]) {
          const auto [other_first, other_last] = conditions_of(other);
          dominated = std::includes(first, last, other_first, other_last);
          if (dominated) break;
        }
      }
      if (dominated) continue;
      if (first == last) {
        unconditional = true;
      } else {
        kept_by_first[*first].push_back(all[end].rule);
      }
      kept_effects[all[end].rule].push_back(all[end].effect);
    }
    for (std::size_t i = begin; i < end; ++i) {
      const auto [first, last] = conditions_of(all[i].rule);
      if (first != last) kept_by_first[*first].clear();
    }
    begin = end;
  }
  effects.clear();
  for (std::size_t i = 0; i < rules.size(); ++i) {
    rules[i].begin = static_cast<int>(effects.size());
    effects.insert(effects.end(), kept_effects[i].begin(), kept_effects[i].end());
    rules[i].end = static_cast<int>(effects.size());
  }
}

// `not d` for a derived d: every axiom of d has a false literal. One extra node an axiom keeps this linear. A literal
// of d's own layer is taken as deniable at no cost: greatest fixed points are beyond counters, and this way no
// reachable goal is ever called a dead end.
void Relaxation::add_denials(const GroundTask& task) {
  std::map<int, std::vector<const Axiom*>> by_head;
  std::map<int, int> layer;
  for (const Axiom& axiom : task.axioms) {
    layer[axiom.head] = axiom.layer;
    if (needed[2 * axiom.head + 1]) by_head[axiom.head].push_back(&axiom);
  }
  for (const auto& [head, axioms] : by_head) {
    std::vector<int> all;
    for (const Axiom* axiom : axioms) {
      const int node = nodes++;
      needed.push_back(1);
      all.push_back(node);
      for (const Literal one : axiom->body) {
        const auto found = layer.find(one >> 1);
        const bool same_layer = (one & 1) == 0 && found != layer.end() && found->second == axiom->layer;
        add_rule(-1, same_layer ? std::vector<int>{} : std::vector<int>{one ^ 1}, {node});
      }
    }
    add_rule(-1, all, {2 * head + 1});
  }
}

void Relaxation::index_uses() {
  used_begin.assign(static_cast<std::size_t>(nodes) + 1, 0);
  for (const int condition : conditions) ++used_begin[condition + 1];
  for (int node = 0; node < nodes; ++node) used_begin[node + 1] += used_begin[node];
  used.resize(conditions.size());
  std::vector<int> at(used_begin.begin(), used_begin.end() - 1);
  for (std::size_t rule = 0; rule < rules.size(); ++rule) {
    for (int i = rules[rule].conditions_begin; i < rules[rule].conditions_end; ++i) {
      used[at[conditions[i]]++] = static_cast<int>(rule);
    }
  }
}

}  // namespace stampede::symbolic
