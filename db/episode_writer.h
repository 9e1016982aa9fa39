// Writes one episode's rows inside a transaction that the caller holds.
#pragma once

#include <set>
#include <string>

#include "db/catalogue.h"
#include "db/sqlite.h"

namespace stampede {

// All statements are prepared once and kept: an episode has thousands of rows.
class EpisodeWriter {
 public:
  explicit EpisodeWriter(const sql::Database& database);
  void write(std::int64_t id, const EpisodeRecord& episode, const EngineInfo& engine);

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

  // write_frames.cpp: what was observed and commanded
  void write_frames(const EpisodeRecord& episode);
  void write_poses(const EpisodeRecord& episode);
  void write_actions(const EpisodeRecord& episode);
  void write_commands(const EpisodeRecord& episode);
  void write_channels(const EpisodeRecord& episode);

  // write_labels.cpp: what happened, in words
  void write_labels(const EpisodeRecord& episode);
  void write_segments(const EpisodeRecord& episode);
  void write_parameters(const SegmentRecord& segment, bool undone, std::int64_t ordinal);
  void write_effects(const SegmentRecord& segment, bool undone, std::int64_t ordinal);
  void write_facts(const EpisodeRecord& episode);
  void write_passages(const EpisodeRecord& episode);  // vias, grasps, contacts
  void write_language(const EpisodeRecord& episode);

  sql::Statement insert(const std::string& table, const std::string& ending = "") const;

  const sql::Database& database_;
  std::int64_t id_ = 0;  // of the episode being written
  sql::Statement definition_, engine_run_, engine_run_definition_, predicate_, variation_, variation_axis_, scene_,
      asset_, text_store_;
  sql::Statement episode_, timing_, object_, object_trait_, object_attribute_, posed_, joint_, hand_, camera_;
  sql::Statement frame_, joint_state_, hand_state_, object_state_, camera_pose_, action_channel_, action_, command_,
      channel_, sample_;
  sql::Statement segment_, attempt_, parameter_, effect_, via_, fact_, contact_, grasp_, language_, document_,
      keyframe_;
};

// Throws Error where the record contradicts itself.
void check_record(const EpisodeRecord& episode);

}  // namespace stampede
