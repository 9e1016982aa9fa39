#include "engine/record/frame_tables.h"

#include <algorithm>
#include <limits>

namespace stampede {
namespace {

constexpr double kNotStored = std::numeric_limits<double>::quiet_NaN();

void add(std::vector<double>& table, const Pose& pose) {
  table.insert(table.end(), pose.position.begin(), pose.position.end());
  table.insert(table.end(), pose.quaternion.begin(), pose.quaternion.end());
}

void add(std::vector<double>& table, const std::vector<double>& values) {
  table.insert(table.end(), values.begin(), values.end());
}

void add_action(FrameTables& tables, const std::optional<ActionRecord>& action) {
  std::vector<double> joints = action ? action->joint_position : std::vector<double>();
  joints.resize(tables.commanded, kNotStored);
  add(tables.action_joint_position, joints);
  if (action)
    add(tables.action_tool_pose, action->tool_pose);
  else
    tables.action_tool_pose.insert(tables.action_tool_pose.end(), FrameTables::kPose, kNotStored);
  tables.action_gripper.push_back(action ? action->gripper : kNotStored);
}

}  // namespace

FrameTables frame_tables(const EpisodeRecord& episode) {
  FrameTables tables;
  tables.frames = episode.frames.size();
  for (const FrameRecord& frame : episode.frames)
    if (frame.action) tables.commanded = std::max(tables.commanded, frame.action->joint_position.size());
  for (const FrameRecord& frame : episode.frames) {
    tables.step.push_back(frame.step);
    tables.reward.push_back(frame.reward);
    tables.done.push_back(frame.done ? 1 : 0);
    add(tables.joint_position, frame.joint_position);
    add(tables.joint_velocity, frame.joint_velocity);
    add(tables.joint_effort, frame.joint_effort);
    for (const Pose& pose : frame.object_pose) add(tables.object_pose, pose);
    for (const HandRecord& hand : frame.hands) {
      add(tables.hand, hand.tip);
      tables.hand.insert(tables.hand.end(), hand.twist.begin(), hand.twist.end());
      tables.hand.push_back(hand.opening);
      tables.hand.insert(tables.hand.end(), hand.touch.begin(), hand.touch.end());
    }
    for (const Pose& pose : frame.camera_pose) add(tables.camera_pose, pose);
    tables.camera_pose.resize(tables.step.size() * episode.scene.cameras.size() * FrameTables::kPose, kNotStored);
    add_action(tables, frame.action);
  }
  return tables;
}

}  // namespace stampede
