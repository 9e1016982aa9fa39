// How plans are told, for tasks and for files alike.
#pragma once

#include <string>
#include <vector>

#include "engine/symbolic/task_planner.h"
#include "scripting/program/command.h"
#include "scripting/program/json_text.h"

namespace stampede::program {

struct FoundPlans {
  std::vector<Plan> plans;
  PlanOutcome outcome;  // of the first
  bool from_steps = false;
};

// Asks the planner that `--planner` names, or ours with the limits given. Throws UsageError for what does not go
// together.
FoundPlans ask_for_plans(const Arguments& arguments, const Domain& domain, const Problem& problem);
std::vector<OptionRow> plan_limit_options();  // --k, --expansions, --planner

// The names of the program's other texts (`panda.hand`), or those of PDDL files (`panda--hand`): a plan beside a
// problem's text names that text's objects.
enum class PlanNames { ours, pddl };
void write_plans(const FoundPlans& found, const Domain& domain, const Problem& problem, PlanNames names,
                 std::ostream& out);
void write_plans(const FoundPlans& found, const Domain& domain, const Problem& problem, PlanNames names,
                 JsonText& json);  // fields
// `4 steps, cost 4, 12 states expanded`, or why there is none; the exit code that says the same.
std::string plan_story(const FoundPlans& found);
ExitCode plan_code(const FoundPlans& found);

}  // namespace stampede::program
