// What a Session does, behind the public header: the two spell the same enumerations and never meet in one file.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "db/query.h"
#include "engine/episode/record.h"
#include "scripting/session/studio.h"
#include "stampede/episode.h"
#include "stampede/task_plan.h"
#include "stampede/world_state.h"

namespace stampede {

class SessionCore {
 public:
  SessionCore(const std::filesystem::path& root, const std::vector<std::filesystem::path>& paths,
              std::filesystem::path catalogue);
  std::vector<std::string> tasks() const;
  std::vector<std::string> variations(const std::string& task) const;
  Episode run(const std::string& task, const EpisodeRequest& request) const;
  TaskPlan plan(const std::string& task, const EpisodeRequest& request) const;
  QueryResult query(std::string_view question) const;
  CameraPicture picture(std::int64_t episode, std::int64_t frame, const PictureRequest& request);
  CameraPoints points(std::int64_t episode, std::int64_t frame, const PictureRequest& request);
  WorldState state(std::int64_t episode, std::int64_t frame);

 private:
  class PreparedEpisode prepare(const std::string& task, const EpisodeRequest& request) const;
  std::optional<Episode> stored(const std::string& key) const;
  const std::filesystem::path& catalogue() const;  // throws Error when there is none
  std::shared_ptr<const class Library> library_;
  std::filesystem::path catalogue_;
  std::optional<Studio> studio_;  // from the first picture on
  // Of the last state asked for: the next one is mostly of the same episode.
  std::int64_t record_id_ = 0;
  EpisodeRecord record_;
};

TaskPlan plan_of_texts(const std::string& domain, const std::string& problem);

}  // namespace stampede
