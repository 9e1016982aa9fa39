// Ordered goals become fluents that the planner keeps in order.
#include "engine/start/planning.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/support/plain_task.h"

using namespace stampede;

namespace {

Term object(const char* name) { return {false, name}; }

// cube1 on cube2 first, then cube3 on cube1: or the other way round, which no plan can do with the last one buried.
Plan plan_for(const std::vector<Formula>& stages) {
  Task task = plain::stack_task();
  task.stages = stages;
  task.goal = conjunction(stages);
  plain::PlainSymbols symbols;
  World world(std::make_shared<const Scene>(table_scene(3)));
  WorldView view(world);
  FactTracker tracker(symbols, view);
  auto values = tracker.read_all(view);
  for (const char* cube : {"cube1", "cube2", "cube3"}) values[{"on", {cube, "table"}}].holds = true;
  tracker.begin(values);
  const PlanningTask planning = planning_task(task, symbols.domain(), tracker, 0);
  const PlanOutcome outcome = solve(planning.domain, planning.problem);
  INFO(outcome.explanation);
  REQUIRE(outcome.solved);
  return outcome.plan;
}

std::size_t step_of(const Plan& plan, const std::string& action, const std::string& first) {
  for (std::size_t i = 0; i < plan.size(); ++i)
    if (plan[i].action == action && plan[i].arguments[0] == first) return i;
  FAIL(action + " " + first + " is not in the plan");
  return 0;
}

}  // namespace

TEST_CASE("the plan makes the parts of an ordered goal true in their order") {
  const Formula first = atom("on", {object("cube1"), object("cube2")});
  const Formula second = atom("on", {object("cube3"), object("cube1")});
  const Plan forward = plan_for({first, second}), backward = plan_for({second, first});
  CHECK(step_of(forward, "place", "cube1") < step_of(forward, "place", "cube3"));
  CHECK(step_of(backward, "place", "cube3") < step_of(backward, "place", "cube1"));
}

TEST_CASE("one action may make all of a part true at once") {
  const Formula empty = atom("hand_empty", {object("panda.hand")});
  const Formula first = conjunction({atom("on", {object("cube1"), object("cube2")}), empty});
  const Formula second = conjunction({atom("on", {object("cube3"), object("cube1")}), empty});
  CHECK(plan_for({first, second}).size() == 4);  // and nothing is picked up only to be put down again
}

TEST_CASE("a part that is no conjunction of literals is refused with its cure") {
  CHECK_THROWS_AS(plan_for({disjunction({atom("on", {object("cube1"), object("cube2")}),
                                         atom("on", {object("cube2"), object("cube1")})})}),
                  Error);
}
