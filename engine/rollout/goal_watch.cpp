#include "engine/rollout/goal_watch.h"

namespace stampede {

GoalWatch::GoalWatch(Rollout& rollout, std::int64_t patience, std::int64_t hold, std::int64_t held, int parent_segment)
    : rollout_(rollout), patience_(patience), hold_(hold), held_(held), looked_(rollout.step()) {
  result_.segment = rollout.open_motion(kHold, parent_segment);
  seen_ = rollout_.at_frame() && rollout_.goal_holds();
}

SkillStatus GoalWatch::tick() {
  if (over_) return result_.ok() ? SkillStatus::done : SkillStatus::failed;
  if (rollout_.step() != looked_) {
    looked_ = rollout_.step();
    if (const Reason reason = rollout_.ended(); reason != Reason::none)
      return finish({reason, std::string(describe(reason)), true});
    if (rollout_.at_frame() && !look())
      return finish({Reason::goal_unstable, std::string(describe(Reason::goal_unstable))});
  }
  if (seen_ ? held_ < hold_ : frames_ < patience_) return SkillStatus::running;
  return finish(seen_ ? SkillResult{} : SkillResult{Reason::goal_false, rollout_.unmet_goal()});
}

void GoalWatch::interrupt(const std::string& why) {
  if (!over_) finish({Reason::interrupted, why});
}

// At a frame; false when the goal has been lost.
bool GoalWatch::look() {
  const bool now = rollout_.goal_holds(), lost = seen_ && !now;
  if (seen_) ++held_;
  seen_ = now;
  ++frames_;
  return !lost;
}

SkillStatus GoalWatch::finish(SkillResult result) {
  over_ = true;
  result.segment = result_.segment;
  result_ = std::move(result);
  rollout_.close_segment(result_.segment, result_.reason, result_.detail);
  return result_.ok() ? SkillStatus::done : SkillStatus::failed;
}

}  // namespace stampede
