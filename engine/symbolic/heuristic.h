// The h_FF heuristic over relaxed plans made with h_add's best supporters.
#pragma once

#include <vector>

#include "engine/symbolic/state.h"

namespace stampede::symbolic {

// Hoffmann, Nebel, JAIR 2001, doi:10.1613/jair.855; supporters by h_add: Keyder, Geffner, ECAI 2008.
class Heuristic {
 public:
  explicit Heuristic(const GroundTask& task);

  void set_goal(const Literals& goal);  // literals that conditions or the task's goal mention

  static constexpr int kDeadEnd = -1;
  // The length of a relaxed plan, or kDeadEnd. Fills `applicable` and `preferred`.
  int evaluate(const Words& state);
  const std::vector<int>& applicable() const { return applicable_; }  // operators, ascending
  const std::vector<int>& preferred() const { return preferred_; }    // applicable operators of the relaxed plan
  // After a dead end: the literals of the goal that the relaxation cannot reach.
  Literals unreached_goal() const;

 private:
  struct Rule {
    int op = -1;             // -1: an axiom, costs nothing
    int begin = 0, end = 0;  // of its effects in effects_
    int conditions = 0;
    bool whole = false;  // stands for the operator's own precondition
  };
  void add_rule(int op, const std::vector<int>& condition, const std::vector<int>& effects, bool whole);
  void add_denials();
  int negated_fact(int fact);
  void enqueue(int node, int cost, int rule);
  void reach(int node, int cost);
  void fire(int rule);
  bool explore();
  void mark(int node);

  const GroundTask& task_;
  int nodes_;
  std::vector<Rule> rules_;
  std::vector<int> effects_;
  std::vector<std::vector<int>> condition_of_rule_;
  std::vector<int> used_begin_, used_;  // by node: rules with it as a condition
  std::vector<int> unconditional_;      // rules without conditions
  std::vector<int> goal_;
  std::vector<char> is_goal_;
  std::vector<char> needed_;  // by node: some condition or the goal mentions it
  std::vector<int> cost_, supporter_, open_conditions_, rule_cost_;
  std::vector<std::vector<int>> buckets_;
  std::vector<int> applicable_, preferred_, initial_conditions_, relaxed_ops_;
  std::vector<char> marked_, op_marked_;
  std::vector<int> marked_nodes_;
};

}  // namespace stampede::symbolic
