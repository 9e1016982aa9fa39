// Re-simulates a stored episode from its scene and its commands: no script, no planner.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/episode/recorder.h"
#include "engine/episode/runner.h"
#include "engine/episode/sensors.h"

namespace stampede {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// Every bit counts but the sign of zero, which SQLite does not keep.
bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

class Comparison {
 public:
  explicit Comparison(std::int64_t frame) : frame_(frame) {}
  void value(const std::string& name, double stored, double now) {
    if (difference.empty() && !same(stored, now))
      difference =
          "frame " + std::to_string(frame_) + ", " + name + ": stored " + number(stored) + ", now " + number(now);
  }
  template <typename Values>
  void values(const std::string& name, const Values& stored, const Values& now) {
    if (stored.size() != now.size())
      difference = "frame " + std::to_string(frame_) + ", " + name + ": stored " + std::to_string(stored.size()) +
                   " values, now " + std::to_string(now.size());
    else
      for (std::size_t i = 0; i < stored.size(); ++i) value(name + "[" + std::to_string(i) + "]", stored[i], now[i]);
  }
  void pose(const std::string& name, const Pose& stored, const Pose& now) {
    values(name + " position", stored.position, now.position);
    values(name + " quaternion", stored.quaternion, now.quaternion);
  }
  std::string difference;

 private:
  std::int64_t frame_;
};

std::string compare(std::int64_t index, const EpisodeRecord& episode, const FrameRecord& now) {
  const FrameRecord& stored = episode.frames[static_cast<std::size_t>(index)];
  Comparison comparison(index);
  for (std::size_t i = 0; i < episode.joints.size() && i < stored.joint_position.size(); ++i) {
    comparison.value(episode.joints[i].name + " position", stored.joint_position[i], now.joint_position[i]);
    comparison.value(episode.joints[i].name + " velocity", stored.joint_velocity[i], now.joint_velocity[i]);
    comparison.value(episode.joints[i].name + " effort", stored.joint_effort[i], now.joint_effort[i]);
  }
  for (std::size_t i = 0; i < episode.posed.size() && i < stored.object_pose.size(); ++i)
    comparison.pose(episode.posed[i], stored.object_pose[i], now.object_pose[i]);
  for (std::size_t i = 0; i < stored.camera_pose.size() && i < now.camera_pose.size(); ++i)
    comparison.pose("camera " + std::to_string(i), stored.camera_pose[i], now.camera_pose[i]);
  for (std::size_t i = 0; i < stored.hands.size() && i < now.hands.size(); ++i) {
    comparison.pose("tip", stored.hands[i].tip, now.hands[i].tip);
    comparison.values("twist", stored.hands[i].twist, now.hands[i].twist);
    comparison.value("opening", stored.hands[i].opening, now.hands[i].opening);
    comparison.values("touch", stored.hands[i].touch, now.hands[i].touch);
  }
  return comparison.difference;
}

std::string compare_action(std::int64_t index, const EpisodeRecord& episode, const ActionRecord& now) {
  const auto& stored = episode.frames[static_cast<std::size_t>(index)].action;
  if (!stored) return "frame " + std::to_string(index) + ": no action is stored";
  Comparison comparison(index);
  comparison.values("action joint_position", stored->joint_position, now.joint_position);
  comparison.pose("action tool_pose", stored->tool_pose, now.tool_pose);
  comparison.value("action gripper", stored->gripper, now.gripper);
  return comparison.difference;
}

// Channels of other sources, which an embedder added, cannot be read again.
std::string compare_channels(const EpisodeRecord& episode, const std::vector<ChannelRecord>& now) {
  for (const ChannelRecord& again : now) {
    const auto stored = std::find_if(episode.channels.begin(), episode.channels.end(),
                                     [&](const ChannelRecord& channel) { return channel.name == again.name; });
    if (stored == episode.channels.end()) return "channel " + again.name + " is not stored";
    if (stored->steps != again.steps) return "channel " + again.name + ": it was read at other steps";
    for (std::size_t i = 0; i < again.values.size(); ++i)
      if (!same(stored->values.at(i), again.values[i]))
        return "channel " + again.name + ", value " + std::to_string(i) + ": stored " + number(stored->values[i]) +
               ", now " + number(again.values[i]);
  }
  return {};
}

}  // namespace

std::string replay_episode(const EpisodeRecord& episode) {
  if (episode.frames.empty()) return {};
  World world(std::make_shared<const Scene>(scene_from_document(episode.scene_document)));
  WorldView view(world);
  const FrameReader reader(view);
  SensorReader sensors(world.scene(), chosen(observation_of(episode)),
                       sensor_key(episode.task, episode.variation, episode.seed));
  const std::int64_t per_frame = episode.physics_hz / episode.frame_hz;
  std::size_t next = 0;
  for (std::int64_t index = 0; index < static_cast<std::int64_t>(episode.frames.size()); ++index) {
    while (index > 0 && world.step_count() < index * per_frame) {
      while (next < episode.commands.size() && episode.commands[next].step == world.step_count())
        world.apply(episode.commands[next++].operation);
      world.step();
      sensors.step(world);
    }
    if (index > 0) {
      world.close_window();
      if (std::string found = compare_action(index - 1, episode, reader.action(world)); !found.empty()) return found;
    }
    if (std::string found = compare(index, episode, reader.read(view)); !found.empty()) return found;
  }
  if (std::string found = compare_channels(episode, sensors.channels()); !found.empty()) return found;
  if (world.state_hash() != episode.state_hash) return "the state at the end differs from the stored hash";
  return {};
}

}  // namespace stampede
