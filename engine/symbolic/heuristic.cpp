#include "engine/symbolic/heuristic.h"

#include <algorithm>
#include <limits>

namespace stampede::symbolic {
namespace {

constexpr int kUnreached = std::numeric_limits<int>::max();
constexpr int kMostCost = 1 << 16;  // h_add can grow without bound; beyond this all is equally far

}  // namespace

Heuristic::Heuristic(const GroundTask& task) : task_(task), relaxation_(task), successors_(task), rules_(relaxation_) {
  marked_.assign(static_cast<std::size_t>(relaxation_.nodes), 0);
  op_marked_.assign(task.operators.size(), 0);
  set_goal(task.goal);
}

void Heuristic::set_goal(const Literals& goal) {
  goal_.assign(goal.begin(), goal.end());
  is_goal_.assign(static_cast<std::size_t>(relaxation_.nodes), 0);
  for (const int node : goal_) is_goal_[node] = 1;
  rules_.set_goal(goal_);
}

void Heuristic::set_costs(const std::vector<int>* by_operator) { costs_ = by_operator; }

void Heuristic::enqueue(int node, int cost, int rule) {
  cost_[node] = cost;
  supporter_[node] = rule;
  if (static_cast<std::size_t>(cost) >= buckets_.size()) buckets_.resize(static_cast<std::size_t>(cost) + 1);
  buckets_[static_cast<std::size_t>(cost)].push_back(node);
}

void Heuristic::fire(int rule) {
  int own = rule < rules_.costly ? 1 : 0;
  if (costs_ != nullptr && own > 0)
    own = (*costs_)[static_cast<std::size_t>(relaxation_.rules[rules_.number_of[rule]].op)];
  const int cost = std::min(counters_[rule].cost + own, kMostCost);
  const int end = rules_.effects_begin[rule + 1];
  for (int i = rules_.effects_begin[rule]; i < end; ++i) {
    const int node = rules_.effects[i];
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
      for (int at = rules_.used_begin[node]; at < rules_.used_middle[node]; ++at) {
        const int rule = rules_.used[at];
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
  counters_ = rules_.untouched;
  for (auto& bucket : buckets_) bucket.clear();
  successors_.applicable(state, applicable_);
  preferred_.clear();
  marked_nodes_.clear();
  relaxed_ops_.clear();
  std::size_t goals_left = goal_.size();
  ready_ = rules_.unconditional;
  for (int fact = 0; fact < task_.facts; ++fact) {
    const int node = 2 * fact + (test(state.data(), fact) ? 0 : 1);
    cost_[node] = 0;
    supporter_[node] = -2;  // true now
    if (is_goal_[node]) --goals_left;
    for (int i = rules_.used_begin[node]; i < rules_.used_begin[node + 1]; ++i) {
      const int rule = rules_.used[i];
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
    const Relaxation::Rule& one = relaxation_.rules[rules_.number_of[rule]];
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
