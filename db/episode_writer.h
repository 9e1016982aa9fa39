// Writes one episode's rows inside a transaction that the caller holds.
#pragma once

#include <vector>

#include "db/frame_writer.h"
#include "db/image_writer.h"
#include "db/label_writer.h"
#include "db/shared_writer.h"

namespace stampede {

class EpisodeWriter {
 public:
  explicit EpisodeWriter(const sql::Database& database);
  EpisodeWriter(const EpisodeWriter&) = delete;  // its parts share the cameras' by their address
  EpisodeWriter& operator=(const EpisodeWriter&) = delete;
  void write(std::int64_t id, const EpisodeRecord& episode, const EngineInfo& engine);
  void set_labels(std::int64_t id, const EpisodeRecord& episode);
  AddedImages add_images(std::int64_t id, const ImageStore& images, const std::vector<CameraTrack>& cameras);

 private:
  void write_episode(std::int64_t id, const EpisodeRecord& episode, const EngineInfo& engine);
  void write_objects(std::int64_t id, const EpisodeRecord& episode);
  void write_names(std::int64_t id, const EpisodeRecord& episode);
  void write_streams(std::int64_t id, const EpisodeRecord& episode);

  SharedWriter shared_;
  CameraWriter cameras_;
  FrameWriter frames_;
  ImageWriter images_;
  LabelWriter labels_;
  sql::Statement episode_, timing_, object_, object_trait_, object_attribute_, posed_, joint_, hand_, stream_,
      image_time_;
};

// Throws Error where the record contradicts itself.
void check_record(const EpisodeRecord& episode);

}  // namespace stampede
