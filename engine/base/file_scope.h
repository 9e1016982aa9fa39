// Which files a file may name: a mesh its pictures, a URDF its meshes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stampede {

// Folders, links followed. A file lies inside when it really lies below one of them.
class FileScope {
 public:
  explicit FileScope(const std::vector<std::filesystem::path>& roots);

  bool contains(const std::filesystem::path& file) const;
  // Throws Error, with the roots and the cure, for a file that does not lie inside. A file that is not there passes
  // where its folder lies inside: who reads it says that it is missing.
  void check(const std::filesystem::path& file) const;
  const std::vector<std::filesystem::path>& roots() const { return roots_; }

 private:
  std::vector<std::filesystem::path> roots_;  // canonical
};

// The folder of a file: what it may name where nobody says more.
FileScope beside(const std::filesystem::path& file);

}  // namespace stampede
