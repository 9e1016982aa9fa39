// Runs the program inside the test and keeps what it said.
#pragma once

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "scripting/commands/commands.h"
#include "scripting/program/command_line.h"

namespace stampede::program {

inline constexpr const char* kRoot = STAMPEDE_SOURCE_DIR;

struct Said {
  ExitCode code = kBug;
  std::string out, err;
};

inline Said say(std::vector<std::string> words) {
  std::ostringstream out, err;
  Console console{out, err, false, false, 100, nullptr};
  Said said;
  said.code = run_program(all_commands(), words, console);
  said.out = out.str();
  said.err = err.str();
  return said;
}

inline bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// A folder of its own that goes when the test ends.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("stampede_" + std::to_string(std::random_device()()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string text() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

inline void put(const Folder& folder, const std::string& name, const std::string& text) {
  std::filesystem::create_directories(std::filesystem::path(folder / name).parent_path());
  std::ofstream(folder / name, std::ios::binary) << text;
}

// What `check` says of these files, or of all, where this folder is added to those that ship.
inline Said checked(const Folder& mine, const std::vector<std::string>& names = {}) {
  std::vector<std::string> words = {"check", "--root", kRoot, "--path", mine.text()};
  words.insert(words.end(), names.begin(), names.end());
  return say(words);
}

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace stampede::program
