// The h_FF heuristic over relaxed plans made with h_add's best supporters.
#pragma once

#include <vector>

#include "engine/symbolic/relaxation.h"
#include "engine/symbolic/successors.h"

namespace stampede::symbolic {

// Hoffmann, Nebel, JAIR 2001, doi:10.1613/jair.855; supporters by h_add: Keyder, Geffner, ECAI 2008.
class Heuristic {
 public:
  explicit Heuristic(const GroundTask& task);

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
  struct Counter {   // in the numbers of set_goal
    int open, cost;  // conditions not yet reached; the sum of the costs of those reached
  };
  void find_stale();
  std::vector<char> relevant_rules(std::vector<char>& relevant_nodes) const;
  void index_uses();
  void enqueue(int node, int cost, int rule);
  void fire(int rule);
  bool explore();
  void mark(int node);

  const GroundTask& task_;
  const std::vector<int>* costs_ = nullptr;
  Relaxation relaxation_;
  Successors successors_;
  // By condition of a rule (as in the relaxation): whether what achieves it has already had all that the rule makes
  // true. Then the rule is of use only where the condition holds from the start.
  std::vector<char> is_stale_;
  std::vector<std::vector<int>> achievers_;  // by node: rules

  // What bears on the goal, by its own numbers for rules; made by set_goal.
  std::vector<int> rule_of_;                          // the relaxation's
  int costly_ = 0;                                    // rules below it are operators'
  std::vector<int> effects_begin_, effects_;          // by rule
  std::vector<int> used_begin_, used_middle_, used_;  // by node; those from middle on only at the start
  std::vector<int> unconditional_;                    // rules without conditions

  std::vector<int> goal_;
  std::vector<char> is_goal_;
  std::vector<int> cost_, supporter_;          // by node
  std::vector<Counter> counters_, untouched_;  // by rule
  std::vector<std::vector<int>> buckets_;
  std::vector<int> applicable_, preferred_, relaxed_ops_, ready_;
  std::vector<char> marked_, op_marked_;
  std::vector<int> marked_nodes_, stack_;
};

}  // namespace stampede::symbolic
