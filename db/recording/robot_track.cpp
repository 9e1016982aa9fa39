#include "db/recording/robot_track.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/model/kinematics.h"
#include "engine/model/scene_poses.h"
#include "engine/record/scene_record.h"

namespace stampede {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
constexpr double kLimitSlack = 0.05;    // rad or m: encoders and limits are not that exact
constexpr double kOpeningSlack = 0.01;  // m
constexpr double kCommandHolds = 1.0;   // s: how long a command is taken to last

const Joint& joint_of(const Robot& robot, std::size_t place) {
  return robot.body.parts[static_cast<std::size_t>(robot.arm[place])].joint;
}

std::string own_name(const Robot& robot, std::size_t place) {
  const Joint& joint = joint_of(robot, place);
  return joint.name.empty() ? robot.body.parts[static_cast<std::size_t>(robot.arm[place])].name : joint.name;
}

std::string position_column(const Robot& robot, std::size_t place) {
  return own_name(robot, place) + "_position_" + (joint_of(robot, place).kind == JointKind::slider ? "m" : "rad");
}

[[noreturn]] void beyond(const RecordingFile& recording, const RecordedStream& stream, std::size_t row,
                         const std::string& what, const std::string& hint) {
  throw Error(recording.shown_path(stream.file) + ":" + std::to_string(row + 2), what, hint);
}

std::string three(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f", value);
  return text.data();
}

// Columns of tracks at frames, and where each of the arm's is: 3 i + {0 position, 1 rate, 2 effort}.
struct Resampled {
  std::vector<double> joints, gripper, command, velocity;
  std::size_t joint_width = 0, gripper_width = 0, command_width = 0;
};

double value_at(const std::vector<double>& values, std::size_t width, std::size_t frame, std::size_t column) {
  return values.empty() ? kNotKnown : values[frame * width + column];
}

class FrameFiller {
 public:
  FrameFiller(const Scene& scene, const RobotTracks& tracks, const FrameTimes& times, EpisodeRecord& record)
      : scene_(scene),
        robot_(scene.robot),
        arm_(scene.robot),
        times_(times),
        record_(record),
        count_(robot_.arm.size()) {
    for (JointName& joint : joints_of(scene))
      if (joint.part.body < 0) record.scene.joints.push_back(std::move(joint));
    record.scene.hands = {robot_.name + "." + robot_.hand};
    resample(tracks);
  }
  void fill() {
    record_.frames.resize(times_.count);
    for (std::size_t i = 0; i < times_.count; ++i) fill_state(i);
    for (std::size_t i = 0; i + 1 < times_.count; ++i) fill_action(i);
    if (times_.count > 1) record_.frames[times_.count - 2].done = true;
  }

 private:
  void resample(const RobotTracks& tracks) {
    at_.joints = linear(*tracks.joints, times_, gap_bound(*tracks.joints));
    at_.joint_width = tracks.joints->width();
    if (tracks.gripper != nullptr) {
      at_.gripper = linear(*tracks.gripper, times_, gap_bound(*tracks.gripper));
      at_.gripper_width = tracks.gripper->width();
    }
    if (tracks.command != nullptr) {
      at_.command = held(*tracks.command, times_, kCommandHolds);
      at_.command_width = tracks.command->width();
    }
    at_.velocity.assign(times_.count * count_, kNotKnown);
    std::vector<double> positions(times_.count * count_);
    for (std::size_t frame = 0; frame < times_.count; ++frame)
      for (std::size_t i = 0; i < count_; ++i) {
        positions[frame * count_ + i] = at_.joints[frame * at_.joint_width + 3 * i];
        at_.velocity[frame * count_ + i] = at_.joints[frame * at_.joint_width + 3 * i + 1];
      }
    bool recorded = true;
    for (std::size_t i = 0; i < count_; ++i) recorded = recorded && tracks.joints->there[3 * i + 1];
    if (!recorded) at_.velocity = differences(positions, count_, times_.hz);
    record_.made.options["velocities"] = recorded ? "recorded" : "differences";
    record_.made.options["actions"] = tracks.command != nullptr ? "commanded" : "measured";
  }

  // The arm's joints at a frame; nothing where one is unknown.
  std::optional<JointVector> arm_at(std::size_t frame, const std::vector<double>& values, std::size_t width,
                                    std::size_t step) const {
    JointVector q(static_cast<Eigen::Index>(count_));
    for (std::size_t i = 0; i < count_; ++i) {
      q[static_cast<Eigen::Index>(i)] = value_at(values, width, frame, step * i);
      if (std::isnan(q[static_cast<Eigen::Index>(i)])) return std::nullopt;
    }
    return q;
  }

  void fill_state(std::size_t i) {
    FrameRecord& frame = record_.frames[i];
    frame.step = static_cast<std::int64_t>(i) * (record_.physics_hz / record_.frame_hz);
    frame.reward = kNotKnown;
    const double opening = value_at(at_.gripper, at_.gripper_width, i, 0);
    for (const JointName& joint : record_.scene.joints) {
      const auto place = std::find(robot_.arm.begin(), robot_.arm.end(), joint.part.part) - robot_.arm.begin();
      const bool finger =
          std::find(robot_.fingers.begin(), robot_.fingers.end(), joint.part.part) != robot_.fingers.end();
      double position = kNotKnown, velocity = kNotKnown, effort = kNotKnown;
      if (place < static_cast<std::ptrdiff_t>(count_)) {
        const auto at = static_cast<std::size_t>(place);
        position = at_.joints[i * at_.joint_width + 3 * at];
        velocity = at_.velocity[i * count_ + at];
        effort = at_.joints[i * at_.joint_width + 3 * at + 2];
      } else if (finger) {
        position = opening / static_cast<double>(robot_.fingers.size());
        effort = value_at(at_.gripper, at_.gripper_width, i, 1);
      }
      frame.joint_position.push_back(position);
      frame.joint_velocity.push_back(velocity);
      frame.joint_effort.push_back(effort);
    }
    fill_hand(i, opening, frame);
  }

  void fill_hand(std::size_t i, double opening, FrameRecord& frame) {
    HandRecord& hand = frame.hands.emplace_back();
    hand.tip.position.fill(kNotKnown), hand.tip.quaternion.fill(kNotKnown);
    hand.twist.fill(kNotKnown), hand.touch.fill(kNotKnown);
    hand.opening = opening;
    const auto q = arm_at(i, at_.joints, at_.joint_width, 3);
    if (!q) return;
    hand.tip = to_pose(arm_.world_from_tip(*q));
    if (const auto rate = arm_at(i, at_.velocity, count_, 1)) {
      const Eigen::Matrix<double, 6, 1> twist = arm_.jacobian(*q) * *rate;
      for (std::size_t k = 0; k < 6; ++k) hand.twist[k] = twist[static_cast<Eigen::Index>(k)];
    }
    fill_cameras(*q, frame);
  }

  // Where a camera rides on the arm, its pose is known only where the joints are.
  void fill_cameras(const JointVector& q, FrameRecord& frame) {
    const bool moving = std::any_of(scene_.cameras.begin(), scene_.cameras.end(),
                                    [](const Camera& camera) { return !camera.mount_body.empty(); });
    if (!moving && !fixed_cameras_.empty()) {
      frame.camera_pose = fixed_cameras_;
      return;
    }
    SceneState state = initial_state(scene_);
    for (std::size_t i = 0; i < count_; ++i)
      state.robot_position[static_cast<std::size_t>(robot_.arm[i])] = q[static_cast<Eigen::Index>(i)];
    const ScenePoses poses = scene_poses(scene_, state);
    for (const Camera& camera : scene_.cameras)
      frame.camera_pose.push_back(to_pose(world_from_camera(scene_, poses, camera)));
    if (!moving) fixed_cameras_ = frame.camera_pose;
  }

  void fill_action(std::size_t i) {
    const bool commanded = !at_.command.empty();
    const auto q =
        commanded ? arm_at(i, at_.command, at_.command_width, 1) : arm_at(i + 1, at_.joints, at_.joint_width, 3);
    if (!q) return;
    ActionRecord action;
    action.joint_position.assign(q->data(), q->data() + q->size());
    action.tool_pose = to_pose(arm_.world_from_tip(*q));
    action.gripper = commanded ? value_at(at_.command, at_.command_width, i, count_) : kNotKnown;
    if (std::isnan(action.gripper)) action.gripper = value_at(at_.gripper, at_.gripper_width, i + 1, 0);
    record_.frames[i].action = std::move(action);
  }

  const Scene& scene_;
  const Robot& robot_;
  Arm arm_;
  FrameTimes times_;
  EpisodeRecord& record_;
  std::size_t count_;  // of the arm's joints
  Resampled at_;
  std::vector<Pose> fixed_cameras_;
};

}  // namespace

std::vector<TrackColumn> joint_columns(const Robot& robot) {
  std::vector<TrackColumn> columns;
  for (std::size_t i = 0; i < robot.arm.size(); ++i) {
    const bool slider = joint_of(robot, i).kind == JointKind::slider;
    columns.push_back({position_column(robot, i), true});
    columns.push_back({own_name(robot, i) + (slider ? "_velocity_m_s" : "_velocity_rad_s"), false});
    columns.push_back({own_name(robot, i) + (slider ? "_effort_n" : "_effort_nm"), false});
  }
  return columns;
}

std::vector<TrackColumn> command_columns(const Robot& robot) {
  std::vector<TrackColumn> columns;
  for (std::size_t i = 0; i < robot.arm.size(); ++i) columns.push_back({position_column(robot, i), true});
  columns.push_back({"opening_m", false});
  return columns;
}

void check_joint_limits(const RecordingFile& recording, const RecordedStream& stream, const Track& track,
                        const Robot& robot) {
  const std::size_t step = stream.kind == StreamKind::joints ? 3 : 1;
  for (std::size_t row = 0; row < track.time.size(); ++row)
    for (std::size_t i = 0; i < robot.arm.size(); ++i) {
      const double q = track.at(row, step * i);
      const JointLimits& limits = robot.limits[i];
      if (std::isnan(q) || !(limits.lower < limits.upper)) continue;
      if (q < limits.lower - kLimitSlack || q > limits.upper + kLimitSlack)
        beyond(recording, stream, row,
               own_name(robot, i) + " is at " + three(q) + ", and that of " + robot.name + " goes from " +
                   three(limits.lower) + " to " + three(limits.upper),
               "positions are in rad; is this another robot, or are its joints in another order?");
    }
}

void check_openings(const RecordingFile& recording, const RecordedStream& stream, const Track& track,
                    const Robot& robot) {
  const std::size_t column = stream.kind == StreamKind::gripper ? 0 : robot.arm.size();
  for (std::size_t row = 0; row < track.time.size(); ++row) {
    const double opening = track.at(row, column);
    if (opening < -kOpeningSlack || opening > robot.opening_max + kOpeningSlack)
      beyond(recording, stream, row,
             "the hand is " + three(opening) + " m open, and that of " + robot.name + " opens by " +
                 three(robot.opening_max) + " m",
             "openings are in m, of both fingers together");
  }
}

void fill_frames(const Scene& scene, const RobotTracks& tracks, const FrameTimes& times, EpisodeRecord& record) {
  FrameFiller(scene, tracks, times, record).fill();
}

}  // namespace stampede
