// Re-simulates a stored episode from its scene and its commands: no script, no planner.
#include <algorithm>

#include "engine/episode/runner.h"
#include "engine/record/arrays.h"
#include "engine/rollout/recorder.h"
#include "engine/rollout/sensors.h"
#include "engine/sim/world.h"

namespace stampede {
namespace {

// What scripts say of a simulation, and what follows from the number of a frame.
constexpr const char* kNotSimulated[] = {"time",  "reward", "done",    "progress", "facts",
                                         "known", "skill",  "subgoal", "motion"};

// The arrays of what was simulated again, compared with those of the episode.
std::string difference(const EpisodeRecord& episode, std::vector<FrameRecord> frames,
                       const std::vector<ChannelRecord>& channels) {
  EpisodeRecord again;
  again.physics_hz = episode.physics_hz;
  again.frame_hz = episode.frame_hz;
  again.scene.joints = episode.scene.joints;
  again.scene.posed = episode.scene.posed;
  again.scene.hands = episode.scene.hands;
  again.scene.cameras = episode.scene.cameras;  // the scene's come first, then those of pictures that were made later
  again.scene.cameras.resize(frames.empty() ? 0 : frames.front().camera_pose.size());
  again.channels = channels;
  again.frames = std::move(frames);
  EpisodeArrays now = episode_arrays(again);
  std::erase_if(now.columns, [](const ArrayColumn& column) {
    return std::find(std::begin(kNotSimulated), std::end(kNotSimulated), column.name) != std::end(kNotSimulated);
  });
  return first_difference(episode_arrays(episode), now);
}

}  // namespace

std::string replay_episode(const EpisodeRecord& episode) {
  if (episode.frames.empty()) return {};
  World world(std::make_shared<const Scene>(scene_from_document(episode.scene.document)));
  WorldView view(world);
  const FrameReader reader(view, episode.scene.joints);  // an older catalogue may lack some
  SensorReader sensors = sensors_of(world.scene(), episode, nullptr);
  const std::int64_t per_frame = episode.physics_hz / episode.frame_hz;
  std::vector<FrameRecord> frames;
  std::size_t next = 0;
  for (std::int64_t index = 0; index < static_cast<std::int64_t>(episode.frames.size()); ++index) {
    while (index > 0 && world.step_count() < index * per_frame) {
      while (next < episode.commands.size() && episode.commands[next].step == world.step_count())
        world.apply(episode.commands[next++].operation);
      world.step();
      sensors.step(view);
    }
    if (index > 0) {
      world.close_window();
      frames.back().action = reader.action(world);
    }
    frames.push_back(reader.read(view));
  }
  if (std::string found = difference(episode, std::move(frames), sensors.channels()); !found.empty()) return found;
  if (world.state_hash() != episode.state_hash) return "the state at the end differs from the stored hash";
  return {};
}

std::vector<std::string> not_replayed(const EpisodeRecord& episode) {
  std::vector<std::string> names;
  for (const ChannelRecord& channel : episode.channels)
    if (channel.name == kMargins || episode.made.options.contains("sensor_" + channel.name))
      names.push_back(channel.name);
  return names;
}

}  // namespace stampede
