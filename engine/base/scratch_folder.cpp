#include "engine/base/scratch_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <vector>

#include "engine/base/error.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

constexpr const char *kMark = "made-by-stampede", *kFile = "unfinished";
constexpr std::string_view kWords = "what stampede has not finished; it goes when the output is written again\n";
constexpr std::array kEndings{"", "-wal", "-shm", "-journal"};
constexpr std::size_t kRandom = 6;  // letters

std::string beginning_of(const fs::path& output) { return output.filename().string() + ".stampede-"; }

bool has_name_of_one(const fs::path& path, const fs::path& output) {
  const std::string name = path.filename().string(), begin = beginning_of(output);
  return name.size() == begin.size() + kRandom && name.starts_with(begin);
}

// The mark, opened, if it says what ours says; else -1.
int open_mark(const fs::path& folder) {
  const int file = ::open((folder / kMark).c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  std::string said(kWords.size() + 1, '\0');
  if (file >= 0 && ::read(file, said.data(), said.size()) == static_cast<ssize_t>(kWords.size()) &&
      said.substr(0, kWords.size()) == kWords)
    return file;
  if (file >= 0) ::close(file);
  return -1;
}

// What we put into it, and the folder itself unless something else is there too.
void remove_ours(const fs::path& folder) {
  std::error_code ignored;
  for (const char* ending : kEndings) fs::remove(folder / (std::string(kFile) + ending), ignored);
  std::size_t left = 0;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) left += entry.path().filename() != kMark;
  if (left > 0) return;
  fs::remove(folder / kMark, ignored);
  ::rmdir(folder.c_str());
}

void sweep(const fs::path& output) {
  std::error_code ignored;
  std::vector<fs::path> found;
  const fs::path parent = output.has_parent_path() ? output.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(parent, ignored))
    if (ScratchFolder::is_one(entry.path(), output)) found.push_back(entry.path());
  for (const fs::path& folder : found) {
    const int mark = open_mark(folder);
    if (mark < 0) continue;
    if (::flock(mark, LOCK_EX | LOCK_NB) == 0) remove_ours(folder);  // else its owner lives
    ::close(mark);
  }
}

}  // namespace

ScratchFolder::ScratchFolder(const fs::path& output) {
  sweep(output);
  std::string name = output.string() + ".stampede-" + std::string(kRandom, 'X');
  const auto refuse = [&] {
    const std::string why = std::strerror(errno);
    throw Error(name, "a folder for what is not finished cannot be made: " + why,
                "write where there is room, and where you may write");
  };
  if (::mkdtemp(name.data()) == nullptr) refuse();
  path_ = name;
  const int file = ::open((path_ / kMark).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  lock_ = file;
  if (file < 0 || ::flock(file, LOCK_EX) != 0 ||
      ::write(file, kWords.data(), kWords.size()) != static_cast<ssize_t>(kWords.size())) {
    const int error = errno;
    remove_ours(path_);
    if (file >= 0) ::close(file);
    errno = error;
    refuse();
  }
}

ScratchFolder::~ScratchFolder() {
  remove_ours(path_);
  ::close(lock_);
}

fs::path ScratchFolder::file() const { return path_ / kFile; }

bool ScratchFolder::is_one(const fs::path& path, const fs::path& output) {
  std::error_code ignored;
  if (!has_name_of_one(path, output) || fs::symlink_status(path, ignored).type() != fs::file_type::directory)
    return false;
  const int mark = open_mark(path);
  if (mark >= 0) ::close(mark);
  return mark >= 0;
}

}  // namespace stampede
