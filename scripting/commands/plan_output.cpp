#include "scripting/commands/plan_output.h"

#include <fmt/format.h>

#include <ostream>

#include "engine/symbolic/pddl.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/symbol_options.h"

namespace stampede::program {
namespace {

constexpr std::int64_t kMostPlans = 1000, kMostExpansions = 1'000'000'000;

std::int64_t cost_of(const Domain& domain, const Problem& problem, const Plan& plan) {
  return plan_cost(domain, problem, plan);
}

}  // namespace

std::vector<OptionRow> plan_limit_options() {
  std::vector<OptionRow> options = {
      {"--k", "N", "up to so many plans, no two of the same actions", Takes::integer, "1", {}, false},
      {"--expansions", "N", "give up after so many expanded states", Takes::integer, "1000000", {}, false}};
  add_options(options, planner_options());
  return options;
}

FoundPlans ask_for_plans(const Arguments& arguments, const Domain& domain, const Problem& problem) {
  const std::int64_t k = in_range(arguments, "--k", 1, kMostPlans);
  PlanLimits limits;
  limits.expansions = in_range(arguments, "--expansions", 1, kMostExpansions);
  FoundPlans found;
  if (arguments.has("--planner")) {
    if (k > 1) throw UsageError("--planner gives one plan", "leave --k out");
    if (arguments.has("--expansions")) throw UsageError("--expansions is of our own planner", "leave it out");
    found.outcome = named_planner(arguments.text("--planner"))(domain, problem);
  } else {
    found.outcome = solve(domain, problem, limits);
  }
  if (!found.outcome.solved) return found;
  found.plans = {found.outcome.plan};
  if (k > 1) found.plans = solve_many(domain, problem, static_cast<int>(k), limits);
  return found;
}

void write_plans(const FoundPlans& found, const Domain& domain, const Problem& problem, PlanNames names,
                 std::ostream& out) {
  int number = 0;
  for (const Plan& plan : found.plans) {
    if (found.plans.size() > 1)
      out << fmt::format("; plan {}: {} steps, cost {}\n", ++number, plan.size(), cost_of(domain, problem, plan));
    out << (names == PlanNames::pddl ? to_pddl(plan) : to_text(plan));
  }
}

void write_plans(const FoundPlans& found, const Domain& domain, const Problem& problem, PlanNames names,
                 JsonText& json) {
  const auto name = [&](const std::string& text) { return names == PlanNames::pddl ? to_pddl_name(text) : text; };
  const auto steps = [&](const Plan& plan) {
    json.array();
    for (const PlanStep& step : plan) {
      json.object().field("action", name(step.action)).key("arguments").array();
      for (const std::string& argument : step.arguments) json.value(name(argument));
      json.end().end();
    }
    json.end();
  };
  const PlanOutcome& outcome = found.outcome;
  json.field("solved", outcome.solved).field("end", to_text(outcome.end)).field("explanation", outcome.explanation);
  json.field("expanded", outcome.expanded).field("from_steps", found.from_steps);
  json.key("plan");
  steps(found.plans.empty() ? Plan{} : found.plans.front());
  json.key("plans").array();
  for (const Plan& plan : found.plans) {
    json.object().field("steps", static_cast<std::int64_t>(plan.size()));
    if (!found.from_steps) json.field("cost", cost_of(domain, problem, plan));
    json.key("plan");
    steps(plan);
    json.end();
  }
  json.end();
}

std::string plan_story(const FoundPlans& found) {
  const PlanOutcome& outcome = found.outcome;
  if (!outcome.solved) return "no plan: " + to_text(outcome.end) + "\n    " + outcome.explanation + "\n";
  if (found.from_steps) return fmt::format("{} steps, as the task says\n", outcome.plan.size());
  const std::string more = found.plans.size() > 1 ? fmt::format(" in the first of {} plans", found.plans.size()) : "";
  return fmt::format("{} steps{}, {} states expanded\n", outcome.plan.size(), more, outcome.expanded);
}

ExitCode plan_code(const FoundPlans& found) {
  if (found.outcome.solved) return kDone;
  if (found.outcome.end == PlanEnd::no_answer) return kBadInput;  // the planner that was named is at fault
  return found.outcome.end == PlanEnd::unsolvable ? kNo : kBudgetSpent;
}

}  // namespace stampede::program
