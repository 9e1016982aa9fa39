// Writes what was observed and commanded, frame by frame.
#pragma once

#include "db/camera_writer.h"
#include "db/catalogue.h"

namespace stampede {

class FrameWriter {
 public:
  FrameWriter(const sql::Database& database, CameraWriter& cameras);
  void write(std::int64_t id, const EpisodeRecord& episode);
  void set_running(std::int64_t id, const EpisodeRecord& episode);  // which segments run at stored frames

 private:
  void write_poses(std::int64_t id, const EpisodeRecord& episode);
  void write_actions(std::int64_t id, const EpisodeRecord& episode);
  void write_agent_actions(std::int64_t id, const EpisodeRecord& episode);
  void write_commands(std::int64_t id, const EpisodeRecord& episode);
  void write_channels(std::int64_t id, const EpisodeRecord& episode);

  const sql::Database& database_;
  CameraWriter& cameras_;
  sql::Statement frame_, joint_state_, hand_state_, object_state_, action_channel_, action_, agent_action_, command_,
      channel_, component_, sample_;
};

}  // namespace stampede
