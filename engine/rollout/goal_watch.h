// Standing still for the verdict: does the goal come true, and does it stay true?
#pragma once

#include "engine/rollout/rollout.h"
#include "engine/rollout/skill_execution.h"

namespace stampede {

inline constexpr const char* kHold = "hold";  // the motion's name

// Ticked like a skill's call; nobody planned it, so it is no skill but one motion segment, `hold`. Waits until the goal
// holds (`patience` frames at most, else goal_false) and then for `hold` frames more, through which it must stay true
// (else goal_unstable).
class GoalWatch {
 public:
  GoalWatch(Rollout& rollout, std::int64_t patience, std::int64_t hold, int parent_segment);
  SkillStatus tick();
  void interrupt(const std::string& why);                // between two ticks: it is over
  const SkillResult& result() const { return result_; }  // once it is over

 private:
  bool look();
  SkillStatus finish(SkillResult result);

  Rollout& rollout_;
  std::int64_t patience_, hold_;
  std::int64_t frames_ = 0, held_ = 0;
  bool step_asked_ = false, over_ = false;
  bool seen_;  // the goal held at the last frame
  SkillResult result_;
};

}  // namespace stampede
