// What the task planner says: a plan of skills, or why there is none.
#pragma once

#include <string>
#include <vector>

namespace stampede {

struct TaskPlanStep {
  std::string action;                  // of the domain: a skill, or skill_case
  std::vector<std::string> arguments;  // names of objects, the hand among them
};

struct TaskPlan {
  bool found = false;
  std::string end;          // "solved", "unsolvable (proved)", "gave up at the limit of expansions", "no start" …
  std::string explanation;  // not found: the goal literal that cannot be made true, and what is missing
  std::vector<TaskPlanStep> steps;
  std::string domain, problem;       // as PDDL
  std::vector<std::string> assumed;  // facts that nobody can see at the start and the plan needs; in the problem too
};

}  // namespace stampede
