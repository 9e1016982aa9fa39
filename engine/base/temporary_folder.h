// A folder for the files of a moment.
#pragma once

#include <filesystem>

namespace stampede {

// An empty folder that goes with its owner. It lies where the system keeps such, or where TMPDIR says.
class TemporaryFolder {
 public:
  TemporaryFolder();                                             // throws Error
  explicit TemporaryFolder(const std::filesystem::path& where);  // in that folder; throws Error
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace stampede
