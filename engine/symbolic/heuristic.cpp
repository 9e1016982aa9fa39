#include "engine/symbolic/heuristic.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace stampede::symbolic {
namespace {

constexpr int kUnreached = std::numeric_limits<int>::max();
constexpr int kMostCost = 1 << 16;  // h_add can grow without bound; beyond this all is equally far

}  // namespace

Heuristic::Heuristic(const GroundTask& task) : task_(task), relaxation_(task), successors_(task) {
  achievers_.resize(static_cast<std::size_t>(relaxation_.nodes));
  for (std::size_t rule = 0; rule < relaxation_.rules.size(); ++rule) {
    const Relaxation::Rule& one = relaxation_.rules[rule];
    for (int i = one.begin; i < one.end; ++i) achievers_[relaxation_.effects[i]].push_back(static_cast<int>(rule));
  }
  find_stale();
  marked_.assign(static_cast<std::size_t>(relaxation_.nodes), 0);
  op_marked_.assign(task.operators.size(), 0);
  set_goal(task.goal);
}

// Picking up from where it was put: every action that puts it there held it before. Along such conditions the cheapest
// relaxed plan never runs, so leaving them out changes no value, and on tables with many objects leaves little to do.
void Heuristic::find_stale() {
  const std::vector<int>& conditions = relaxation_.conditions;
  std::vector<std::vector<int>> shared(static_cast<std::size_t>(relaxation_.nodes));
  for (std::size_t node = 0; node < shared.size(); ++node) {
    bool is_first = true;
    std::vector<int> both;
    for (const int achiever : achievers_[node]) {
      const Relaxation::Rule& rule = relaxation_.rules[achiever];
      const auto begin = conditions.begin() + rule.conditions_begin, end = conditions.begin() + rule.conditions_end;
      both.clear();
      if (is_first) {
        both.assign(begin, end);
      } else {
        std::set_intersection(shared[node].begin(), shared[node].end(), begin, end, std::back_inserter(both));
      }
      is_first = false;
      shared[node] = both;
      if (both.empty()) break;
    }
  }
  is_stale_.assign(conditions.size(), 0);
  for (const Relaxation::Rule& rule : relaxation_.rules) {
    for (int i = rule.conditions_begin; i < rule.conditions_end; ++i) {
      const std::vector<int>& had = shared[conditions[i]];
      is_stale_[i] = std::all_of(relaxation_.effects.begin() + rule.begin, relaxation_.effects.begin() + rule.end,
                                 [&](int effect) { return std::find(had.begin(), had.end(), effect) != had.end(); });
    }
  }
}

std::vector<char> Heuristic::relevant_rules(std::vector<char>& relevant_nodes) const {
  std::vector<char> relevant(relaxation_.rules.size(), 0);
  std::vector<int> stack;
  const auto push = [&](int node) {
    if (!relevant_nodes[node]) stack.push_back(node);
    relevant_nodes[node] = 1;
  };
  for (const int node : goal_) push(node);
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    for (const int achiever : achievers_[node]) {
      if (relevant[achiever]) continue;
      relevant[achiever] = 1;
      const Relaxation::Rule& rule = relaxation_.rules[achiever];
      for (int i = rule.conditions_begin; i < rule.conditions_end; ++i) {
        if (!is_stale_[i]) push(relaxation_.conditions[i]);
      }
    }
  }
  return relevant;
}

void Heuristic::set_goal(const Literals& goal) {
  goal_.assign(goal.begin(), goal.end());
  is_goal_.assign(static_cast<std::size_t>(relaxation_.nodes), 0);
  for (const int node : goal_) is_goal_[node] = 1;
  std::vector<char> relevant_nodes(static_cast<std::size_t>(relaxation_.nodes), 0);
  const std::vector<char> relevant = relevant_rules(relevant_nodes);
  rule_of_.clear();
  effects_begin_.clear();
  effects_.clear();
  unconditional_.clear();
  untouched_.clear();
  costly_ = 0;
  for (std::size_t rule = 0; rule < relevant.size(); ++rule) {
    if (!relevant[rule]) continue;
    const Relaxation::Rule& one = relaxation_.rules[rule];
    if (static_cast<int>(rule) < relaxation_.costly) ++costly_;
    untouched_.push_back({one.conditions_end - one.conditions_begin, 0});
    if (untouched_.back().open == 0) unconditional_.push_back(static_cast<int>(rule_of_.size()));
    rule_of_.push_back(static_cast<int>(rule));
    effects_begin_.push_back(static_cast<int>(effects_.size()));
    for (int i = one.begin; i < one.end; ++i) {
      if (relevant_nodes[relaxation_.effects[i]]) effects_.push_back(relaxation_.effects[i]);
    }
  }
  effects_begin_.push_back(static_cast<int>(effects_.size()));
  index_uses();
}

void Heuristic::index_uses() {
  const std::size_t nodes = static_cast<std::size_t>(relaxation_.nodes);
  std::vector<int> fresh(nodes, 0);
  used_begin_.assign(nodes + 1, 0);
  const auto each = [&](const auto& visit) {
    for (std::size_t rule = 0; rule < rule_of_.size(); ++rule) {
      const Relaxation::Rule& one = relaxation_.rules[rule_of_[rule]];
      for (int i = one.conditions_begin; i < one.conditions_end; ++i) {
        visit(static_cast<int>(rule), relaxation_.conditions[i], is_stale_[i] != 0);
      }
    }
  };
  each([&](int, int node, bool is_stale) {
    ++used_begin_[node + 1];
    if (!is_stale) ++fresh[node];
  });
  for (std::size_t node = 0; node < nodes; ++node) used_begin_[node + 1] += used_begin_[node];
  used_middle_.resize(nodes);
  for (std::size_t node = 0; node < nodes; ++node) used_middle_[node] = used_begin_[node] + fresh[node];
  used_.resize(static_cast<std::size_t>(used_begin_.back()));
  std::vector<int> front(used_begin_.begin(), used_begin_.end() - 1), back = used_middle_;
  each([&](int rule, int node, bool is_stale) { used_[(is_stale ? back : front)[node]++] = rule; });
}

void Heuristic::set_costs(const std::vector<int>* by_operator) { costs_ = by_operator; }

void Heuristic::enqueue(int node, int cost, int rule) {
  cost_[node] = cost;
  supporter_[node] = rule;
  if (static_cast<std::size_t>(cost) >= buckets_.size()) buckets_.resize(static_cast<std::size_t>(cost) + 1);
  buckets_[static_cast<std::size_t>(cost)].push_back(node);
}

void Heuristic::fire(int rule) {
  int own = rule < costly_ ? 1 : 0;
  if (costs_ != nullptr && own > 0) own = (*costs_)[static_cast<std::size_t>(relaxation_.rules[rule_of_[rule]].op)];
  const int cost = std::min(counters_[rule].cost + own, kMostCost);
  const int end = effects_begin_[rule + 1];
  for (int i = effects_begin_[rule]; i < end; ++i) {
    const int node = effects_[i];
    if (cost < cost_[node]) enqueue(node, cost, rule);
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
      for (int at = used_begin_[node]; at < used_middle_[node]; ++at) {
        const int rule = used_[at];
        counters_[rule].cost += static_cast<int>(cost);
        if (--counters_[rule].open == 0) fire(rule);
      }
    }
  }
  return goals_left == 0;
}

int Heuristic::evaluate(const Words& state) {
  cost_.assign(static_cast<std::size_t>(relaxation_.nodes), kUnreached);
  supporter_.assign(static_cast<std::size_t>(relaxation_.nodes), -1);
  counters_ = untouched_;
  for (auto& bucket : buckets_) bucket.clear();
  successors_.applicable(state, applicable_);
  preferred_.clear();
  marked_nodes_.clear();
  relaxed_ops_.clear();
  std::size_t goals_left = goal_.size();
  ready_ = unconditional_;
  for (int fact = 0; fact < task_.facts; ++fact) {
    const int node = 2 * fact + (test(state.data(), fact) ? 0 : 1);
    cost_[node] = 0;
    supporter_[node] = -2;  // true now
    if (is_goal_[node]) --goals_left;
    for (int i = used_begin_[node]; i < used_begin_[node + 1]; ++i) {
      const int rule = used_[i];
      if (--counters_[rule].open == 0) ready_.push_back(rule);
    }
  }
  if (goals_left == 0) return 0;
  std::sort(ready_.begin(), ready_.end());
  for (const int rule : ready_) fire(rule);
  explore();
  for (const int node : marked_nodes_) marked_[node] = 0;
  marked_nodes_.clear();
  for (const int node : goal_) {
    if (cost_[node] == kUnreached) return kDeadEnd;
  }
  for (const int node : goal_) mark(node);
  for (const int node : marked_nodes_) marked_[node] = 0;
  for (const int op : relaxed_ops_) op_marked_[op] = 0;
  std::sort(preferred_.begin(), preferred_.end());
  preferred_.erase(std::unique(preferred_.begin(), preferred_.end()), preferred_.end());
  if (costs_ == nullptr) return static_cast<int>(relaxed_ops_.size());
  int sum = 0;
  for (const int op : relaxed_ops_) sum += (*costs_)[static_cast<std::size_t>(op)];
  return std::min(sum, kMostCost);
}

void Heuristic::mark(int node) {
  stack_ = {node};
  while (!stack_.empty()) {
    const int at = stack_.back();
    stack_.pop_back();
    if (supporter_[at] < 0 || marked_[at]) continue;
    marked_[at] = 1;
    marked_nodes_.push_back(at);
    const int rule = supporter_[at];
    const Relaxation::Rule& one = relaxation_.rules[rule_of_[rule]];
    if (one.op >= 0) {
      if (!op_marked_[one.op]) {
        op_marked_[one.op] = 1;
        relaxed_ops_.push_back(one.op);
      }
      if (counters_[rule].cost == 0) preferred_.push_back(one.op);
    }
    for (int i = one.conditions_begin; i < one.conditions_end; ++i) stack_.push_back(relaxation_.conditions[i]);
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
