// Writes one episode's rows inside a transaction that the caller holds.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "db/catalogue.h"
#include "db/sqlite.h"

namespace stampede {

struct ImageRecord;  // engine/record/observation.h

// All statements are prepared once and kept: an episode has thousands of rows.
class EpisodeWriter {
 public:
  explicit EpisodeWriter(const sql::Database& database);
  void write(std::int64_t id, const EpisodeRecord& episode, const EngineInfo& engine);
  void set_labels(std::int64_t id, const EpisodeRecord& episode);
  AddedImages add_images(std::int64_t id, const ImageStore& images, const std::vector<CameraTrack>& cameras);

 private:
  // episode_writer.cpp: what took part, and what is in the scene
  std::string write_engine_run(const EpisodeRecord& episode, const EngineInfo& engine);
  std::string write_scene(const std::string& document);
  std::string write_text(const std::string& text);
  void write_variation(const EpisodeRecord& episode);
  void write_episode(const EpisodeRecord& episode, const EngineInfo& engine);
  void write_objects(const EpisodeRecord& episode);
  void write_names(const EpisodeRecord& episode);
  void write_cameras(const EpisodeRecord& episode);
  void write_camera(int ordinal, const Camera& camera);
  void write_streams(const EpisodeRecord& episode);

  // write_frames.cpp: what was observed and commanded
  void write_frames(const EpisodeRecord& episode);
  void set_running(const EpisodeRecord& episode);  // which segments run at stored frames
  void write_poses(const EpisodeRecord& episode);
  void write_camera_poses(int camera, std::size_t frames, const std::function<const Pose*(std::size_t)>& pose_at);
  void write_actions(const EpisodeRecord& episode);
  void write_agent_actions(const EpisodeRecord& episode);
  void write_commands(const EpisodeRecord& episode);
  void write_channels(const EpisodeRecord& episode);

  // write_images.cpp: what cameras saw
  void write_masks(const EpisodeRecord& episode);
  void write_images(const EpisodeRecord& episode);
  std::string mount_link(const Camera& camera);
  int place_camera(const CameraTrack& track, std::int64_t frames);
  void write_image(const ImageRecord& image, int camera, const std::vector<std::uint8_t>& bytes);
  bool is_stored(const ImageRecord& image, int camera, const std::string& name, std::string_view bytes);

  // write_labels.cpp: what happened, in words
  void write_labels(const EpisodeRecord& episode);
  void write_segments(const EpisodeRecord& episode);
  void write_parameters(const SegmentRecord& segment, bool undone, std::int64_t ordinal);
  void write_preconditions(const SegmentRecord& segment, bool undone, std::int64_t ordinal);
  void write_effects(const SegmentRecord& segment, bool undone, std::int64_t ordinal);
  void write_facts(const EpisodeRecord& episode);
  void write_passages(const EpisodeRecord& episode);  // vias, grasps, contacts
  void write_language(const EpisodeRecord& episode);
  void write_sentences(const EpisodeRecord& episode);

  // episode_statements.cpp
  sql::Statement insert(const std::string& table, const std::string& columns, const std::string& ending = "") const;
  void prepare_shared();
  void prepare_scene();
  void prepare_frames();
  void prepare_labels();

  const sql::Database& database_;
  std::int64_t id_ = 0;  // of the episode being written
  sql::Statement definition_, engine_run_, engine_run_definition_, predicate_, variation_, variation_axis_, scene_,
      asset_, text_store_;
  sql::Statement episode_, timing_, object_, object_trait_, object_attribute_, posed_, joint_, hand_, camera_;
  sql::Statement frame_, joint_state_, hand_state_, object_state_, camera_pose_, action_channel_, action_,
      agent_action_, command_, channel_, component_, sample_;
  sql::Statement mask_, image_, visible_, stream_, image_time_, stored_image_, mount_link_;
  sql::Statement segment_, parameter_, precondition_, effect_, effects_held_, undeclared_, via_, fact_, observed_fact_,
      contact_, grasp_, language_, document_, verdict_, keyframe_;
};

// Throws Error for pictures of frames and cameras that are not there, of unknown kinds, or without size.
void check_images(const ImageStore& images, std::int64_t frames, std::size_t cameras, const std::string& where);

// Throws Error where the record contradicts itself.
void check_record(const EpisodeRecord& episode);

}  // namespace stampede
