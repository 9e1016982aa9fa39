#include "engine/base/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "engine/base/error.h"

namespace stampede {
namespace {

struct OpenFile {
  explicit OpenFile(const std::filesystem::path& path)
      : handle(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {}
  ~OpenFile() {
    if (handle >= 0) close(handle);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int handle;
};

std::string size_text(std::uintmax_t bytes) {
  constexpr std::uintmax_t kMega = std::uintmax_t{1} << 20;
  return bytes % kMega == 0 ? std::to_string(bytes / kMega) + " MB" : std::to_string(bytes) + " bytes";
}

}  // namespace

std::string read_file(const std::filesystem::path& path, std::uintmax_t most_bytes) {
  const std::string where = path.string();
  const auto unreadable = [&] { return Error(where, "it cannot be read", "check its permissions"); };
  const auto no_file = [&] { return Error(where, "it is no file", "name a plain file"); };
  struct stat about {};  // asked before it is opened: opening a device may do something
  if (stat(path.c_str(), &about) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) throw Error(where, "there is no such file", "check its name");
    throw unreadable();
  }
  if (!S_ISREG(about.st_mode)) throw no_file();
  const OpenFile file(path);
  if (file.handle < 0 || fstat(file.handle, &about) != 0) throw unreadable();
  if (!S_ISREG(about.st_mode)) throw no_file();
  const auto too_large = [&] {
    return Error(where, "it is larger than " + size_text(most_bytes) + ", the most that is read of such a file",
                 "make it smaller, or split it");
  };
  if (static_cast<std::uintmax_t>(about.st_size) > most_bytes) throw too_large();
  std::string text(static_cast<std::size_t>(about.st_size) + 1, '\0');  // one more, to see its end
  std::size_t size = 0;
  for (;;) {
    const ssize_t count = read(file.handle, text.data() + size, text.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw unreadable();
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
    if (size > most_bytes) throw too_large();
    if (size == text.size()) text.resize(2 * size);
  }
  text.resize(size);
  return text;
}

}  // namespace stampede
