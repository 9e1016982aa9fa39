// Files that a command writes: whole or not at all, and never in the place of what was not its own.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stampede {

// What a command reads, which it never writes over, and whether it may replace what stampede did not make.
class OutputRules {
 public:
  OutputRules() = default;
  // Inputs that are not there are none. A folder stands for what lies in it. `standard`: what `-` and /dev/stdout are.
  OutputRules(const std::vector<std::filesystem::path>& inputs, bool force, std::ostream* standard = nullptr);

  // By another name, through links, or what SQLite keeps beside it (-wal, -shm, -journal).
  bool reads(const std::filesystem::path& path) const;
  bool lies_in_input(const std::filesystem::path& path) const;
  bool force() const { return force_; }
  std::ostream* standard() const { return standard_; }

 private:
  std::set<std::pair<dev_t, ino_t>> files_, in_folders_;
  std::set<std::filesystem::path> names_;       // canonical
  std::vector<std::filesystem::path> folders_;  // canonical
  bool force_ = false;
  std::ostream* standard_ = nullptr;
};

// How files of a kind are told from those of others.
struct OutputKind {
  std::string name;                                                  // as a complaint says it: `a contact sheet`
  std::function<bool(const std::filesystem::path& file)> ours = {};  // none: whatever has the name may be replaced
  bool seeks = false;  // it is not written from its beginning to its end: no pipe can take it
};
// Whose files begin with one text and hold another in their first 512 bytes.
OutputKind marked_kind(std::string name, std::string begins, std::string holds);

// `-`, /dev/stdout and its other names.
bool is_standard_output(const std::filesystem::path& path);

// Throws Error, with the cure, where a file of that name would not be written: an input; what stampede did not make,
// without force; a link, without force; a folder, a socket, a disk; a pipe or device, where the kind cannot be a
// stream. Call it ahead of long work.
void check_output(const std::filesystem::path& path, const OutputKind& kind, const OutputRules& rules);

// A file under its name once finish() has returned; until then it has none, and what was there before is untouched.
// Pipes, devices and standard output are written to as they are. Throws Error where that fails, and as check_output.
class OutputFile {
 public:
  OutputFile(std::filesystem::path path, OutputKind kind, const OutputRules& rules);
  ~OutputFile();  // without finish(): nothing is left of it
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  void finish();
  // For libraries that open a file by its name, of kinds that seek: what is written there gets the name.
  std::string unfinished() const;

 private:
  void make();
  void give_name();
  void flush();
  [[noreturn]] void fail(int number) const;

  std::filesystem::path path_;
  OutputKind kind_;
  const OutputRules rules_;
  std::ostream* standard_ = nullptr;
  int file_ = -1;
  std::string beside_;  // the name until then, where the disk has no files without
  bool is_stream_ = false;
  std::string waiting_;
};

// A folder that is filled, `within` one that somebody named. Its files may be replaced where it is ours: where `marker`
// is a file in it that `kind` knows. Elsewhere only what is not there yet is written. Below the one that was named no
// link is followed.
class OutputFolder {
 public:
  OutputFolder(std::filesystem::path folder, const std::filesystem::path& marker, OutputKind kind, OutputRules rules,
               std::filesystem::path within = {});

  // Throws where one of these files would not be written: ahead of the first, so that it is all or nothing.
  void check(const std::vector<std::filesystem::path>& inside) const;
  void write(const std::filesystem::path& inside, std::string_view bytes) const;  // from any thread

 private:
  void make_folders(const std::filesystem::path& inside) const;
  void check_links(const std::filesystem::path& inside) const;
  void check_place(const std::filesystem::path& path) const;

  std::filesystem::path folder_, within_;
  OutputKind kind_;
  OutputRules rules_;
  bool ours_ = false;
  struct Made {
    std::mutex mutex;
    std::set<std::filesystem::path> files;
  };
  std::unique_ptr<Made> made_ = std::make_unique<Made>();
};

}  // namespace stampede
