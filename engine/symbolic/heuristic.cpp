#include "engine/symbolic/heuristic.h"

#include <algorithm>
#include <limits>
#include <map>

namespace stampede::symbolic {
namespace {

constexpr int kUnreached = std::numeric_limits<int>::max();
constexpr int kMostCost = 1 << 16;  // h_add can grow without bound; beyond this all is equally far

}  // namespace

Heuristic::Heuristic(const GroundTask& task) : task_(task), nodes_(2 * task.facts) {
  needed_.assign(static_cast<std::size_t>(nodes_), 0);
  const auto need = [&](const Literals& literals) {
    for (const Literal one : literals) needed_[one] = 1;
  };
  for (const Operator& op : task.operators) {
    need(op.precondition);
    for (const ConditionalEffect& effect : op.conditional) need(effect.when);
  }
  for (const Axiom& axiom : task.axioms) need(axiom.body);
  need(task.goal);
  for (int fact = task.basic; fact < task.facts; ++fact) {  // denying a fact needs denials of its conditions
    if (needed_[2 * fact + 1]) needed_[2 * fact] = 1;
  }
  for (auto axiom = task.axioms.rbegin(); axiom != task.axioms.rend(); ++axiom) {
    if (!needed_[2 * axiom->head + 1]) continue;
    for (const Literal one : axiom->body) needed_[one ^ 1] = 1;
  }
  for (std::size_t i = 0; i < task.operators.size(); ++i) {
    const Operator& op = task.operators[i];
    std::vector<int> effects;
    for (const Literal one : op.effects) {
      if (needed_[one]) effects.push_back(one);
    }
    add_rule(static_cast<int>(i), op.precondition, effects, true);
    for (const ConditionalEffect& effect : op.conditional) {
      if (!needed_[effect.effect]) continue;
      Literals condition = op.precondition;
      condition.insert(condition.end(), effect.when.begin(), effect.when.end());
      std::sort(condition.begin(), condition.end());
      condition.erase(std::unique(condition.begin(), condition.end()), condition.end());
      add_rule(static_cast<int>(i), condition, {effect.effect}, false);
    }
  }
  for (const Axiom& axiom : task.axioms) {
    add_rule(-1, axiom.body, {2 * axiom.head}, false);
  }
  add_denials();
  used_begin_.assign(static_cast<std::size_t>(nodes_) + 1, 0);
  for (const auto& condition : condition_of_rule_) {
    for (const int node : condition) ++used_begin_[node + 1];
  }
  for (int i = 0; i < nodes_; ++i) used_begin_[i + 1] += used_begin_[i];
  used_.resize(static_cast<std::size_t>(used_begin_.back()));
  std::vector<int> at(used_begin_.begin(), used_begin_.end() - 1);
  for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
    for (const int node : condition_of_rule_[rule]) used_[at[node]++] = static_cast<int>(rule);
    initial_conditions_.push_back(rules_[rule].conditions);
    if (rules_[rule].conditions == 0) unconditional_.push_back(static_cast<int>(rule));
  }
  set_goal(task.goal);
  marked_.assign(static_cast<std::size_t>(nodes_), 0);
  op_marked_.assign(task.operators.size(), 0);
}

void Heuristic::set_goal(const Literals& goal) {
  goal_.assign(goal.begin(), goal.end());
  is_goal_.assign(static_cast<std::size_t>(nodes_), 0);
  for (const int node : goal_) is_goal_[node] = 1;
}

void Heuristic::add_rule(int op, const std::vector<int>& condition, const std::vector<int>& effects, bool whole) {
  Rule rule;
  rule.op = op;
  rule.begin = static_cast<int>(effects_.size());
  effects_.insert(effects_.end(), effects.begin(), effects.end());
  rule.end = static_cast<int>(effects_.size());
  rule.conditions = static_cast<int>(condition.size());
  rule.whole = whole;
  rules_.push_back(rule);
  condition_of_rule_.push_back(condition);
}

// `not d` for a derived d: every axiom of d has a false literal. One extra node an axiom keeps this linear. A literal
// of d's own layer is taken as deniable at no cost: greatest fixed points are beyond counters, and this way no
// reachable goal is ever called a dead end.
void Heuristic::add_denials() {
  std::map<int, std::vector<const Axiom*>> by_head;
  std::map<int, int> layer;
  for (const Axiom& axiom : task_.axioms) {
    layer[axiom.head] = axiom.layer;
    if (needed_[2 * axiom.head + 1]) by_head[axiom.head].push_back(&axiom);
  }
  for (const auto& [head, axioms] : by_head) {
    std::vector<int> all;
    for (const Axiom* axiom : axioms) {
      const int node = nodes_++;
      needed_.push_back(1);
      all.push_back(node);
      for (const Literal one : axiom->body) {
        const auto found = layer.find(one >> 1);
        const bool same_layer = (one & 1) == 0 && found != layer.end() && found->second == axiom->layer;
        add_rule(-1, same_layer ? std::vector<int>{} : std::vector<int>{one ^ 1}, {node}, false);
      }
    }
    add_rule(-1, all, {2 * head + 1}, false);
  }
}

void Heuristic::enqueue(int node, int cost, int rule) {
  if (cost >= cost_[node]) return;
  cost_[node] = cost;
  supporter_[node] = rule;
  if (static_cast<std::size_t>(cost) >= buckets_.size()) buckets_.resize(static_cast<std::size_t>(cost) + 1);
  buckets_[static_cast<std::size_t>(cost)].push_back(node);
}

void Heuristic::fire(int rule) {
  const int cost = std::min(rule_cost_[rule] + (rules_[rule].op >= 0 ? 1 : 0), kMostCost);
  for (int i = rules_[rule].begin; i < rules_[rule].end; ++i) enqueue(effects_[i], cost, rule);
}

void Heuristic::reach(int node, int cost) {
  for (int i = used_begin_[node]; i < used_begin_[node + 1]; ++i) {
    const int rule = used_[i];
    rule_cost_[rule] += cost;
    if (--open_conditions_[rule] == 0) fire(rule);
  }
}

bool Heuristic::explore() {
  std::size_t goals_left = goal_.size();
  for (std::size_t cost = 0; cost < buckets_.size(); ++cost) {
    for (std::size_t i = 0; i < buckets_[cost].size(); ++i) {  // grows while we walk: free axioms
      const int node = buckets_[cost][i];
      if (cost_[node] != static_cast<int>(cost) || supporter_[node] == -2) continue;
      if (marked_[node]) continue;
      marked_[node] = 1;
      marked_nodes_.push_back(node);
      if (is_goal_[node] && --goals_left == 0) return true;
      reach(node, static_cast<int>(cost));
    }
  }
  return goals_left == 0;
}

int Heuristic::evaluate(const Words& state) {
  cost_.assign(static_cast<std::size_t>(nodes_), kUnreached);
  supporter_.assign(static_cast<std::size_t>(nodes_), -1);
  open_conditions_ = initial_conditions_;
  rule_cost_.assign(rules_.size(), 0);
  for (auto& bucket : buckets_) bucket.clear();
  applicable_.clear();
  preferred_.clear();
  relaxed_ops_.clear();
  std::size_t goals_left = goal_.size();
  std::vector<int> ready = unconditional_;
  for (int fact = 0; fact < task_.facts; ++fact) {
    const int node = 2 * fact + (test(state.data(), fact) ? 0 : 1);
    if (!needed_[node]) continue;
    cost_[node] = 0;
    supporter_[node] = -2;  // true now
    if (is_goal_[node]) --goals_left;
    for (int i = used_begin_[node]; i < used_begin_[node + 1]; ++i) {
      if (--open_conditions_[used_[i]] == 0) ready.push_back(used_[i]);
    }
  }
  for (const int rule : ready) {
    if (rules_[rule].whole) applicable_.push_back(rules_[rule].op);
  }
  std::sort(applicable_.begin(), applicable_.end());
  if (goals_left == 0) return 0;
  std::sort(ready.begin(), ready.end());
  for (const int rule : ready) fire(rule);
  explore();
  for (const int node : marked_nodes_) marked_[node] = 0;
  marked_nodes_.clear();
  for (const int node : goal_) {
    if (cost_[node] == kUnreached) return kDeadEnd;
  }
  for (const int node : goal_) mark(node);
  for (const int node : marked_nodes_) marked_[node] = 0;
  marked_nodes_.clear();
  for (const int op : relaxed_ops_) op_marked_[op] = 0;
  std::sort(preferred_.begin(), preferred_.end());
  preferred_.erase(std::unique(preferred_.begin(), preferred_.end()), preferred_.end());
  return static_cast<int>(relaxed_ops_.size());
}

void Heuristic::mark(int node) {
  std::vector<int> stack = {node};
  while (!stack.empty()) {
    const int at = stack.back();
    stack.pop_back();
    if (supporter_[at] < 0 || marked_[at]) continue;
    marked_[at] = 1;
    marked_nodes_.push_back(at);
    const int rule = supporter_[at];
    const int op = rules_[rule].op;
    if (op >= 0) {
      if (!op_marked_[op]) {
        op_marked_[op] = 1;
        relaxed_ops_.push_back(op);
      }
      if (rule_cost_[rule] == 0) preferred_.push_back(op);
    }
    for (const int condition : condition_of_rule_[rule]) stack.push_back(condition);
  }
}

Literals Heuristic::unreached_goal() const {
  Literals result;
  for (const int node : goal_) {
    if (cost_[node] == kUnreached) result.push_back(node);
  }
  return result;
}

}  // namespace stampede::symbolic
