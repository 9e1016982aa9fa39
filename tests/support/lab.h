// A recording made up for tests: a panda that swings its arm for two seconds, with nothing around it.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "db/recording/import_recording.h"

namespace stampede::test {

RecordingStager panda_stager();  // without Lua: tests/support/panda.h

class Lab {
 public:
  Lab();  // joints at 100 Hz, gripper at 50 Hz, cameras front (distorted, 160 x 120) and wrist; no pictures
  ~Lab();
  Lab(const Lab&) = delete;
  Lab& operator=(const Lab&) = delete;
  const std::filesystem::path& folder() const { return folder_; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  void change(const std::function<void(nlohmann::json&)>& edit) const;  // recording.json
  // Replaces the first of `from`, which must be there, in a file.
  void replace(const std::string& name, const std::string& from, const std::string& to) const;
  // A stream of colour pictures of the camera: `count` plain PNG files, from `first_s` on, `hz` a second.
  void add_pictures(const std::string& camera, int count, double first_s, double hz, int width = 160,
                    int height = 120) const;
  EpisodeRecord import(const ImportOptions& options = {}, const RecordingStager& stager = panda_stager()) const {
    return record_of(folder_, stager, options);
  }

 private:
  std::filesystem::path folder_;
};

double swing(double time, int joint);  // where joint 0 … 6 is

}  // namespace stampede::test
