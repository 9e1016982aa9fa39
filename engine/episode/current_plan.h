// The plan that an episode follows, what it assumes of what is hidden, and what plans must mind.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "engine/rollout/assumptions.h"
#include "engine/rollout/rollout.h"
#include "engine/rollout/skill_call.h"
#include "engine/start/options.h"

namespace stampede {

// Plans are made of what is known: what can be seen, and of what can hide what was seen. Where that is not enough,
// facts that nobody could see so far are assumed, drawn from the seed. A plan that rests on them looks by what it does,
// and the rest is planned again as soon as one is seen to be wrong (determinise and plan again: Yoon, Fern, Givan,
// FF-Replan, ICAPS 2007). Lifetime: refers to all it is made of.
class CurrentPlan {
 public:
  CurrentPlan(Rollout& rollout, const RunOptions& options) : rollout_(rollout), options_(options) {}

  SkillResult make();                    // the task's own steps, or the planner's
  SkillResult again(std::size_t done);   // the first `done` steps stay, the rest is planned from here
  bool relates() const;                  // the goal asks for relations that skills make by where they put things
  bool given() const { return given_; }  // the task's own steps: never planned again
  std::size_t size() const { return steps.size(); }

  // Step `index` as it is called now; remembers what it should lead to.
  PlanStep next(std::size_t index);
  CallMode mode(std::size_t index) const;     // as it is called: what comes after it
  CallSettings set(std::size_t index) const;  // what the task's own steps say beside it
  // After `done` steps: when something else happened than they declare and the rest no longer works, the rest is
  // planned again from here. `segment`: of the last of them, which says what it was that showed an assumption.
  SkillResult watch(std::size_t done, int segment);
  // Plans the rest from here so that what was found in the way is moved first. False: it is known already, or cannot
  // be.
  bool avoid(const SkillResult& failed, std::size_t index);

  // Steps and what they rest on, which belong together: whoever puts steps back puts both back.
  struct Course {
    Plan steps;
    Facts assumed;
  };
  Course course() const { return {steps, assumed_}; }
  void take(Course course);

  // One step a line, then as comments what was assumed, and which step showed whether it was so.
  std::string as_text() const;

  Plan steps;
  std::set<PlanStep> forbidden;           // ground actions that plans do without
  std::vector<Obstruction> obstructions;  // what was found in the way of which action

 private:
  AssumingPlan ask_planner() const;
  PlanOutcome ask(const PlanningTask& planning) const;
  PlanningTask problem(const std::vector<Obstruction>& standing, const Facts& assumed, bool by_any) const;
  RandomKey key_of(const char* purpose) const;
  void look(std::size_t done, int segment);
  bool stands(const Obstruction& one) const;
  bool counts(const PlanStep& step) const;
  bool avoid_these(const std::vector<std::string>& blockers, const SkillResult& failed, std::size_t index);

  struct Look {  // what was seen of an assumption, and after how many steps
    Fact assumed;
    bool holds = false;
    std::size_t done = 0;
  };

  Rollout& rollout_;
  const RunOptions& options_;
  bool given_ = false;
  std::optional<Facts> expected_;   // basic facts that the last step should have led to
  std::optional<Facts> last_left_;  // to which a last step that counts did lead
  Facts assumed_;                   // what the steps rest on, and nobody had seen when they were planned
  Facts ever_assumed_;              // by any plan of this episode
  std::vector<Look> looks_;         // in their order
};

}  // namespace stampede
