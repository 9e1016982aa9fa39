#include "engine/base/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>
#include <ostream>
#include <system_error>

#include "engine/base/error.h"
#include "engine/base/stopping.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPiece = 1 << 20;
constexpr std::array kBeside = {"-wal", "-shm", "-journal"};  // what SQLite keeps of a file called so

fs::path really(const fs::path& path) {
  std::error_code ignored;
  fs::path found = fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  return found.has_filename() ? found : found.parent_path();
}

std::optional<struct stat> status_of(const fs::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? std::optional(status) : std::nullopt;
}

// N of /dev/fd/N and its other names.
std::optional<int> descriptor_of(const fs::path& path) {
  const std::string text = path.lexically_normal().string();
  if (text == "-" || text == "/dev/stdout") return STDOUT_FILENO;
  if (text == "/dev/stderr") return STDERR_FILENO;
  const std::string own = "/proc/" + std::to_string(::getpid()) + "/fd/";
  for (const std::string_view folder : {std::string_view("/dev/fd/"), std::string_view("/proc/self/fd/"),
                                        std::string_view("/proc/thread-self/fd/"), std::string_view(own)}) {
    if (!text.starts_with(folder)) continue;
    int number = -1;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + folder.size(), end, number);
    if (read.ec == std::errc() && read.ptr == end && number >= 0) return number;
  }
  return std::nullopt;
}

bool takes_streams(mode_t mode) { return S_ISFIFO(mode) || S_ISCHR(mode); }

std::string first_bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(512, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

[[noreturn]] void refuse(const fs::path& path, const std::string& what, const std::string& cure) {
  throw Error(path.string(), what, cure);
}

void refuse_link(const fs::path& folder) {
  std::error_code ignored;
  if (fs::is_symlink(folder, ignored))
    refuse(folder, "this is a link, and nothing is written through it", "remove it, or name a new folder");
}

void check_stream(const fs::path& path, const OutputKind& kind) {
  if (kind.seeks)
    refuse(path, kind.name + " is written back and forth, which a pipe or a device cannot take", "name a file");
}

// What is there already and is a plain file.
void check_present(const fs::path& path, const struct stat& status, const OutputKind& kind, const OutputRules& rules) {
  if (status.st_size == 0 || !kind.ours || kind.ours(path)) return;
  if (rules.lies_in_input(path))
    refuse(path, "this file lies in a folder that is read, and is not " + kind.name + " of stampede's",
           "name another file");
  if (!rules.force())
    refuse(path, "this file is there already, and is not " + kind.name + " of stampede's",
           "name another file; --force replaces it");
}

// The mode of new files, as the user wishes it.
constexpr mode_t kMode = 0666;

std::string new_name_beside(const fs::path& folder) {
  static std::atomic<unsigned> count = 0;
  return (folder / (".stampede-" + std::to_string(::getpid()) + "-" + std::to_string(++count))).string();
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

std::string by_descriptor(int file) { return "/proc/self/fd/" + std::to_string(file); }

}  // namespace

OutputRules::OutputRules(const std::vector<fs::path>& inputs, bool force, std::ostream* standard)
    : force_(force), standard_(standard) {
  for (const fs::path& input : inputs) {
    const auto status = status_of(input);
    if (!status) continue;
    const fs::path name = really(input);
    if (S_ISDIR(status->st_mode)) {
      folders_.push_back(name);
      std::error_code ignored;  // a hard link to a file of it lies elsewhere
      for (const auto& entry : fs::directory_iterator(name, ignored))
        if (const auto one = status_of(entry.path()); one && S_ISREG(one->st_mode))
          in_folders_.insert({one->st_dev, one->st_ino});
      continue;
    }
    if (takes_streams(status->st_mode)) continue;  // reading and writing a terminal is no harm
    files_.insert({status->st_dev, status->st_ino});
    names_.insert(name);
    for (const char* ending : kBeside)
      for (const std::string& stem : {name.string(), fs::absolute(input).lexically_normal().string()}) {
        names_.insert(really(stem + ending));
        if (const auto kept = status_of(stem + ending)) files_.insert({kept->st_dev, kept->st_ino});
      }
  }
}

bool OutputRules::reads(const fs::path& path) const {
  if (files_.empty()) return false;
  const auto status = status_of(path);
  return (status && files_.contains({status->st_dev, status->st_ino})) || names_.contains(really(path));
}

bool OutputRules::lies_in_input(const fs::path& path) const {
  if (folders_.empty()) return false;
  if (const auto status = status_of(path); status && in_folders_.contains({status->st_dev, status->st_ino}))
    return true;
  const fs::path found = really(path);
  return std::any_of(folders_.begin(), folders_.end(), [&](const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), found.begin(), found.end()).first == folder.end();
  });
}

OutputKind marked_kind(std::string name, std::string begins, std::string holds) {
  return {std::move(name), [begins = std::move(begins), holds = std::move(holds)](const fs::path& file) {
            const std::string text = first_bytes_of(file);
            return text.starts_with(begins) && text.find(holds) != std::string::npos;
          }};
}

bool is_standard_output(const fs::path& path) { return descriptor_of(path) == STDOUT_FILENO; }

void check_output(const fs::path& path, const OutputKind& kind, const OutputRules& rules) {
  if (is_standard_output(path)) {
    check_stream(path, kind);
    if (rules.standard() == nullptr) refuse(path, kind.name + " cannot go to standard output", "name a file");
    return;
  }
  if (rules.reads(path)) refuse(path, "this is what the command reads, and is not written over", "name another file");
  if (descriptor_of(path)) return check_stream(path, kind);
  struct stat own {};
  if (::lstat(path.c_str(), &own) != 0) {
    if (errno == ENOENT) return;
    refuse(path, std::string("it cannot be written: ") + std::strerror(errno), "name another file");
  }
  const auto status = status_of(path);
  if (status && takes_streams(status->st_mode)) return check_stream(path, kind);
  if (status && S_ISDIR(status->st_mode)) refuse(path, "this is a folder", "name a file in it");
  if (S_ISLNK(own.st_mode)) {
    std::error_code ignored;
    const std::string target = fs::read_symlink(path, ignored).string();
    if (!rules.force())
      refuse(path, "this is a link, to " + target, "name the file itself; --force puts a file in the link's place");
    return;
  }
  if (!status || !S_ISREG(status->st_mode))
    refuse(path, "this is a socket or a disk, and no file", "name a file, a pipe, or `-` for standard output");
  check_present(path, *status, kind, rules);
}

OutputFile::OutputFile(fs::path path, OutputKind kind, const OutputRules& rules)
    : path_(std::move(path)), kind_(std::move(kind)), rules_(rules) {
  check_output(path_, kind_, rules_);
  if (is_standard_output(path_)) {
    standard_ = rules_.standard();
    return;
  }
  const auto status = status_of(path_);
  if (const auto number = descriptor_of(path_)) {
    file_ = ::fcntl(*number, F_DUPFD_CLOEXEC, 3);
    is_stream_ = true;
  } else if (status && takes_streams(status->st_mode)) {
    do {
      heed_stop();
      file_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);  // a pipe without a reader waits for one
    } while (file_ < 0 && errno == EINTR);
    is_stream_ = true;
  } else {
    make();
    if (file_ >= 0 && status && S_ISREG(status->st_mode)) ::fchmod(file_, status->st_mode & 0777);
  }
  if (file_ < 0) fail(errno);
}

OutputFile::~OutputFile() {
  if (file_ >= 0) ::close(file_);
  if (!beside_.empty()) ::unlink(beside_.c_str());
}

// Without a name, where the disk can: of a program that is killed nothing is left.
void OutputFile::make() {
  const fs::path folder = folder_of(path_);
  file_ = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, kMode);
  if (file_ >= 0 && ::access(by_descriptor(file_).c_str(), W_OK) == 0) return;
  if (file_ >= 0) ::close(file_);
  do {
    beside_ = new_name_beside(folder);
    file_ = ::open(beside_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC | O_NOFOLLOW, kMode);
  } while (file_ < 0 && errno == EEXIST);
  if (file_ < 0) beside_.clear();
}

std::string OutputFile::unfinished() const { return beside_.empty() ? by_descriptor(file_) : beside_; }

void OutputFile::write(std::string_view bytes) {
  if (standard_ != nullptr) {
    standard_->write(bytes.data(), static_cast<std::streamsize>(bytes.size()));  // who owns it looks at its state
    return;
  }
  waiting_ += bytes;
  if (waiting_.size() >= kPiece || is_stream_) flush();
}

void OutputFile::flush() {
  std::string_view left = waiting_;
  while (!left.empty()) {
    const ssize_t count = ::write(file_, left.data(), left.size());
    if (count < 0 && errno == EINTR) {
      heed_stop();
      continue;
    }
    if (count < 0) fail(errno);
    left.remove_prefix(static_cast<std::size_t>(count));
  }
  waiting_.clear();
}

void OutputFile::finish() {
  if (standard_ != nullptr) return;
  flush();
  if (!is_stream_) give_name();
  if (::close(std::exchange(file_, -1)) != 0) fail(errno);
}

// Another process may have put something there meanwhile: looked at again, and a new name is never forced on it.
void OutputFile::give_name() {
  const std::string from = unfinished();
  if (::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, path_.c_str(), AT_SYMLINK_FOLLOW) == 0) return;
  if (errno != EEXIST && beside_.empty()) fail(errno);
  check_output(path_, kind_, rules_);
  if (beside_.empty()) {
    do {
      beside_ = new_name_beside(folder_of(path_));
    } while (::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, beside_.c_str(), AT_SYMLINK_FOLLOW) != 0 && errno == EEXIST);
  }
  if (::rename(beside_.c_str(), path_.c_str()) != 0) fail(errno);
  beside_.clear();
}

void OutputFile::fail(int number) const {
  const bool full = number == ENOSPC || number == EFBIG || number == EDQUOT;
  const bool gone = number == ENOENT || number == ENOTDIR;
  throw Error(path_.string(), std::string("it could not be written: ") + std::strerror(number),
              full   ? "free some space, or write to another disk"
              : gone ? "make its folder first"
                     : "name another file, or a folder that you may write in");
}

OutputFolder::OutputFolder(fs::path folder, const fs::path& marker, OutputKind kind, OutputRules rules, fs::path within)
    : folder_(std::move(folder)), within_(std::move(within)), rules_(std::move(rules)) {
  std::error_code ignored;
  if (is_standard_output(folder_)) refuse(folder_, "this is standard output, and a folder is needed", "name a folder");
  if (fs::exists(folder_, ignored) && !fs::is_directory(folder_, ignored))
    refuse(folder_, "this is a file, and a folder is needed", "name a new folder");
  const fs::path known = folder_ / within_ / marker;
  ours_ = rules_.force() || (fs::is_regular_file(fs::symlink_status(known, ignored)) && kind.ours && kind.ours(known));
  kind_ = {kind.name, {}, false};
}

// The folder itself may be a link: its owner named it.
void OutputFolder::check_links(const fs::path& inside) const {
  fs::path folder = folder_;
  for (const fs::path& part : (within_ / inside).parent_path()) {
    folder /= part;
    refuse_link(folder);
  }
}

void OutputFolder::make_folders(const fs::path& inside) const {
  std::error_code error;
  fs::create_directories(folder_, error);
  fs::path folder = folder_;
  for (const fs::path& part : (within_ / inside).parent_path()) {
    folder /= part;
    if (!error) fs::create_directory(folder, error);
    if (!error) refuse_link(folder);
    if (error && fs::is_directory(fs::symlink_status(folder))) error.clear();  // another thread has made it
  }
  if (error) refuse(folder, "the folder cannot be made: " + error.message(), "name another one");
}

void OutputFolder::check_place(const fs::path& path) const {
  struct stat status {};
  if (!ours_ && ::lstat(path.c_str(), &status) == 0)
    refuse(path, "this file is there already, and the folder is not one of " + kind_.name + " of stampede's",
           "name a new folder; --force replaces the file");
}

void OutputFolder::check(const std::vector<fs::path>& inside) const {
  for (const fs::path& one : inside) {
    const fs::path path = folder_ / within_ / one;
    check_links(one);
    check_place(path);
    check_output(path, kind_, rules_);
  }
}

void OutputFolder::write(const fs::path& inside, std::string_view bytes) const {
  make_folders(inside);
  const fs::path path = folder_ / within_ / inside;
  {
    const std::lock_guard lock(made_->mutex);
    if (made_->files.insert(path).second) check_place(path);
  }
  OutputFile file(path, kind_, rules_);
  file.write(bytes);
  file.finish();
}

}  // namespace stampede
