#include "engine/episode/current_plan.h"

#include <algorithm>

#include "engine/start/relations.h"
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
  const AssumingPlan found = ask_planner();
  if (!found.outcome.solved) return {Reason::no_plan, found.outcome.explanation};
  steps.resize(std::min(done, steps.size()));
  steps.insert(steps.end(), found.outcome.plan.begin(), found.outcome.plan.end());
  assumed_ = found.assumed;
  ever_assumed_.insert(assumed_.begin(), assumed_.end());
  return {};
}

// It promises how many, not which.
bool CurrentPlan::counts(const PlanStep& step) const {
  const Action* action = rollout_.domain().action(step.action);
  return action != nullptr && std::ranges::any_of(action->effects, [](const Effect& one) { return one.at_least > 0; });
}

bool CurrentPlan::relates() const { return !relations_asked(rollout_.task(), rollout_.facts()).empty(); }

void CurrentPlan::take(Course course) {
  steps = std::move(course.steps);
  assumed_ = std::move(course.assumed);
}

bool CurrentPlan::stands(const Obstruction& one) const {
  return (rollout_.view().world_from(one.blocker).translation() - one.at).norm() < kMoved_m;
}

PlanningTask CurrentPlan::problem(const std::vector<Obstruction>& standing, const Facts& assumed, bool by_any) const {
  PlanningTask planning =
      planning_task(rollout_.task(), rollout_.domain(), rollout_.facts(), rollout_.stage(), standing, by_any);
  keep_known(planning.problem, rollout_.facts(), assumed);
  return planning;
}

PlanOutcome CurrentPlan::ask(const PlanningTask& planning) const {
  if (options_.planner) return options_.planner.plan(planning.domain, planning.problem);
  return solve_drawn(planning.domain, planning.problem, forbidden, key_of("plan"));
}

RandomKey CurrentPlan::key_of(const char* purpose) const {
  return RandomKey(purpose).with(rollout_.task().name).with(rollout_.task().variation).with(options_.seed);
}

// What is forbidden is part of the problem of a planner that knows nothing of it: an obstruction that nothing ends.
AssumingPlan CurrentPlan::ask_planner() const {
  std::vector<Obstruction> standing;
  std::copy_if(obstructions.begin(), obstructions.end(), std::back_inserter(standing),
               [&](const Obstruction& one) { return stands(one); });
  if (options_.planner)
    for (const PlanStep& step : forbidden) standing.push_back({step, {}, {}});
  const auto plan = [&](bool by_any) {
    return plan_assuming(problem(standing, {}, by_any), conceivable(rollout_.facts()), key_of("assume"),
                         [&](const PlanningTask& planning) { return ask(planning); });
  };
  AssumingPlan found = plan(false);
  if (!found.outcome.solved && relates())
    if (AssumingPlan other = plan(true); other.outcome.solved) found = std::move(other);  // the other thing makes room
  std::string& explanation = found.outcome.explanation;
  if (!found.outcome.solved) explanation += why_not_assumed(not_assumed(rollout_.facts()), explanation);
  if (!found.outcome.solved && rollout_.task().empty_hand)
    explanation += "; the hand must be empty at the end, unless the task says hand = \"any\"";
  return found;
}

// After `done` steps: what has come to light of all that was assumed. What undone steps showed is not known any more.
void CurrentPlan::look(std::size_t done, int segment) {
  if (ever_assumed_.empty()) return;
  std::erase_if(looks_, [&](const Look& one) { return one.done >= done; });
  const Facts open = conceivable(rollout_.facts());
  for (const Fact& fact : ever_assumed_) {
    const auto is_it = [&](const Look& one) { return one.assumed == fact; };
    if (open.contains(fact) || std::any_of(looks_.begin(), looks_.end(), is_it)) continue;
    looks_.push_back({fact, rollout_.facts().known(fact), done});
    if (segment >= 0) rollout_.recorder().segment(segment).searched_for.push_back(to_text(fact));
  }
}

std::string CurrentPlan::as_text() const {
  std::string text = to_pddl(steps);
  for (const Look& one : looks_) {
    text += "; assumed " + to_text(one.assumed) + " and saw that it " + (one.holds ? "holds" : "does not hold") + "\n";
    if (one.done > 0 && one.done <= steps.size()) {
      const PlanStep& step = steps[one.done - 1];
      text += "; step " + std::to_string(one.done) + " searched: " + to_text(Fact{step.action, step.arguments}) + "\n";
    }
  }
  return text;
}

PlanStep CurrentPlan::next(std::size_t index) {
  const FactTracker& facts = rollout_.facts();
  PlanStep step = given_ ? resolve_step(steps[index], rollout_.domain(), facts) : steps[index];
  if (const Action* action = rollout_.domain().action(step.action))
    expected_ = apply(*action, step.arguments, facts.basic(), rollout_.domain(), facts.objects());
  return step;
}

CallMode CurrentPlan::mode(std::size_t index) const {
  CallMode mode;
  mode.then.assign(steps.begin() + static_cast<std::ptrdiff_t>(std::min(index + 1, steps.size())), steps.end());
  return mode;
}

CallSettings CurrentPlan::set(std::size_t index) const {
  return given_ ? rollout_.task().steps->at(index).set : CallSettings{};
}

SkillResult CurrentPlan::watch(std::size_t done, int segment) {
  look(done, segment);
  if (given_ || !expected_) return {};
  if (done >= steps.size()) {
    if (rollout_.holds_now(rollout_.task().goal)) return {};
    if (counts(steps[done - 1]) && rollout_.facts().basic() != last_left_) {  // fewer came true than was counted on
      last_left_ = rollout_.facts().basic();
      return again(done);
    }
    if (!relates()) return {};      // more was hoped for of where things are put than could be
    forbidden = {steps[done - 1]};  // it would bring about no more; what was in vain before may not be now
    return again(done);
  }
  const FactTracker& facts = rollout_.facts();
  const Facts open = assumed_.empty() ? Facts{} : conceivable(facts);
  const bool wrong = std::any_of(assumed_.begin(), assumed_.end(),
                                 [&](const Fact& fact) { return !open.contains(fact) && !facts.known(fact); });
  if (!wrong && *expected_ == facts.basic()) return {};
  const PlanningTask planning = problem({}, assumed_, true);
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
