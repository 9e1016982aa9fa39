#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "db/embedded_sql.h"
#include "db/reference.h"
#include "engine/base/reason.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;

namespace {

std::vector<std::string> first_column(const Catalogue& catalogue, const std::string& sql) {
  std::vector<std::string> list;
  for (const auto& row : catalogue.query(sql).rows) list.push_back(std::get<std::string>(row[0]));
  return list;
}

// The words in single quotes of each `COLUMN … CHECK (COLUMN IN (…))` of a table.
std::set<std::string> enumeration(const Catalogue& catalogue, const std::string& table, const std::string& column) {
  const std::string sql = first_column(catalogue, "SELECT sql FROM sqlite_master WHERE name = '" + table + "'").at(0);
  const std::string head = "CHECK (" + column + " IN (";
  const std::size_t begin = sql.find(head);
  REQUIRE(begin != std::string::npos);
  std::istringstream words(sql.substr(begin + head.size(), sql.find("))", begin) - begin - head.size()));
  std::set<std::string> result;
  for (std::string part; std::getline(words, part, '\'');)
    if (std::getline(words, part, '\'')) result.insert(part);
  return result;
}

std::string read(const std::string& path) {
  std::ifstream file(std::string(STAMPEDE_SOURCE_DIR "/") + path);
  REQUIRE(file.good());
  return {std::istreambuf_iterator<char>(file), {}};
}

// `## view` headings and the first cells of the table below each.
std::map<std::string, std::vector<std::string>> documented_columns() {
  std::map<std::string, std::vector<std::string>> views;
  std::istringstream lines(read("db/README.md"));
  std::string view;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("### ")) view = line.substr(4);
    if (view.empty() || !line.starts_with("| `")) continue;
    CHECK(std::count(line.begin(), line.end(), '|') == 6);  // column, meaning, unit, frame, NULL
    views[view].push_back(line.substr(3, line.find('`', 3) - 3));
  }
  return views;
}

}  // namespace

TEST_CASE("the lists of C++ and the checks of SQL are the same") {
  const Folder folder;
  const Catalogue catalogue = Catalogue::write(folder / "a.db");
  std::set<std::string> reasons;
  for (const Reason reason : all_reasons()) reasons.emplace(to_string(reason));
  const auto stored = first_column(catalogue, "SELECT name FROM reason");
  CHECK(std::set<std::string>(stored.begin(), stored.end()) == reasons);
  for (const char* table : {"episode", "segment"})
    CHECK(enumeration(catalogue, table, "outcome") == std::set<std::string>{"success", "failure"});
  CHECK(enumeration(catalogue, "segment", "kind") == std::set<std::string>{"subgoal", "skill", "motion", "control"});
  CHECK(enumeration(catalogue, "object", "kind") == std::set<std::string>{"body", "part", "region", "hand"});
  CHECK(enumeration(catalogue, "joint", "kind") == std::set<std::string>{"fixed", "hinge", "slider", "screw"});
  CHECK(enumeration(catalogue, "language", "level") ==
        std::set<std::string>{"task", "world", "subgoal", "skill", "motion"});
  CHECK(enumeration(catalogue, "language", "source") == std::set<std::string>{"template", "model", "person"});
  CHECK(enumeration(catalogue, "language", "grain") == std::set<std::string>{"goal", "steps", "motions"});
  for (const char* table : {"segment", "fact"})
    CHECK(enumeration(catalogue, table, "labelled_by") == std::set<std::string>{"simulator", "person", "model"});
}

TEST_CASE("checks refuse what is on no list") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  EpisodeRecord leak = sample_episode("lift", "colour=red", 1'000'000);
  leak.made.split = Split::train;  // seeds from a million up are for tests
  CHECK_THROWS_AS(catalogue.add(leak, kEngine), CatalogueError);
  EpisodeRecord unexplained = sample_episode("lift", "colour=red", 1);
  unexplained.outcome = Outcome::failure;  // without a reason
  CHECK_THROWS_AS(catalogue.add(unexplained, kEngine), CatalogueError);
  CHECK(catalogue.episodes().empty());
  CHECK(catalogue.add(sample_episode("lift", "colour=red", 1'000'000), kEngine) == 1);
}

TEST_CASE("all tables are strict, and actions may differ in length") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  catalogue.add(sample_episode("lift", "colour=red", 1), kEngine);
  CHECK(first_column(catalogue, "SELECT name FROM sqlite_master WHERE type = 'table' AND sql NOT LIKE '% STRICT%'")
            .empty());
  EpisodeRecord stray = sample_episode("lift", "colour=red", 2);
  stray.frames.back().action = ActionRecord{{1, 2, 3}, {}, 0};
  CHECK_NOTHROW(catalogue.add(stray, kEngine));  // the longest action decides how many channels there are
}

TEST_CASE("the README documents every column of every view, and no other") {
  const Folder folder;
  const Catalogue catalogue = Catalogue::write(folder / "a.db");
  const auto documented = documented_columns();
  std::set<std::string> names;
  for (const SqlFile& view : embedded_views()) {
    INFO(view.name);
    names.insert(view.name);
    const auto found = documented.find(view.name);
    REQUIRE(found != documented.end());
    CHECK(found->second == catalogue.query("SELECT * FROM " + view.name).columns);
  }
  for (const auto& [view, columns] : documented) CHECK(names.contains(view));
}

TEST_CASE("a view with episodes says of which task they are") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  catalogue.add(sample_episode("lift", "colour=red", 1), kEngine);
  for (const SqlFile& view : embedded_views()) {
    INFO(view.name);
    const std::vector<std::string> columns = catalogue.query("SELECT * FROM " + view.name).columns;
    if (std::find(columns.begin(), columns.end(), "episode") == columns.end()) continue;
    CHECK(std::find(columns.begin(), columns.end(), "task") != columns.end());
    for (const auto& row : catalogue.query("SELECT task FROM " + view.name).rows)
      CHECK(std::get<std::string>(row[0]) == "lift");
  }
}

TEST_CASE("the reference tells of every view and column what the README does") {
  const auto documented = documented_columns();
  REQUIRE(view_reference().size() == documented.size());
  for (const ViewReference& view : view_reference()) {
    INFO(view.name);
    CHECK(view.description.size() > 10);
    CHECK(view.description.find('|') == std::string::npos);
    REQUIRE(view.columns.size() == documented.at(view.name).size());
    for (const ViewColumn& column : view.columns) CHECK_FALSE((column.meaning.empty() || column.null.empty()));
  }
  const std::string metadata = datasette_metadata("my \"demos\"");
  CHECK_THAT(metadata,
             Catch::Contains(R"({"databases": {"my \"demos\"": {"tables": {)") &&
                 Catch::Contains(R"("grasps": {"description": "Each time the hand closed on an object)") &&
                 Catch::Contains(R"("width": "opening measured when held; m")") &&
                 Catch::Contains(R"("world_approach_x": "direction in which the hand came, x; 1; frame of )"));
}

TEST_CASE("the promised views are there") {
  for (const char* name :
       {"episodes", "demos",        "segments",     "tries",       "facts",    "frames",       "poses", "joints",
        "hands",    "actions",      "camera_poses", "transitions", "failures", "coverage",     "plans", "problems",
        "grasps",   "instructions", "cameras",      "images",      "masks",    "agent_actions"})
    CHECK(std::any_of(embedded_views().begin(), embedded_views().end(), [&](auto& v) { return v.name == name; }));
}
