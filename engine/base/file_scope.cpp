#include "engine/base/file_scope.h"

#include <algorithm>

#include "engine/base/error.h"

namespace stampede {
namespace fs = std::filesystem;
namespace {

fs::path real(const fs::path& path) {
  std::error_code code;
  fs::path found = fs::weakly_canonical(fs::absolute(path, code), code);
  if (code) return {};
  if (found.filename().empty()) found = found.parent_path();  // `a/` is `a`
  return found;
}

}  // namespace

FileScope::FileScope(const std::vector<fs::path>& roots) {
  for (const fs::path& root : roots)
    if (fs::path folder = real(root); !folder.empty()) roots_.push_back(std::move(folder));
}

bool FileScope::contains(const fs::path& file) const {
  const fs::path found = real(file);
  return !found.empty() && std::any_of(roots_.begin(), roots_.end(), [&found](const fs::path& root) {
    return std::mismatch(root.begin(), root.end(), found.begin(), found.end()).first == root.end();
  });
}

void FileScope::check(const fs::path& file) const {
  if (contains(file)) return;
  std::string folders;
  for (const fs::path& root : roots_) folders += (folders.empty() ? "" : ", ") + root.string();
  throw Error(file.string(), "the file lies outside the roots (" + folders + ")",
              "copy it beside the file that names it, or make its folder a root: --path FOLDER");
}

FileScope beside(const fs::path& file) {
  return FileScope({file.has_parent_path() ? file.parent_path() : fs::path(".")});
}

}  // namespace stampede
