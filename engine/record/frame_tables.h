// The numbers of all frames of an episode in flat tables: what arrays are cut from.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/record/record.h"

namespace stampede {

// Row = frame, the last index fastest. Empty: not read. NaN: not known (the last frame has no action).
struct FrameTables {
  static constexpr std::size_t kPose = 7;   // x y z, qx qy qz qw
  static constexpr std::size_t kHand = 16;  // pose of the tip 7, twist 6, opening, touch 2

  std::size_t frames = 0;
  std::vector<std::int64_t> step;
  std::vector<double> reward;
  std::vector<std::uint8_t> done;
  std::vector<double> joint_position, joint_velocity, joint_effort;  // frames x EpisodeScene::joints
  std::vector<double> object_pose;                                   // frames x EpisodeScene::posed x kPose
  std::vector<double> hand;                                          // frames x EpisodeScene::hands x kHand
  std::vector<double> camera_pose;                                   // frames x EpisodeScene::cameras x kPose
  std::size_t commanded = 0;                                         // joints that actions command
  std::vector<double> action_joint_position;                         // frames x commanded
  std::vector<double> action_tool_pose;                              // frames x kPose
  std::vector<double> action_gripper;                                // frames
};

FrameTables frame_tables(const EpisodeRecord& episode);

}  // namespace stampede
