#include "engine/episode/dense_reward.h"

#include <algorithm>
#include <cmath>

#include "engine/start/effects.h"
#include "engine/symbolic/drawn_choice.h"

namespace stampede {
namespace {

constexpr double kScale = 5;      // 1/m
constexpr double kNearest = 0.9;  // of a step, as long as what it brings about does not hold

}  // namespace

DenseReward::DenseReward(Rollout& rollout, Symbols& symbols, RandomKey key)
    : rollout_(rollout), symbols_(symbols), key_(key) {
  look();
  first_ = std::max<std::size_t>(1, state_.plan.size());
}

// Do the steps from `from` on work, one after the other, and end in the goal?
bool DenseReward::leads(std::size_t from, Facts facts, const PlanningTask& asked) const {
  const auto& objects = asked.problem.objects;
  for (std::size_t i = from; i < state_.plan.size(); ++i) {
    const Action& action = *asked.domain.action(state_.plan[i].action);
    if (!holds(action.precondition, facts, asked.domain, objects, binding_of(action, state_.plan[i].arguments)))
      return false;
    facts = with_derived(apply(action, state_.plan[i].arguments, facts, asked.domain, objects), asked.domain, objects);
  }
  return holds(asked.problem.goal, facts, asked.domain, objects);
}

// Has the present step begun to do what it should, so that the rest works once it has? What it brings about comes true
// one fact after the other: in between neither it nor what follows is possible.
bool DenseReward::under_way(const Facts& now, const PlanningTask& asked) const {
  if (state_.next >= state_.plan.size()) return false;
  const auto& objects = asked.problem.objects;
  const PlanStep& step = state_.plan[state_.next];
  const Action& action = *asked.domain.action(step.action);
  const std::vector<Literal> effects = ground_effects(action, step.arguments, now, asked.domain, objects);
  const auto came = [&](const Literal& one) { return !one.negated && now.contains(one.fact); };
  if (std::none_of(effects.begin(), effects.end(), came)) return false;
  return leads(state_.next + 1,
               with_derived(apply(action, step.arguments, now, asked.domain, objects), asked.domain, objects), asked);
}

void DenseReward::look() {
  state_.done = rollout_.goal_holds();  // `also` may come true while no fact changes
  if (state_.looked_at == rollout_.facts().changes() && state_.stage == rollout_.stage()) return;
  state_.looked_at = rollout_.facts().changes();
  state_.stage = rollout_.stage();
  const PlanningTask asked = planning_task(rollout_.task(), rollout_.domain(), rollout_.facts(), rollout_.stage());
  const Facts now = with_derived(asked.problem.init, asked.domain, asked.problem.objects);
  state_.lost = false;
  for (std::size_t i = state_.plan.size() + 1; i-- > 0;)  // the shortest rest that will do; of a goal that holds, none
    if (leads(i, now, asked)) {
      state_.next = i;
      return;
    }
  if (under_way(now, asked)) return;
  const PlanOutcome found = solve_drawn(asked.domain, asked.problem, {}, key_);
  state_.lost = !found.solved;
  if (state_.lost) return;
  state_.plan = found.plan;
  state_.next = 0;
}

// Of what the next step brings about; of one that only ends something, of that.
double DenseReward::nearness() const {
  if (state_.next >= state_.plan.size()) return -(1 - kNearest) / 2;  // what the goal asks beside facts is left
  const Domain& domain = rollout_.domain();
  const FactTracker& facts = rollout_.facts();
  std::vector<Literal> effects =
      ground_effects(*domain.action(state_.plan[state_.next].action), state_.plan[state_.next].arguments, facts.facts(),
                     domain, facts.objects());
  std::erase_if(effects, [&](const Literal& one) {
    const Predicate* predicate = domain.predicate(one.fact.predicate);
    return predicate == nullptr || predicate->kind != PredicateKind::basic;
  });
  const auto brings = [](const Literal& one) { return !one.negated; };
  if (std::any_of(effects.begin(), effects.end(), brings))
    std::erase_if(effects, [](const Literal& one) { return one.negated; });
  double sum = 0;
  for (const Literal& one : effects) {
    const Symbols::Value value = symbols_.value(one.fact, rollout_.view());
    if (facts.facts().contains(one.fact) != one.negated || value.holds != one.negated)
      sum += 1;
    else if (value.margin)
      sum += 1 - std::tanh(kScale * std::abs(*value.margin));
  }
  return effects.empty() ? 0 : kNearest * sum / static_cast<double>(effects.size());
}

void DenseReward::restore(State state) {
  state_ = std::move(state);
  state_.looked_at = rollout_.facts().changes();
}

double DenseReward::value() {
  look();
  if (state_.done) return 1;
  if (state_.lost) return -1;
  const auto left = static_cast<double>(state_.plan.size() - state_.next);
  return 1 - (left - nearness()) / static_cast<double>(first_);
}

}  // namespace stampede
