// What a release has promised is still there: scripting/RELEASES.md says what that is, and for how long.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <regex>
#include <set>

#include "db/query.h"
#include "db/reference.h"
#include "scripting/commands/commands.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

using Names = std::set<std::string>;

void add_commands(Names& names) {
  for (const CommandRow& command : all_commands()) {
    names.insert("command " + command.name);
    for (const OptionRow& option : all_options(command))
      names.insert("option " + command.name + " " + option.name +
                   (option.takes == Takes::flag ? "" : " " + option.value));
  }
}

void add_sql(Names& names) {
  for (const ViewReference& view : view_reference())
    for (const ViewColumn& column : view.columns) names.insert("sql " + view.name + "." + column.name);
  for (const NamedQuery& query : named_queries()) names.insert("question " + query.name);
}

// Of what editors are told: fields of definitions, words, methods.
void add_lua(Names& names) {
  const std::regex row(R"(^(---@class stampede\.(\w+)|---@field (\w+)|function ([\w.:]+)\().*)");
  std::string of;
  for (const char* file : {"words.lua", "stampede.lua"}) {
    std::istringstream lines(file_text(std::string(kRoot) + "/scripting/library/" + file));
    for (std::string line; std::getline(lines, line);) {
      std::smatch found;
      if (!std::regex_match(line, found, row)) continue;
      if (found[2].matched) of = found[2];
      if (found[3].matched) names.insert("lua " + of + "." + found[3].str());
      if (found[4].matched) names.insert("lua " + found[4].str() + "()");
    }
  }
}

// Functions that the shared library gives, with their parameters: the public headers declare these and no others.
void add_cpp(Names& names) {
  const std::string command = std::string("nm -DC --defined-only '") + STAMPEDE_LIBRARY + "'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  REQUIRE(pipe);
  std::string text;
  std::array<char, 4096> piece{};
  for (std::size_t got = 0; (got = fread(piece.data(), 1, piece.size(), pipe.get())) > 0;)
    text.append(piece.data(), got);
  std::istringstream lines(text);
  const std::regex row(R"([0-9a-f]+ T (stampede::.*))");
  for (std::string line; std::getline(lines, line);)
    if (std::smatch found; std::regex_match(line, found, row)) names.insert("c++ " + found[1].str());
}

}  // namespace

TEST_CASE("what this release has promised is still there") {
  Names now;
  add_commands(now), add_sql(now), add_lua(now), add_cpp(now);
  for (const char* part :
       {"command run", "sql episodes.task", "lua task.goal", "lua at_least()", "c++ stampede::Session::"})
    CHECK(std::ranges::any_of(now, [&](const std::string& name) { return name.starts_with(part); }));

  const std::string version = STAMPEDE_VERSION;
  const std::string file =
      std::string(kRoot) + "/tests/program/promised/" + version.substr(0, version.rfind('.')) + ".txt";
  if (std::getenv("STAMPEDE_PROMISE") != nullptr) {  // .ci/release
    std::ofstream out(file, std::ios::binary);
    for (const std::string& name : now) out << name << "\n";
  }
  std::istringstream promised(file_text(file));
  INFO("a name that goes or changes takes a new version: see scripting/RELEASES.md");
  int count = 0;
  for (std::string name; std::getline(promised, name); ++count) {
    INFO(name);
    CHECK(now.contains(name));
  }
  CHECK(count > 1000);
}

TEST_CASE("who cites this release names its version") {
  CHECK(says(file_text(std::string(kRoot) + "/CITATION.cff"), "\nversion: " + std::string(STAMPEDE_VERSION) + "\n"));
}

}  // namespace stampede::program
