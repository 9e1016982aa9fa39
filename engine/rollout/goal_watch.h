// Standing still for the verdict: does the goal come true, and does it stay true?
#pragma once

#include "engine/rollout/rollout.h"
#include "engine/rollout/skill_execution.h"

namespace stampede {

inline constexpr const char* kHold = "hold";  // the motion's name

// Ticked like a skill's call; nobody planned it, so it is no skill but one motion segment, `hold`. Waits until the goal
// holds (`patience` frames at most, else goal_false) and then until it has held for `hold` frames, through which it
// must stay true (else goal_unstable); `held` of them have gone by already.
class GoalWatch {
 public:
  GoalWatch(Rollout& rollout, std::int64_t patience, std::int64_t hold, std::int64_t held, int parent_segment);
  SkillStatus tick();                                    // again without a step between: the same answer
  void interrupt(const std::string& why);                // between two ticks: it is over
  const SkillResult& result() const { return result_; }  // once it is over
  std::int64_t held() const { return seen_ ? held_ : -1; }

 private:
  bool look();
  SkillStatus finish(SkillResult result);

  Rollout& rollout_;
  std::int64_t patience_, hold_;
  std::int64_t frames_ = 0, held_, looked_;
  bool over_ = false;
  bool seen_;  // the goal held at the last frame
  SkillResult result_;
};

}  // namespace stampede
