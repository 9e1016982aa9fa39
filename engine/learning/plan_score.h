// Plans made with a learned domain, judged by the true one.
#pragma once

#include <string>
#include <vector>

#include "engine/learning/matching.h"
#include "engine/symbolic/task_planner.h"

namespace stampede::learning {

// The problem in the words of the learned domain: facts that it declares and does not derive (what the true domain
// derives among them), types that it lacks replaced by the nearest above that it has.
// Throws Error for a goal that it has no words for.
Problem in_words_of(const Domain& learned, const Domain& truth, const Problem& problem);

// The plan in true actions, step by step from the problem's start. Arguments that a learned action does not have are
// bound by the true precondition there (the first binding that fits, in the order of objects; none: the first of the
// right types). A step that stands for no true action is left out, and so is one that repeats the call before it.
Plan in_true_actions(const Plan& plan, const Domain& learned, const Domain& truth, const Problem& problem,
                     const std::vector<ActionMatch>& matches);

struct PlannedProblem {
  std::string name;
  bool solvable = false;                    // by our planner, with the true domain
  bool planned = false;                     // with the learned one
  bool valid = false;                       // that plan, by the true domain
  std::int64_t cost = 0, learned_cost = 0;  // by the true domain, of its plan and of a valid one
  std::int64_t expanded = 0, learned_expanded = 0;
  Plan plan;           // in true actions
  std::string reason;  // why there is none, or why it is not valid
};
PlannedProblem plan_with(const Domain& learned, const Domain& truth, const Problem& problem,
                         const std::vector<ActionMatch>& matches, const PlanLimits& limits = {});

struct PlanScore {
  std::vector<PlannedProblem> problems;
  int solvable = 0, planned = 0, valid = 0, valid_of_solvable = 0;
  double soundness() const;     // valid plans of all plans made; 0 without any
  double completeness() const;  // of the problems that the true domain solves, those with a valid plan
  // Means over problems with both plans: learned cost by true cost (both cost 0: 1); states expanded likewise (of 0:
  // 1).
  double cost_ratio = 0, expanded_ratio = 0;
};
PlanScore summary(std::vector<PlannedProblem> problems);

}  // namespace stampede::learning
