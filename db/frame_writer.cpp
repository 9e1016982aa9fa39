#include "db/frame_writer.h"

#include "db/catalogue_impl.h"
#include "db/insert.h"
#include "db/table_text.h"
#include "engine/record/action_space.h"

namespace stampede {
namespace {

constexpr std::size_t kHandColumns = 16;
std::array<double, kHandColumns> columns_of(const HandRecord& hand) {
  std::array<double, kHandColumns> values{};
  auto next = std::copy(hand.tip.position.begin(), hand.tip.position.end(), values.begin());
  next = std::copy(hand.tip.quaternion.begin(), hand.tip.quaternion.end(), next);
  next = std::copy(hand.twist.begin(), hand.twist.end(), next);
  *next++ = hand.opening;
  std::copy(hand.touch.begin(), hand.touch.end(), next);
  return values;
}

constexpr std::array<const char*, 7> kPoseNames{"x", "y", "z", "qx", "qy", "qz", "qw"};

std::optional<std::string> text_where(bool there, const std::string& text) {
  return there ? std::optional(text) : std::nullopt;
}

std::string parameters_text(const std::vector<SkillParameter>& parameters) {  // {"height":[0.2]}
  std::string json = "{";
  for (const SkillParameter& one : parameters)
    json += (json.size() > 1 ? "," : "") + json_text(one.name) + ":" + to_json_numbers(one.values);
  return json + "}";
}

// The innermost segment of a kind at each frame: children start no earlier than their parents and come later.
std::vector<std::optional<int>> running(const EpisodeRecord& episode, std::string_view kind) {
  std::vector<std::optional<int>> at(episode.frames.size());
  for (const SegmentRecord& segment : episode.labels.segments) {
    if (to_string(segment.kind) != kind) continue;
    const auto end = std::min<std::int64_t>(segment.span.end_frame, static_cast<std::int64_t>(at.size()));
    for (std::int64_t frame = std::max<std::int64_t>(segment.span.first_frame, 0); frame < end; ++frame) {
      std::optional<int>& now = at[static_cast<std::size_t>(frame)];
      if (!now || *now < segment.ordinal) now = segment.ordinal;
    }
  }
  return at;
}

// Which segments run at each frame, and their names.
struct Running {
  explicit Running(const EpisodeRecord& episode)
      : skill(running(episode, "skill")), motion(running(episode, "motion")), subgoal(running(episode, "subgoal")) {
    for (const SegmentRecord& segment : episode.labels.segments) names.emplace(segment.ordinal, segment.skill);
  }
  std::optional<std::string_view> name_of(const std::optional<int>& segment) const {
    return segment ? std::optional(names.at(*segment)) : std::nullopt;
  }
  std::vector<std::optional<int>> skill, motion, subgoal;
  std::map<int, std::string_view> names;
};

}  // namespace

FrameWriter::FrameWriter(const sql::Database& database, CameraWriter& cameras)
    : database_(database),
      cameras_(cameras),
      frame_(insert(database, "frame",
                    "episode, frame, step, time_s, reward, done, skill_segment, motion_segment, "
                    "subgoal_segment, motion, subgoal")),
      joint_state_(insert(database, "joint_state",
                          "episode, frame, part, " + numbered("position", kJointsARow) + ", " +
                              numbered("velocity", kJointsARow) + ", " + numbered("effort", kJointsARow))),
      hand_state_(insert(database, "hand_state",
                         "episode, frame, hand, x, y, z, qx, qy, qz, qw, linear_x, linear_y, linear_z, angular_x, "
                         "angular_y, angular_z, opening, touch_1, touch_2")),
      object_state_(insert(database, "object_state", "episode, posed, frame, x, y, z, qx, qy, qz, qw")),
      action_channel_(insert(database, "action_channel", "episode, ordinal, space, component, name, unit")),
      action_(insert(database, "action", "episode, frame, part, " + numbered("value", kChannelsARow))),
      agent_action_(insert(database, "agent_action",
                           "episode, ordinal, frame, end_frame, space, numbers, gripper, reference, controller, "
                           "most_frames, skill, arguments, parameters, segment, reward, terminated, truncated")),
      command_(insert(database, "command", "episode, ordinal, step, kind, payload, robot")),
      channel_(insert(database, "channel", "episode, ordinal, name, unit, rate_hz")),
      component_(insert(database, "channel_component", "episode, channel, ordinal, name")),
      sample_(
          insert(database, "sample", "episode, channel, ordinal, part, step, " + numbered("value", kComponentsARow))) {}

void FrameWriter::set_running(std::int64_t id, const EpisodeRecord& episode) {
  const Running runs(episode);
  sql::Statement frame(database_,
                       "UPDATE frame SET skill_segment = ?3, motion_segment = ?4, subgoal_segment = ?5, motion = ?6, "
                       "subgoal = ?7 WHERE episode = ?1 AND frame = ?2");
  for (std::size_t i = 0; i < episode.frames.size(); ++i)
    frame.run(id, i, runs.skill[i], runs.motion[i], runs.subgoal[i], runs.name_of(runs.motion[i]),
              runs.name_of(runs.subgoal[i]));
}

void FrameWriter::write(std::int64_t id, const EpisodeRecord& episode) {
  const sql::UnknownValues unknown = unknown_values_of(episode);
  const Running runs(episode);
  for (std::size_t i = 0; i < episode.frames.size(); ++i) {
    const FrameRecord& frame = episode.frames[i];
    const std::optional<double> reward = unknown == sql::UnknownValues::allowed ? known(frame.reward) : frame.reward;
    frame_.run(id, i, frame.step, static_cast<double>(frame.step) / episode.physics_hz, reward, frame.done,
               runs.skill[i], runs.motion[i], runs.subgoal[i], runs.name_of(runs.motion[i]),
               runs.name_of(runs.subgoal[i]));
  }
  // Table by table: each grows at its end.
  for (std::size_t i = 0; i < episode.frames.size(); ++i) {
    const FrameRecord& frame = episode.frames[i];
    for (std::size_t part = 0; part * kJointsARow < episode.scene.joints.size(); ++part)
      joint_state_.run(id, i, part, part_of<double>(frame.joint_position, part, kJointsARow, unknown),
                       part_of<double>(frame.joint_velocity, part, kJointsARow, unknown),
                       part_of<double>(frame.joint_effort, part, kJointsARow, unknown));
  }
  for (std::size_t i = 0; i < episode.frames.size(); ++i) {
    int hand = 0;
    for (const HandRecord& h : episode.frames[i].hands) {
      const std::array<double, kHandColumns> values = columns_of(h);
      hand_state_.run(id, i, hand++, sql::Wide<double>{values, kHandColumns, unknown});
    }
  }
  write_poses(id, episode);
  write_actions(id, episode);
  write_agent_actions(id, episode);
  write_commands(id, episode);
  write_channels(id, episode);
}

void FrameWriter::write_poses(std::int64_t id, const EpisodeRecord& episode) {
  for (std::size_t object = 0; object < episode.scene.posed.size(); ++object) {
    const Pose* last = nullptr;
    for (std::size_t i = 0; i < episode.frames.size(); ++i) {
      const Pose& pose = episode.frames[i].object_pose[object];
      if (last && *last == pose) continue;
      object_state_.run(id, object, i, pose);
      last = &pose;
    }
  }
  for (std::size_t camera = 0; camera < episode.scene.cameras.size(); ++camera)
    cameras_.write_poses(id, static_cast<int>(camera), episode.frames.size(), [&](std::size_t frame) {
      const std::vector<Pose>& poses = episode.frames[frame].camera_pose;
      return poses.empty() ? nullptr : &poses[camera];
    });
}

void FrameWriter::write_actions(std::int64_t id, const EpisodeRecord& episode) {
  std::size_t joints = 0;
  for (const FrameRecord& frame : episode.frames)
    if (frame.action) joints = std::max(joints, frame.action->joint_position.size());
  // Commanded joints are the driven ones that are no fingers, in order; a name is missing where there are fewer.
  std::vector<std::string> names;
  for (const JointName& joint : episode.scene.joints)
    if (joint.driven) names.push_back(joint.name);
  names.resize(std::max(joints, names.size()));
  std::size_t ordinal = 0;
  for (std::size_t j = 0; j < joints; ++j) action_channel_.run(id, ordinal++, "joint_position", j, names[j], "rad");
  for (std::size_t j = 0; j < kPoseNames.size(); ++j)
    action_channel_.run(id, ordinal++, "tool_pose", j, kPoseNames[j], j < 3 ? "m" : "1");
  action_channel_.run(id, ordinal, "gripper", 0, "opening", "m");
  std::vector<std::optional<double>> values;
  for (std::size_t i = 0; i < episode.frames.size(); ++i) {
    const auto& action = episode.frames[i].action;
    if (!action) continue;
    values.assign(action->joint_position.begin(), action->joint_position.end());
    values.resize(joints);
    const auto& [position, quaternion] = action->tool_pose;
    values.insert(values.end(), position.begin(), position.end());
    values.insert(values.end(), quaternion.begin(), quaternion.end());
    values.emplace_back(episode.real ? known(action->gripper) : action->gripper);
    for (std::size_t part = 0; part * kChannelsARow < values.size(); ++part)
      action_.run(id, i, part, part_of<std::optional<double>>(values, part, kChannelsARow));
  }
}

void FrameWriter::write_agent_actions(std::int64_t id, const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const AskedAction& one : episode.agent_actions) {
    const AgentAction& asked = one.asked;
    const auto reference = text_where(is_of_tool(asked.space), asked.frame),
               controller = text_where(!asked.controller.empty(), asked.controller),
               skill = text_where(!asked.skill.empty(), asked.skill);
    std::optional<std::int64_t> segment;
    if (one.segment >= 0) segment = one.segment;
    const std::string numbers = to_json_numbers(asked.values), arguments = to_json_list(asked.arguments),
                      parameters = parameters_text(asked.parameters);
    agent_action_.run(id, ordinal++, one.first_frame, one.end_frame, asked.space, numbers, asked.gripper, reference,
                      controller, asked.frames, skill, arguments, parameters, segment, one.reward, one.terminated,
                      one.truncated);
  }
}

void FrameWriter::write_commands(std::int64_t id, const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const Command& command : episode.commands) {
    const std::string bytes = operation_to_bytes(command.operation);
    command_.run(id, ordinal++, command.step, operation_kind(command.operation), sql::Blob{bytes},
                 robot_of(command.operation).value_or(0));
  }
}

void FrameWriter::write_channels(std::int64_t id, const EpisodeRecord& episode) {
  std::size_t ordinal = 0;
  for (const ChannelRecord& channel : episode.channels) {
    channel_.run(id, ordinal, channel.name, channel.unit, channel.rate_hz);
    const std::size_t width = channel.components.size();
    for (std::size_t c = 0; c < width; ++c) component_.run(id, ordinal, c, channel.components[c]);
    for (std::size_t i = 0; i < channel.steps.size(); ++i) {
      const auto values = std::span(channel.values).subspan(i * width, width);
      for (std::size_t part = 0; part * kComponentsARow < width; ++part)
        sample_.run(id, ordinal, i, part, channel.steps[i],
                    part_of<double>(values, part, kComponentsARow, unknown_values_of(channel, episode)));
    }
    ++ordinal;
  }
}

}  // namespace stampede
