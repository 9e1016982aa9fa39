// The h_FF heuristic over relaxed plans made with h_add's best supporters.
#pragma once

#include <vector>

#include "engine/symbolic/goal_rules.h"
#include "engine/symbolic/successors.h"

namespace stampede::symbolic {

// Hoffmann, Nebel, JAIR 2001, doi:10.1613/jair.855; supporters by h_add: Keyder, Geffner, ECAI 2008.
class Heuristic {
 public:
  explicit Heuristic(const GroundTask& task);
  Heuristic(const Heuristic&) = delete;
  Heuristic& operator=(const Heuristic&) = delete;

  void set_goal(const Literals& goal);  // literals that conditions or the task's goal mention

  void set_costs(const std::vector<int>* by_operator);  // null: each costs 1; kept by reference

  static constexpr int kDeadEnd = -1;
  // The cost of a relaxed plan, or kDeadEnd. Fills `applicable` and `preferred`.
  int evaluate(const Words& state);
  const std::vector<int>& applicable() const { return applicable_; }  // operators, ascending
  const std::vector<int>& preferred() const { return preferred_; }    // applicable operators of the relaxed plan
  const std::vector<int>& relaxed() const { return marked_nodes_; }   // nodes that the relaxed plan makes true
  const Relaxation& relaxation() const { return relaxation_; }
  // After a dead end: the literals of the goal that the relaxation cannot reach.
  Literals unreached_goal() const;

 private:
  void enqueue(int node, int cost, int rule);
  void fire(int rule);
  bool explore();
  void mark(int node);

  const GroundTask& task_;
  const std::vector<int>* costs_ = nullptr;
  Relaxation relaxation_;
  Successors successors_;
  GoalRules rules_;  // whose numbers rules have below

  std::vector<int> goal_;
  std::vector<char> is_goal_;
  std::vector<int> cost_, supporter_;         // by node
  std::vector<GoalRules::Counter> counters_;  // by rule
  std::vector<std::vector<int>> buckets_;
  std::vector<int> applicable_, preferred_, relaxed_ops_, ready_;
  std::vector<char> marked_, op_marked_;
  std::vector<int> marked_nodes_, stack_;
};

}  // namespace stampede::symbolic
