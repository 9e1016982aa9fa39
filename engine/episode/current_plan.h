// The plan that an episode follows, what it has learned that plans must mind, and what it assumes of what is hidden.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "engine/episode/planning.h"
#include "engine/episode/rollout.h"
#include "engine/episode/runner.h"
#include "engine/episode/skill_call.h"

namespace stampede {

// Plans are made of what is known: what can be seen, and of what can hide what was seen. Where that is not enough, one
// fact that nobody could see so far is assumed, drawn from the seed. A plan that rests on it looks by what it does, and
// the rest is planned again as soon as the assumption is seen to be wrong (determinise and plan again: Yoon, Fern,
// Givan, FF-Replan, ICAPS 2007). Lifetime: refers to all it is made of.
class CurrentPlan {
 public:
  CurrentPlan(const Rollout& rollout, const RunOptions& options) : rollout_(rollout), options_(options) {}

  SkillResult make();                    // the task's own steps, or the planner's
  SkillResult again(std::size_t done);   // the first `done` steps stay, the rest is planned from here
  bool given() const { return given_; }  // the task's own steps: never planned again
  std::size_t size() const { return steps.size(); }

  // Step `index` as it is called now; remembers what it should lead to.
  PlanStep next(std::size_t index);
  CallSettings set(std::size_t index) const;  // what the task's own steps say beside it
  // After `done` steps: when something else happened than they declare and the rest no longer works, the rest is
  // planned again from here.
  SkillResult watch(std::size_t done);
  // Plans the rest from here so that what was found in the way is moved first. False: it is known already, or cannot
  // be.
  bool avoid(const SkillResult& failed, std::size_t index);

  // One step a line, then what was assumed on the way, as comments.
  std::string as_text() const;

  Plan steps;
  std::set<PlanStep> forbidden;           // ground actions that plans do without
  std::vector<Obstruction> obstructions;  // what was found in the way of which action

 private:
  PlanOutcome ask_planner();
  PlanOutcome ask(const PlanningTask& planning) const;
  PlanningTask problem(const std::vector<Obstruction>& standing) const;
  std::vector<Fact> conceivable() const;
  void look();
  bool stands(const Obstruction& one) const;
  bool avoid_these(const std::vector<std::string>& blockers, const SkillResult& failed, std::size_t index);

  const Rollout& rollout_;
  const RunOptions& options_;
  bool given_ = false;
  std::optional<Facts> expected_;  // basic facts that the last step should have led to
  std::optional<Fact> assumed_;    // what the rest of the plan rests on, and nobody has seen
  std::map<Fact, bool> looked_;    // what was assumed, and how it was seen to be
};

}  // namespace stampede
