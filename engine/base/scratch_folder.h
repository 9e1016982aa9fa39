// A folder of ours beside an output, for what is not finished.
#pragma once

#include <filesystem>
#include <string>

namespace stampede {

// OUTPUT.stampede-XXXXXX, which goes with its owner. One whose owner was killed goes when the next is made for the same
// output: it is known by what lies in it and by its lock, so nothing that somebody else made is ever removed.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::filesystem::path& output);  // throws Error
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  // For the one file in it; what SQLite puts beside that is removed too.
  std::filesystem::path file() const;

  static bool is_one(const std::filesystem::path& path, const std::filesystem::path& output);  // living or not

 private:
  std::filesystem::path path_;
  int lock_ = -1;  // on the mark
};

}  // namespace stampede
