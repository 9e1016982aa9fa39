#include "engine/rollout/skill_motion.h"

#include <utility>

#include "engine/rollout/call_motion.h"

namespace stampede {

SkillMotion::SkillMotion(Rollout& rollout, int skill_segment, std::unique_ptr<Motion> motion, const RobotCall* call)
    : rollout_(rollout),
      motion_(std::move(motion)),
      segment_(
          rollout.open_motion(motion_->kind(), skill_segment, rollout.recorder().segment(skill_segment).controller)),
      passages_(motion_->vias(), segment_) {
  if (call == nullptr) return;
  if (const auto* hand = std::get_if<robot_call::Hand>(call)) {
    hand_ = *hand;
    if (hand->expect.empty()) rollout.keep.reset();
  }
  if (moves_fingers(*call)) opening_before_ = rollout.world().opening();
  SegmentRecord& segment = rollout.recorder().segment(segment_);
  const Yielding way = yielding(*call);
  if (way == Yielding::always ||
      (way == Yielding::where_stiff && segment.controller == to_string(ControllerKind::joint_position)))
    segment.controller = to_string(ControllerKind::cartesian_impedance);
}

void SkillMotion::end(const SkillResult& result) {
  keep_passages();
  note_grasp(result.ok());
  let_go();
  if (result.reason == Reason::dropped) rollout_.keep.reset();  // once; whoever goes on has an empty hand
  rollout_.close_segment(segment_, result.reason, result.detail);
}

void SkillMotion::interrupt(const SkillResult& result) {
  motion_->interrupt(rollout_.world());
  keep_passages();
  if (hand_) note_grasp(!hand_->expect.empty() && rollout_.view().grasped(hand_->expect).holds);
  let_go();
  rollout_.close_segment(segment_, result.reason, result.detail);
}

void SkillMotion::keep_passages() {
  for (ViaRecord& via : passages_.in_order()) rollout_.recorder().vias.push_back(std::move(via));
}

void SkillMotion::note_grasp(bool held) {
  if (!hand_ || hand_->expect.empty()) return;
  const WorldView& view = rollout_.view();
  GraspRecord grasp{segment_, hand_->expect,
                    to_pose(view.world_from(hand_->expect).inverse() * view.world().world_from_tip()),
                    view.world().opening(), held};
  rollout_.recorder().grasps.push_back(std::move(grasp));
  if (held) rollout_.keep = view.part_of(hand_->expect);
}

// Where the hand was told to open on the way.
void SkillMotion::let_go() {
  if (opening_before_ && rollout_.world().commanded_opening() > *opening_before_) rollout_.keep.reset();
}

}  // namespace stampede
