#include "engine/episode/current_plan.h"

#include <algorithm>

#include "engine/symbolic/drawn_choice.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr double kMoved_m = 0.02;  // so far from where it was in the way, a thing is not in the way any more

bool geometric(Reason reason) {
  return reason == Reason::no_grasp || reason == Reason::no_placement || reason == Reason::no_path ||
         reason == Reason::unreachable;
}

}  // namespace

SkillResult CurrentPlan::make() {
  if (const auto& own = rollout_.task().steps) {
    given_ = true;
    for (const TaskStep& one : *own) steps.push_back(one.step);
    return {};
  }
  return again(0);
}

SkillResult CurrentPlan::again(std::size_t done) {
  const PlanOutcome outcome = ask_planner();
  if (!outcome.solved) return {Reason::no_plan, outcome.explanation};
  steps.resize(std::min(done, steps.size()));
  steps.insert(steps.end(), outcome.plan.begin(), outcome.plan.end());
  return {};
}

bool CurrentPlan::stands(const Obstruction& one) const {
  return (rollout_.view().world_from(one.blocker).translation() - one.at).norm() < kMoved_m;
}

PlanningTask CurrentPlan::problem(const std::vector<Obstruction>& standing) const {
  PlanningTask planning =
      planning_task(rollout_.task(), rollout_.domain(), rollout_.facts(), rollout_.stage(), standing);
  const Facts known = rollout_.facts().known_basic();
  for (const Fact& fact : rollout_.facts().basic())
    if (!known.contains(fact)) planning.problem.init.erase(fact);
  planning.problem.init.insert(known.begin(), known.end());
  if (assumed_) planning.problem.init.insert(*assumed_);
  return planning;
}

PlanOutcome CurrentPlan::ask(const PlanningTask& planning) const {
  if (options_.planner) return options_.planner(planning.domain, planning.problem);
  const Task& task = rollout_.task();
  const RandomKey key = RandomKey("plan").with(task.name).with(task.variation).with(options_.seed);
  return solve_drawn(planning.domain, planning.problem, forbidden, key);
}

// What is forbidden is part of the problem of a planner that knows nothing of it: an obstruction that nothing ends.
PlanOutcome CurrentPlan::ask_planner() {
  std::vector<Obstruction> standing;
  std::copy_if(obstructions.begin(), obstructions.end(), std::back_inserter(standing),
               [&](const Obstruction& one) { return stands(one); });
  if (options_.planner)
    for (const PlanStep& step : forbidden) standing.push_back({step, {}, {}});
  assumed_.reset();
  const PlanOutcome known = ask(problem(standing));
  if (known.solved) return known;
  std::vector<Fact> unknown = conceivable();
  const Task& task = rollout_.task();
  Random(RandomKey("assume").with(task.name).with(task.variation).with(options_.seed)).shuffle(unknown);
  for (const Fact& fact : unknown) {
    assumed_ = fact;
    PlanOutcome outcome = ask(problem(standing));
    if (outcome.solved) return outcome;
  }
  assumed_.reset();
  return known;
}

// What may be assumed: facts that nobody could see, of things of which nothing is known that could change.
std::vector<Fact> CurrentPlan::conceivable() const {
  std::set<std::string> placed;
  for (const Fact& fact : rollout_.facts().known_basic()) {
    const Predicate* predicate = rollout_.domain().predicate(fact.predicate);
    if (predicate != nullptr && predicate->kind == PredicateKind::basic)
      placed.insert(fact.arguments.begin(), fact.arguments.end());
  }
  std::vector<Fact> facts = rollout_.facts().never_seen();
  std::erase_if(facts, [&](const Fact& fact) { return fact.arguments.empty() || placed.contains(fact.arguments[0]); });
  return facts;
}

// Has what the plan rests on come to light?
void CurrentPlan::look() {
  if (!assumed_) return;
  const std::vector<Fact> unknown = rollout_.facts().never_seen();
  if (std::find(unknown.begin(), unknown.end(), *assumed_) != unknown.end()) return;
  looked_.emplace(*assumed_, rollout_.facts().known(*assumed_));  // as it was when it was first seen
}

std::string CurrentPlan::as_text() const {
  std::string text = to_pddl(steps);
  for (const auto& [fact, right] : looked_)
    text += "; assumed " + to_text(fact) + " and saw that it " + (right ? "holds" : "does not hold") + "\n";
  return text;
}

PlanStep CurrentPlan::next(std::size_t index) {
  const FactTracker& facts = rollout_.facts();
  PlanStep step = given_ ? resolve_step(steps[index], rollout_.domain(), facts) : steps[index];
  if (const Action* action = rollout_.domain().action(step.action))
    expected_ = apply(*action, step.arguments, facts.basic(), rollout_.domain(), facts.objects());
  return step;
}

CallSettings CurrentPlan::set(std::size_t index) const {
  return given_ ? rollout_.task().steps->at(index).set : CallSettings{};
}

SkillResult CurrentPlan::watch(std::size_t done) {
  look();
  if (given_ || done >= steps.size() || !expected_) return {};
  const bool wrong = assumed_ && looked_.contains(*assumed_) && !looked_.at(*assumed_);
  if (!wrong && *expected_ == rollout_.facts().basic()) return {};
  if (wrong) assumed_.reset();
  const PlanningTask planning = problem({});
  const Plan rest(steps.begin() + static_cast<std::ptrdiff_t>(done), steps.end());
  if (validate(planning.domain, planning.problem, rest).valid) return {};
  return again(done);
}

bool CurrentPlan::avoid(const SkillResult& failed, std::size_t index) {
  if (given_ || failed.blockers.empty() || !geometric(failed.reason)) return false;
  return std::any_of(failed.blockers.begin(), failed.blockers.end(),
                     [&](const std::vector<std::string>& way) { return avoid_these(way, failed, index); });
}

bool CurrentPlan::avoid_these(const std::vector<std::string>& blockers, const SkillResult& failed, std::size_t index) {
  const PlanStep step = steps[std::min(index, steps.size() - 1)];
  const std::size_t known = obstructions.size();
  for (const std::string& blocker : blockers) {
    Obstruction found{failed.step.value_or(step), blocker, {}, rollout_.view().world_from(blocker).translation()};
    for (const Fact& fact : rollout_.facts().basic())
      if (!fact.arguments.empty() && fact.arguments[0] == blocker) found.facts.push_back(fact);
    const bool old = std::any_of(obstructions.begin(), obstructions.end(), [&](const Obstruction& one) {
      return one.action == found.action && one.blocker == blocker && stands(one);
    });
    if (!old) obstructions.push_back(std::move(found));
  }
  if (obstructions.size() == known) return false;
  if (again(index).ok()) return true;
  obstructions.resize(known);
  return false;
}

}  // namespace stampede
