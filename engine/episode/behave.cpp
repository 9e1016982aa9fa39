// What an episode does next: a plan with undo, without, with recovery, or seeded draws.
#include <algorithm>
#include <cmath>

#include "engine/episode/episode_runner.h"
#include "engine/symbolic/drawn_choice.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr double kGoalPatience = 1.0;  // s for the goal's facts to become steady after the last skill
constexpr int kFailuresPerAction = 3;  // with recovery: then plans do without it
constexpr double kMoved_m = 0.02;      // so far from where it was in the way, a thing is not in the way any more

bool geometric(Reason reason) {
  return reason == Reason::no_grasp || reason == Reason::no_placement || reason == Reason::no_path ||
         reason == Reason::unreachable;
}

}  // namespace

bool EpisodeRunner::stands(const Obstruction& one) const {
  return (rollout_->view().world_from(one.blocker).translation() - one.at).norm() < kMoved_m;
}

// What is forbidden is part of the problem of a planner that knows nothing of it: an obstruction that nothing ends.
PlanOutcome EpisodeRunner::ask_planner() {
  const FactTracker& facts = rollout_->facts();
  std::vector<Obstruction> obstructions;
  std::copy_if(obstructions_.begin(), obstructions_.end(), std::back_inserter(obstructions),
               [&](const Obstruction& one) { return stands(one); });
  if (options_.planner)
    for (const PlanStep& step : forbidden_) obstructions.push_back({step, {}, {}});
  const PlanningTask planning = planning_task(task_, symbols_.domain(), facts, rollout_->stage(), obstructions);
  if (options_.planner) return options_.planner(planning.domain, planning.problem);
  const RandomKey key = RandomKey("plan").with(task_.name()).with(task_.variation()).with(options_.seed);
  return solve_drawn(planning.domain, planning.problem, forbidden_, key);
}

SkillResult EpisodeRunner::plan_rest(std::size_t done) {
  const PlanOutcome outcome = ask_planner();
  if (!outcome.solved) return {Reason::no_plan, outcome.explanation};
  plan_.resize(std::min(done, plan_.size()));
  plan_.insert(plan_.end(), outcome.plan.begin(), outcome.plan.end());
  return {};
}

// The world's own domain, the same for all its tasks; where the goal has an order, also what the planner is asked.
void EpisodeRunner::write_problem() {
  const Domain own = named_by_content(symbols_.domain());
  record_.documents.push_back({"pddl_domain", to_pddl(own)});
  record_.documents.push_back(
      {"pddl_problem", to_pddl(world_problem(task_, rollout_->facts()), own, record_.beside_goal)});
  if (task_.stages().empty()) return;
  const PlanningTask planning = planning_task(task_, symbols_.domain(), rollout_->facts(), rollout_->stage());
  const Domain ordered = named_by_content(planning.domain);
  record_.documents.push_back({"ordered_domain", to_pddl(ordered)});
  record_.documents.push_back({"ordered_problem", to_pddl(planning.problem, ordered)});
}

SkillResult EpisodeRunner::make_plan() {
  if (record_.documents.empty()) write_problem();
  if (options_.behaviour != Behaviour::plan) return {};
  if (const auto steps = task_.steps()) {
    explicit_steps_ = true;
    plan_ = *steps;
    return {};
  }
  return plan_rest(0);
}

SkillResult EpisodeRunner::behave() {
  if (options_.behaviour != Behaviour::plan) return at_random();
  switch (options_.on_failure) {
    case OnFailure::undo:
      return with_undo();
    case OnFailure::stop:
      return straight();
    case OnFailure::recover:
      return with_recovery();
  }
  return {};
}

SkillResult EpisodeRunner::one_step(std::size_t index, std::size_t position) {
  const PlanStep step =
      explicit_steps_ ? resolve_step(plan_[index], symbols_.domain(), rollout_->facts()) : plan_[index];
  const Action* action = symbols_.domain().action(step.action);
  if (action != nullptr)
    expected_ =
        apply(*action, step.arguments, rollout_->facts().basic(), symbols_.domain(), rollout_->facts().objects());
  CallMode mode;
  mode.find_blockers = asked_.emplace(position, step).second;
  SkillResult result = driver_->run(step, subgoal_segment_, static_cast<int>(position), tries_[position], mode);
  remember(result.segment, position);
  if (result.ok()) after_skill();
  return result;
}

// After `done` steps of the plan: when something else happened than they declare and the rest no longer works, the
// rest is planned again from here.
SkillResult EpisodeRunner::watch(std::size_t done) {
  if (explicit_steps_ || done >= plan_.size() || !expected_ || *expected_ == rollout_->facts().basic()) return {};
  const PlanningTask planning = planning_task(task_, symbols_.domain(), rollout_->facts(), rollout_->stage());
  const Plan rest(plan_.begin() + static_cast<std::ptrdiff_t>(done), plan_.end());
  if (validate(planning.domain, planning.problem, rest).valid) return {};
  return plan_rest(done);
}

SkillResult EpisodeRunner::finish_goal(std::size_t position) {
  SkillResult result = driver_->wait_for_goal(frames(kGoalPatience), frames(task_.hold_s()), subgoal_segment_);
  remember(result.segment, position);
  return result;
}

void EpisodeRunner::remember(int segment, std::size_t position) { slots_[segment] = {position, ++tries_[position]}; }

SkillResult EpisodeRunner::straight() {
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    here();  // contact caches are dropped at every boundary, whether or not anything will be undone
    SkillResult result = one_step(i, i);
    if (result.ok()) result = watch(i + 1);
    if (!result.ok()) return result;
  }
  here();
  return finish_goal(plan_.size());
}

SkillResult EpisodeRunner::with_recovery() {
  std::size_t position = 0;
  std::map<PlanStep, int> failures;
  for (int tries = 0;; ++position) {
    SkillResult result;
    std::optional<PlanStep> failed;
    for (std::size_t i = 0; result.ok() && i < plan_.size(); ++i, ++position) {
      here();
      result = one_step(i, position);
      if (!result.ok()) failed = plan_[i];
      if (result.ok()) result = watch(i + 1);
    }
    here();
    if (result.ok()) result = finish_goal(position);
    if (result.ok() || result.ends_episode || explicit_steps_ || ++tries >= options_.tries_per_episode) return result;
    if (failed && avoid_obstacles(result, 0)) continue;
    if (failed && ++failures[*failed] == kFailuresPerAction) forbidden_.insert(*failed);
    if (const SkillResult planned = plan_rest(0); !planned.ok()) {
      if (forbidden_.empty()) return planned;
      forbidden_.clear();  // nothing works without what failed: try it again after all
      failures.clear();
      if (const SkillResult again = plan_rest(0); !again.ok()) return again;
    }
  }
}

// Plans the rest from here so that what was found in the way is moved first. False: it is known already, or cannot be.
bool EpisodeRunner::avoid_obstacles(const SkillResult& failed, std::size_t index) {
  if (explicit_steps_ || failed.blockers.empty() || !geometric(failed.reason)) return false;
  return std::any_of(failed.blockers.begin(), failed.blockers.end(),
                     [&](const std::vector<std::string>& way) { return avoid(way, failed, index); });
}

bool EpisodeRunner::avoid(const std::vector<std::string>& blockers, const SkillResult& failed, std::size_t index) {
  const PlanStep step = plan_[std::min(index, plan_.size() - 1)];
  const std::size_t known = obstructions_.size();
  for (const std::string& blocker : blockers) {
    Obstruction found{failed.step.value_or(step), blocker, {}, rollout_->view().world_from(blocker).translation()};
    for (const Fact& fact : rollout_->facts().basic())
      if (!fact.arguments.empty() && fact.arguments[0] == blocker) found.facts.push_back(fact);
    const bool old = std::any_of(obstructions_.begin(), obstructions_.end(), [&](const Obstruction& one) {
      return one.action == found.action && one.blocker == blocker && stands(one);
    });
    if (!old) obstructions_.push_back(std::move(found));
  }
  if (obstructions_.size() == known) return false;
  if (plan_rest(index).ok()) return true;
  obstructions_.resize(known);
  return false;
}

// Draws skills and arguments, and does not mind failing; the episode is as long as was asked for.
SkillResult EpisodeRunner::at_random() {
  const RandomKey key = RandomKey("behaviour").with(task_.name()).with(task_.variation()).with(options_.seed);
  const bool applicable = options_.behaviour == Behaviour::random_applicable;
  SkillResult result;
  for (int i = 0; i < options_.skills; ++i) {
    here();
    const RandomKey own = key.with(i);
    const std::optional<PlanStep> step = random_step(symbols_.domain(), rollout_->facts(), applicable, own);
    if (!step) return {Reason::no_plan, "no skill applies to anything here"};
    CallMode mode;
    mode.refuse = applicable;
    mode.random_parameters = true;
    plan_.push_back(*step);
    result = driver_->run(*step, subgoal_segment_, i, 0, mode);
    remember(result.segment, static_cast<std::size_t>(i));
    if (result.ok()) after_skill();
    if (result.ends_episode) return result;
  }
  here();
  return finish_goal(static_cast<std::size_t>(options_.skills));
}

}  // namespace stampede
