// What a Session does, behind the public header.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "db/catalogue.h"
#include "engine/start/perturbation.h"
#include "scripting/session/studio.h"
#include "stampede/arrays.h"
#include "stampede/environment.h"
#include "stampede/episode.h"
#include "stampede/evaluation.h"
#include "stampede/session.h"
#include "stampede/world_state.h"

namespace stampede {

// Environments of a session may act in threads of their own: what they ask of it is done one at a time.
class SessionCore : public std::enable_shared_from_this<SessionCore> {
 public:
  SessionCore(const std::filesystem::path& root, const std::vector<std::filesystem::path>& paths,
              std::filesystem::path catalogue);
  std::vector<std::string> tasks() const;
  std::vector<std::string> variations(const std::string& task) const;
  Episode run(const std::string& task, const EpisodeRequest& request);
  RunTally run_all(const RunRequest& request);
  void add_policy(const std::string& name, PolicyEntry entry);
  Evaluation evaluate(const std::vector<std::string>& tasks, const EvaluationRequest& request);
  void add_sensor(const std::string& name, SensorEntry entry);
  Environment environment(const std::string& task, const EnvironmentSettings& settings);
  TaskPlan plan(const std::string& task, const EpisodeRequest& request) const;
  Rows query(std::string_view question, const std::vector<SqlValue>& parameters = {});
  CameraPicture picture(const Episode& episode, std::int64_t frame, const PictureRequest& request);
  CameraPoints points(const Episode& episode, std::int64_t frame, const PictureRequest& request);
  WorldState state(const Episode& episode, std::int64_t frame);
  EpisodeArrays arrays(const Episode& episode, const ArrayRequest& request);

 private:
  struct RunOptions options_for(const EpisodeRequest& request) const;
  class PreparedEpisode prepare(const std::string& task, const EpisodeRequest& request,
                                const Perturbation& perturb = {}, std::shared_ptr<class Assets> assets = nullptr) const;
  std::optional<Episode> stored(const std::string& key);
  friend class TaskSource;
  Episode keep(EpisodeRecord record);  // in the catalogue, or in the episode
  Episode keep_for(const RunRequest& request, EpisodeRecord record);
  std::shared_ptr<const EpisodeRecord> record_of(const Episode& episode);
  Catalogue& catalogue();  // opened to be read; throws Error when there is none
  Catalogue& catalogue_to_write();
  std::shared_ptr<const class Library> library_;
  std::mutex mutex_;                                                    // held while an environment asks
  std::shared_ptr<const std::map<std::string, PolicyEntry>> policies_;  // null: none
  std::shared_ptr<const std::map<std::string, SensorEntry>> sensors_;   // likewise
  std::filesystem::path path_;                                          // of the catalogue; empty: none
  std::optional<Catalogue> catalogue_;
  bool writable_ = false;
  std::optional<Studio> studio_;  // from the first picture on
  // Of the last state asked for: the next one is mostly of the same episode.
  std::int64_t record_id_ = -1;
  std::shared_ptr<const EpisodeRecord> record_;
};

TaskPlan plan_of_texts(const std::string& domain, const std::string& problem);

}  // namespace stampede
