#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/symbolic/evaluation.h"
#include "engine/symbolic/pddl_text.h"
#include "engine/symbolic/task_planner.h"

namespace stampede {
namespace {

using symbolic::View;

// Why the step cannot be taken in `facts` (derived ones included); empty: it can.
std::string fault(const Domain& domain, const Action& action, const PlanStep& step, const Facts& facts,
                  const std::vector<TypedObject>& objects) {
  if (step.arguments.size() != action.parameters.size()) {
    return "takes " + std::to_string(action.parameters.size()) + " arguments, got " +
           std::to_string(step.arguments.size());
  }
  Binding binding;
  for (std::size_t i = 0; i < step.arguments.size(); ++i) {
    const Parameter& parameter = action.parameters[i];
    std::string fault = symbolic::argument_fault(parameter, step.arguments[i], {facts, domain, objects});
    if (!fault.empty()) return fault;
    binding[parameter.name] = step.arguments[i];
  }
  std::vector<Formula> parts = symbolic::inequalities(action, domain);
  parts.push_back(action.precondition);
  const std::vector<std::string> missing = unmet(conjunction(std::move(parts)), facts, domain, objects, binding);
  return missing.empty() ? "" : "needs " + joined(missing);
}

// What must be derived before the action can be judged.
std::set<std::string> derived_for(const Action& action, const Domain& domain) {
  std::set<std::string> needed;
  symbolic::collect_derived(action.precondition, domain, needed);
  for (const Effect& effect : action.effects) symbolic::collect_derived(effect.when, domain, needed);
  return needed;
}

// An action whose cost is undefined for its objects cannot be taken.
std::string cost_fault(const Domain& domain, const Problem& problem, const PlanStep& step) {
  try {
    plan_cost(domain, problem, {step});
    return {};
  } catch (const Error& error) {
    return error.message();
  }
}

}  // namespace

Validation validate(const Domain& domain, const Problem& problem, const Plan& plan) {
  Validation result;
  const std::vector<TypedObject> objects = symbolic::all_objects(domain, problem.objects);
  Facts facts = problem.init;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const PlanStep& step = plan[i];
    const std::string place = "step " + std::to_string(i + 1) + " " + to_text(Fact{step.action, step.arguments}) + ": ";
    const Action* action = domain.action(step.action);
    result.failed_step = static_cast<int>(i);
    if (action == nullptr) {
      std::vector<std::string> known;
      for (const Action& one : domain.actions) known.push_back(one.name);
      result.explanation = place + "unknown action; " + symbolic::did_you_mean(step.action, known);
      return result;
    }
    const std::vector<Fact> derived = symbolic::add_derived(facts, domain, objects, derived_for(*action, domain));
    std::string why = fault(domain, *action, step, facts, objects);
    if (why.empty() && !action->cost_function.empty()) why = cost_fault(domain, problem, step);
    if (!why.empty()) {
      result.explanation = place + why;
      return result;
    }
    const symbolic::Change change = symbolic::change_of(*action, step.arguments, {facts, domain, objects});
    for (const Fact& fact : derived) facts.erase(fact);
    for (const Fact& fact : change.removed) facts.erase(fact);
    facts.insert(change.added.begin(), change.added.end());  // after the removals: PDDL lets an addition win
  }
  result.failed_step = -1;
  std::set<std::string> needed;
  symbolic::collect_derived(problem.goal, domain, needed);
  symbolic::add_derived(facts, domain, objects, needed);
  const std::vector<std::string> missing = unmet(problem.goal, facts, domain, objects);
  result.valid = missing.empty();
  if (!result.valid) result.explanation = "the plan ends without " + joined(missing);
  return result;
}

}  // namespace stampede
