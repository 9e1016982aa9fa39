// What README.md says there is of everything, counted.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <regex>

#include "scripting/commands/commands.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = STAMPEDE_SOURCE_DIR;

template <typename Counts>
int count_files(const fs::path& folder, Counts counts) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) count += counts(entry.path());
  return count;
}

// A folder of the engine, the catalogue or the scripts with sources opens with its README. In main.cpp all rooms meet.
bool opens_a_room(const fs::path& file) {
  if (file.filename() != "README.md") return false;
  return std::any_of(fs::directory_iterator(file.parent_path()), fs::directory_iterator(), [](const auto& entry) {
    return entry.path().extension() == ".cpp" && entry.path().filename() != "main.cpp";
  });
}

bool is_public(const fs::path& file) { return file.extension() == ".h" && file.parent_path().filename() == "stampede"; }

// Functions and tables of that name in what editors are told.
int words_in(const fs::path& file) {
  const std::string text = file_text(kSource / file);
  const std::regex word(R"((^|\n)(function [a-z_]+\(|[a-z_]+ = \{\}))");
  return static_cast<int>(std::distance(std::sregex_iterator(text.begin(), text.end(), word), std::sregex_iterator()));
}

}  // namespace

TEST_CASE("the README counts rooms, commands, words, views, ready questions and public headers, and is right") {
  std::map<std::string, int> counts;
  for (const char* part : {"engine", "db", "scripting"}) {
    counts["rooms"] += count_files(part, opens_a_room);
    counts["public headers"] += count_files(part, is_public);
  }
  counts["commands"] = static_cast<int>(all_commands().size());
  counts["words of the language"] =
      words_in("scripting/library/words.lua") + words_in("scripting/library/stampede.lua");
  const auto is_sql = [](const fs::path& file) { return file.extension() == ".sql"; };
  counts["views"] = count_files("db/views", is_sql);
  counts["ready questions"] = count_files("db/queries", is_sql);

  const std::string readme = file_text(kSource / "README.md");
  const std::size_t begin = readme.find("There are ");
  REQUIRE(begin != std::string::npos);
  const std::string said = readme.substr(begin, readme.find('.', begin) - begin);
  for (const auto& [what, count] : counts) {
    INFO(said << ", and there are " << count << " " << what);
    CHECK(says(said, " " + std::to_string(count) + " " + what));
  }
}

}  // namespace stampede::program
