// Plans without executing: for the start of a task, and for the PDDL of anybody.
#include <stampede/session.h>

#include <cstdio>

int main() {
  const stampede::Session session({});
  const stampede::TaskPlan plan = session.plan("put_item_in_drawer", {.seed = 7, .where = "(open chest.top_drawer)"});
  for (const stampede::TaskPlanStep& step : plan.steps) {
    std::printf("(%s", step.action.c_str());
    for (const std::string& argument : step.arguments) std::printf(" %s", argument.c_str());
    std::puts(")");
  }
  const stampede::TaskPlan same = stampede::plan_pddl(plan.domain, plan.problem);
  try {
    stampede::plan_pddl(plan.domain, "(define (problem p) (:goal");
    return 1;
  } catch (const stampede::Error& error) {
    std::printf("%s\n", error.what());
  }
  return plan.found && same.steps.size() == plan.steps.size() ? 0 : 1;
}
