#include "engine/base/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <mutex>
#include <set>
#include <string>
#include <system_error>

#include "engine/base/error.h"
#include "engine/base/leftovers.h"

namespace stampede {

namespace {

std::string usual_place() {
  const char* asked = std::getenv("TMPDIR");
  return asked == nullptr || *asked == '\0' ? "/tmp" : asked;
}

// Those that are there. Never destroyed: who ends the program may ask while it ends.
struct Register {
  std::timed_mutex mutex;
  std::set<std::filesystem::path> folders;
};
Register& all_folders() {
  static Register& all = *new Register;
  return all;
}

}  // namespace

TemporaryFolder::TemporaryFolder() : TemporaryFolder(usual_place()) {}

TemporaryFolder::TemporaryFolder(const std::filesystem::path& where) {
  std::string name = where.string() + "/stampede_XXXXXX";
  if (::mkdtemp(name.data()) == nullptr)
    throw Error(name, std::string("a temporary folder cannot be made: ") + std::strerror(errno),
                "set TMPDIR to a folder that can be written");
  path_ = name;
  const std::lock_guard lock(all_folders().mutex);
  all_folders().folders.insert(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  const std::lock_guard lock(all_folders().mutex);
  all_folders().folders.erase(path_);
}

void remove_leftovers() {
  const std::unique_lock lock(all_folders().mutex, std::chrono::milliseconds(10));  // or somebody is stuck with it
  if (!lock) return;
  std::error_code ignored;
  for (const std::filesystem::path& folder : all_folders().folders) std::filesystem::remove_all(folder, ignored);
}

}  // namespace stampede
