// The rules of a relaxation that bear on a goal, indexed by what they read.
#pragma once

#include <vector>

#include "engine/symbolic/relaxation.h"

namespace stampede::symbolic {

// Numbered by themselves, in the relaxation's order. Lifetime: refers to the relaxation.
struct GoalRules {
  explicit GoalRules(const Relaxation& relaxation);
  void set_goal(const std::vector<int>& goal);  // nodes; costs a pass over all rules

  struct Counter {
    int open, cost;  // conditions not yet reached; the sum of the costs of those reached
  };
  std::vector<int> number_of;                      // the relaxation's, by rule
  int costly = 0;                                  // rules below it are operators'
  std::vector<int> effects_begin, effects;         // by rule: what bears on the goal
  std::vector<int> used_begin, used_middle, used;  // by node; those from middle on only at the start
  std::vector<int> unconditional;                  // rules without conditions
  std::vector<Counter> untouched;                  // by rule: before anything is reached

 private:
  void find_stale();
  std::vector<char> relevant_rules(const std::vector<int>& goal, std::vector<char>& relevant_nodes) const;
  void index_uses();

  const Relaxation& relaxation_;
  // By condition of a rule (as in the relaxation): whether what achieves it has already had all that the rule makes
  // true. Then the rule is of use only where the condition holds from the start.
  std::vector<char> is_stale_;
  std::vector<std::vector<int>> achievers_;  // by node: rules
};

}  // namespace stampede::symbolic
