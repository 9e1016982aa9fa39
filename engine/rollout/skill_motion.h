// One motion of a skill that is under way: its segment, the vias that it passes, and what it does to the hand.
#pragma once

#include <memory>
#include <optional>

#include "engine/motion/motion.h"
#include "engine/rollout/passages.h"
#include "engine/rollout/rollout.h"
#include "engine/rollout/skill_call.h"
#include "engine/start/robot_call.h"

namespace stampede {

// Lifetime: refers to the rollout.
class SkillMotion {
 public:
  // Opens its segment, inside of the skill's. `call`: what it was planned for; null: for none.
  SkillMotion(Rollout& rollout, int skill_segment, std::unique_ptr<Motion> motion, const RobotCall* call);

  MotionResult step() { return motion_->step(rollout_.world()); }                  // before a physics step
  void look_at_passages() { passages_.look(rollout_.world(), motion_->clock()); }  // after it
  void end(const SkillResult& result);                                             // closes its segment
  void interrupt(const SkillResult& result);                                       // likewise; the arm brakes

 private:
  void keep_passages();
  void note_grasp(bool held);
  void let_go();

  Rollout& rollout_;
  std::unique_ptr<Motion> motion_;
  std::optional<robot_call::Hand> hand_;  // what it does, where it moves the fingers alone
  std::optional<double> opening_before_;  // where it moves them on its way
  int segment_;
  Passages passages_;
};

}  // namespace stampede
