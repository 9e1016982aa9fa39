#include "scripting/library/roots.h"

#include <dlfcn.h>

#include <system_error>

namespace stampede {
namespace fs = std::filesystem;

fs::path default_root() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&default_root), &info) != 0 && info.dli_fname != nullptr) {
    std::error_code error;
    fs::path file = fs::canonical(info.dli_fname, error);
    if (error) file = fs::canonical("/proc/self/exe", error);  // a program found by PATH has a bare name here
    for (fs::path folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
      if (fs::is_directory(folder / "share/stampede/tasks", error)) return folder / "share/stampede";
    }
  }
  return STAMPEDE_SOURCE_ROOT;
}

Roots make_roots(const fs::path& root, const std::vector<fs::path>& paths) {
  Roots roots;
  roots.folders.push_back(root.empty() ? default_root() : root);
  roots.folders.insert(roots.folders.end(), paths.begin(), paths.end());
  for (std::size_t i = 0; i < roots.folders.size(); ++i) {
    std::error_code error;
    if (fs::is_directory(roots.folders[i], error)) continue;
    throw Error(i == 0 ? "--root" : "--path", "'" + roots.folders[i].string() + "' is not a folder",
                "make it, or name another");
  }
  return roots;
}

}  // namespace stampede
