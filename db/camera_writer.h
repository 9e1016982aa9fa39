// Writes the cameras of an episode and where they were.
#pragma once

#include <functional>
#include <string>

#include "db/sqlite.h"
#include "engine/model/scene.h"

namespace stampede {

class CameraWriter {
 public:
  explicit CameraWriter(const sql::Database& database);
  void write(std::int64_t episode, int ordinal, const Camera& camera);  // after the objects and masks: its mount's name
  // Null: it is not known at that frame. Rows are written where it changes.
  void write_poses(std::int64_t episode, int camera, std::size_t frames,
                   const std::function<const Pose*(std::size_t)>& pose_at);

 private:
  std::string mount_link(std::int64_t episode, const Camera& camera);

  sql::Statement camera_, camera_pose_, mount_link_;
};

}  // namespace stampede
