// What a Session does, behind the public header: the two spell the same enumerations and never meet in one file.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "db/query.h"
#include "scripting/program/studio.h"
#include "stampede/episode.h"

namespace stampede {

class SessionCore {
 public:
  SessionCore(const std::filesystem::path& root, const std::vector<std::filesystem::path>& paths,
              std::filesystem::path catalogue);
  std::vector<std::string> tasks() const;
  std::vector<std::string> variations(const std::string& task) const;
  Episode run(const std::string& task, const EpisodeRequest& request) const;
  QueryResult query(std::string_view question) const;
  CameraPicture picture(std::int64_t episode, std::int64_t frame, const PictureRequest& request);
  CameraPoints points(std::int64_t episode, std::int64_t frame, const PictureRequest& request);

 private:
  std::optional<Episode> stored(const std::string& key) const;
  const std::filesystem::path& catalogue() const;  // throws Error when there is none
  std::shared_ptr<const class Library> library_;
  std::filesystem::path catalogue_;
  std::optional<Studio> studio_;  // from the first picture on
};

}  // namespace stampede
