#include <fmt/format.h>

#include <ostream>

#include "engine/base/text_file.h"
#include "engine/symbolic/pddl.h"
#include "scripting/commands/commands.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

ExitCode do_validate(const Arguments& arguments, Console& console) {
  const std::string domain_file = arguments.text("DOMAIN"), problem_file = arguments.text("PROBLEM");
  const std::string plan_file = arguments.text("PLAN");
  const Domain domain = domain_from_pddl(read_text_file(domain_file), domain_file);
  const Problem problem = problem_from_pddl(read_text_file(problem_file), problem_file, domain);
  const Plan plan = plan_from_text(read_text_file(plan_file), plan_file);
  const Validation result = validate(domain, problem, plan);
  const auto steps = static_cast<std::int64_t>(plan.size());
  if (arguments.flag("--json")) {
    JsonText json;
    json.object().field("valid", result.valid).field("steps", steps);
    if (result.valid) json.field("cost", plan_cost(domain, problem, plan));
    if (!result.valid && result.failed_step >= 0)
      json.field("failed_step", result.failed_step + 1)
          .field("failed_action", to_text(Plan{plan[static_cast<std::size_t>(result.failed_step)]}));
    console.out << json.field("explanation", result.explanation).end().text();
  } else if (result.valid) {
    console.out << fmt::format("valid: {} steps, cost {}\n", steps, plan_cost(domain, problem, plan));
  } else if (result.failed_step >= 0) {
    console.out << fmt::format("not valid: step {} of {}\n    {}\n", result.failed_step + 1, steps, result.explanation);
  } else {
    console.out << fmt::format("not valid: the goal does not hold after {} steps\n    {}\n", steps, result.explanation);
  }
  return result.valid ? kDone : kNo;
}

}  // namespace

CommandRow validate_command() {
  return {
      "validate",
      "Check a plan against a PDDL domain and problem",
      "Any author's PDDL. The plan has one `(action argument …)` a line, with or without a time before it. The exit "
      "code is 1 for a plan that is not valid: then it names the first action that cannot be taken and what its "
      "precondition misses, or the parts of the goal that do not hold at the end.",
      {{"DOMAIN", "the file of the domain", true, false},
       {"PROBLEM", "the file of the problem", true, false},
       {"PLAN", "the file of the plan", true, false}},
      {},
      {"stampede validate domain.pddl problem.pddl plan.txt"},
      do_validate};
}

}  // namespace stampede::program
