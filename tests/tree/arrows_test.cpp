// The rooms and their arrows: who may include whom, and who may know which library.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

const fs::path kRoot = STAMPEDE_SOURCE_DIR;

std::vector<fs::path> sources(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    const std::string ending = entry.path().extension();
    if (ending == ".h" || ending == ".cpp") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> includes(const fs::path& file) {
  std::vector<std::string> names;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("#include ")) continue;
    const std::size_t first = line.find_first_of("<\""), last = line.find_first_of(">\"", first + 1);
    names.push_back(line.substr(first + 1, last - first - 1));
  }
  return names;
}

// Left of the colon may include what is right of it, and itself.
const std::map<std::string, std::set<std::string>> kArrows = {
    {"engine/base", {}},
    {"engine/geometry", {"engine/base"}},
    {"engine/model", {"engine/base", "engine/geometry"}},
    {"engine/render", {"engine/base", "engine/geometry", "engine/model"}},
    {"engine/sim", {"engine/base", "engine/geometry", "engine/model"}},
    {"engine/motion", {"engine/base", "engine/geometry", "engine/model", "engine/sim"}},
    {"engine/symbolic", {"engine/base"}},
    {"engine/bddl", {"engine/base", "engine/symbolic"}},
    {"engine/episode",
     {"engine/base", "engine/geometry", "engine/model", "engine/render", "engine/sim", "engine/motion",
      "engine/symbolic"}},
    {"db",
     {"engine/base", "engine/geometry", "engine/model", "engine/render", "engine/sim", "engine/motion",
      "engine/symbolic", "engine/episode"}},
};

std::string room_of(const std::string& include) {
  for (const auto& [room, uses] : kArrows)
    if (include.starts_with(room + "/")) return room;
  return include.starts_with("scripting/") ? "scripting" : "";
}

}  // namespace

TEST_CASE("no folder includes one to its right") {
  for (const auto& [room, uses] : kArrows)
    for (const fs::path& file : sources(room))
      for (const std::string& include : includes(file)) {
        const std::string other = room_of(include);
        INFO(file << " includes " << include);
        CHECK((other.empty() || other == room || uses.contains(other)));
      }
}

TEST_CASE("each library is known to one folder") {
  const std::vector<std::pair<std::string, std::string>> owners = {
      {"bt", "engine/sim"},      {"Bullet", "engine/sim"}, {"ompl/", "engine/motion"}, {"assimp/", "engine/geometry"},
      {"urdf_", "engine/model"}, {"lua", "scripting"},     {"sqlite3", "db"},          {"GL/", "engine/render"},
      {"CLI/", "scripting"},     {"libav", "scripting"},   {"libsw", "scripting"},     {"ft2build", "engine/render"}};
  for (const std::string folder : {"engine", "db", "scripting"})
    for (const fs::path& file : sources(folder))
      for (const std::string& include : includes(file))
        for (const auto& [library, owner] : owners) {
          const std::string shown = fs::relative(file, kRoot).string();
          INFO(shown << " includes " << include << ", which belongs to " << owner);
          CHECK((!include.starts_with(library) || shown.starts_with(owner + "/")));
        }
}

TEST_CASE("the root holds the nine names and what tools insist on") {
  const std::set<std::string> allowed = {"CMakeLists.txt",   "engine", "scripting", "tasks",     "skills",
                                         "worlds",           "db",     "tests",     "README.md", "LICENSE",
                                         "CMakePresets.json"};
  for (const auto& entry : fs::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename();
    INFO(name);
    CHECK((name.starts_with(".") || allowed.contains(name)));
  }
}

TEST_CASE("every room opens with its README") {
  for (const auto& [room, uses] : kArrows) {
    INFO(room);
    CHECK(fs::exists(kRoot / room / "README.md"));
  }
}
