#include "engine/learning/plan_score.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/learning/calls.h"

namespace stampede::learning {
namespace {

bool has_trait(const Domain& domain, const std::string& name) {
  return std::find(domain.traits.begin(), domain.traits.end(), name) != domain.traits.end();
}

void check_words(const Formula& formula, const Domain& learned) {
  if (formula.kind == Formula::Kind::atom && learned.predicate(formula.predicate) == nullptr &&
      !has_trait(learned, formula.predicate))
    throw Error("goal", "speaks of `" + formula.predicate + "`, which the learned domain has no word for",
                "declare it, and say which actions change it");
  for (const Formula& part : formula.parts) check_words(part, learned);
}

std::string type_in(const Domain& learned, const Domain& truth, std::string type) {
  for (std::size_t steps = 0; steps <= truth.types.size(); ++steps) {
    if (learned.types.contains(type)) return type;
    const auto above = truth.types.find(type);
    if (above == truth.types.end()) break;
    type = above->second;
  }
  return "object";
}

// One learned step as a true one, in a state.
class StepReader {
 public:
  StepReader(const Domain& truth, const std::vector<TypedObject>& objects, Facts facts)
      : truth_(truth), objects_(objects), facts_(std::move(facts)) {}

  PlanStep read(const PlanStep& step, const ActionMatch& match) const {
    const Action& action = *truth_.action(match.truth);
    PlanStep meant{action.name, std::vector<std::string>(action.parameters.size())};
    bool open = false;
    for (std::size_t i = 0; i < meant.arguments.size(); ++i) {
      if (match.slot_of[i] >= 0) meant.arguments[i] = step.arguments.at(static_cast<std::size_t>(match.slot_of[i]));
      open |= match.slot_of[i] < 0;
    }
    if (open) fill(action, meant);
    return meant;
  }
  void take(const PlanStep& step) {
    facts_ = apply(*truth_.action(step.action), step.arguments, facts_, truth_, objects_);
  }

 private:
  void fill(const Action& action, PlanStep& meant) const {
    const Facts all = with_derived(facts_, truth_, objects_);
    for (const Call& call : applicable_calls(action, {all, truth_, objects_})) {
      bool fits = true;
      for (std::size_t i = 0; i < call.size(); ++i)
        fits = fits && (meant.arguments[i].empty() || meant.arguments[i] == call[i]);
      if (!fits) continue;
      meant.arguments = call;
      return;
    }
    for (std::size_t i = 0; i < meant.arguments.size(); ++i)
      for (const TypedObject& one : objects_)
        if (meant.arguments[i].empty() && symbolic::admits(action.parameters[i], one, {all, truth_, objects_}))
          meant.arguments[i] = one.name;
  }

  const Domain& truth_;
  const std::vector<TypedObject>& objects_;
  Facts facts_;  // basic ones
};

double ratio(std::int64_t learned, std::int64_t truth) {
  if (truth == 0) return learned == 0 ? 1 : static_cast<double>(learned + 1);
  return static_cast<double>(learned) / static_cast<double>(truth);
}

}  // namespace

Problem in_words_of(const Domain& learned, const Domain& truth, const Problem& problem) {
  check_words(problem.goal, learned);
  const std::vector<TypedObject> objects = symbolic::all_objects(truth, problem.objects);
  Problem said = problem;
  said.values.clear();
  said.init.clear();
  for (const Fact& fact : with_derived(problem.init, truth, objects)) {
    const Predicate* predicate = learned.predicate(fact.predicate);
    const bool known = predicate != nullptr && predicate->parameters.size() == fact.arguments.size() &&
                       predicate->kind != PredicateKind::derived;
    if (known || has_trait(learned, fact.predicate)) said.init.insert(fact);
  }
  said.objects = objects;
  for (TypedObject& one : said.objects) one.type = type_in(learned, truth, one.type);
  return said;
}

Plan in_true_actions(const Plan& plan, const Domain& learned, const Domain& truth, const Problem& problem,
                     const std::vector<ActionMatch>& matches) {
  const std::vector<TypedObject> objects = symbolic::all_objects(truth, problem.objects);
  StepReader reader(truth, objects, problem.init);
  Plan meant;
  for (const PlanStep& step : plan) {
    if (learned.action(step.action) == nullptr) throw Error("plan", "`" + step.action + "` is no learned action");
    const ActionMatch* match = match_of(matches, step.action);
    if (match == nullptr) continue;
    PlanStep one = reader.read(step, *match);
    if (!meant.empty() && meant.back() == one) continue;
    const bool whole = std::none_of(one.arguments.begin(), one.arguments.end(),
                                    [](const std::string& argument) { return argument.empty(); });
    meant.push_back(std::move(one));
    if (!whole) break;  // nothing is of the type: it cannot be taken, and nothing after it
    reader.take(meant.back());
  }
  return meant;
}

PlannedProblem plan_with(const Domain& learned, const Domain& truth, const Problem& problem,
                         const std::vector<ActionMatch>& matches, const PlanLimits& limits) {
  PlannedProblem result;
  result.name = problem.name;
  const PlanOutcome reference = solve(truth, problem, limits);
  result.solvable = reference.solved;
  result.cost = reference.cost;
  result.expanded = reference.expanded;
  PlanOutcome found;
  try {
    found = solve(learned, in_words_of(learned, truth, problem), limits);
  } catch (const Error& error) {
    result.reason = error.where() + " " + error.message();
    return result;
  }
  result.planned = found.solved;
  result.learned_expanded = found.expanded;
  if (!found.solved) {
    result.reason = to_text(found.end) + ": " + found.explanation;
    return result;
  }
  result.plan = in_true_actions(found.plan, learned, truth, problem, matches);
  const Validation verdict = validate(truth, problem, result.plan);
  result.valid = verdict.valid;
  result.reason = verdict.explanation;
  if (verdict.valid) result.learned_cost = plan_cost(truth, problem, result.plan);
  return result;
}

double PlanScore::soundness() const { return planned == 0 ? 0 : static_cast<double>(valid) / planned; }
double PlanScore::completeness() const { return solvable == 0 ? 0 : static_cast<double>(valid_of_solvable) / solvable; }

PlanScore summary(std::vector<PlannedProblem> problems) {
  PlanScore score;
  for (const PlannedProblem& one : problems) {
    score.solvable += one.solvable;
    score.planned += one.planned;
    score.valid += one.valid;
    if (!one.valid || !one.solvable) continue;
    ++score.valid_of_solvable;
    score.cost_ratio += ratio(one.learned_cost, one.cost);
    score.expanded_ratio += ratio(one.learned_expanded, one.expanded);
  }
  if (score.valid_of_solvable > 0) {
    score.cost_ratio /= score.valid_of_solvable;
    score.expanded_ratio /= score.valid_of_solvable;
  }
  score.problems = std::move(problems);
  return score;
}

}  // namespace stampede::learning
