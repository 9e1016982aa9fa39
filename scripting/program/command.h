// A command of the program as a row of a table: parsing, help, completion and the reference all come from it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "scripting/program/console.h"
#include "scripting/program/exit_code.h"

namespace stampede::program {

// The command line asks for something that makes no sense (exit code 2).
class UsageError : public Error {
 public:
  explicit UsageError(std::string message, std::string hint = {}) : Error({}, std::move(message), std::move(hint)) {}
};

enum class Takes { flag, text, integer, path, output };  // a path that is read or added to; one that is written anew

struct OptionRow {
  std::string name;   // `--episodes`
  std::string value;  // `N`; empty for a flag
  std::string help;   // a line, without a full stop
  Takes takes = Takes::flag;
  std::string initial;  // value when not given, shown in the help
  std::vector<std::string> choices;
  bool repeats = false;
};

struct PositionalRow {
  std::string name;  // `TASK`
  std::string help;
  bool required = true;
  bool repeats = false;
};

// What was on the command line, checked against the row. Names as in the row.
class Arguments {
 public:
  bool has(std::string_view name) const;  // given on the command line
  bool flag(std::string_view name) const { return has(name); }
  std::string text(std::string_view name) const;  // given, initial, or empty
  const std::vector<std::string>& list(std::string_view name) const;
  std::optional<std::int64_t> integer(std::string_view name) const;  // given or initial
  // Every argument and path that the command may read: all but outputs.
  const std::vector<std::filesystem::path>& inputs() const { return inputs_; }
  void set(std::string name, std::vector<std::string> values, bool given);
  void add_input(std::filesystem::path path) { inputs_.push_back(std::move(path)); }

 private:
  struct Value {
    std::vector<std::string> values;
    bool given = false;
  };
  std::map<std::string, Value, std::less<>> values_;
  std::vector<std::filesystem::path> inputs_;
};

struct CommandRow {
  std::string name;
  std::string summary;      // one line for the list of commands
  std::string description;  // a paragraph for --help
  std::vector<PositionalRow> positionals;
  std::vector<OptionRow> options;     // beside those that every command has
  std::vector<std::string> examples;  // whole command lines
  ExitCode (*run)(const Arguments& arguments, Console& console) = nullptr;
};

// --root, --path, --json, --help: every command has them.
const std::vector<OptionRow>& common_options();
// Its own, --force where it writes files, and those.
std::vector<OptionRow> all_options(const CommandRow& command);

}  // namespace stampede::program
