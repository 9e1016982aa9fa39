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
    if (ending == ".h" || ending == ".cpp" || ending == ".inl") files.push_back(entry.path());
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

// A public header stands in the include folder of engine, db or scripting: `stampede/arrays.h` is the engine's.
std::string path_of(const std::string& include) {
  if (!include.starts_with("stampede/")) return include;
  for (const char* part : {"engine", "db", "scripting"}) {
    const std::string path = std::string(part) + "/include/" + include;
    if (fs::exists(kRoot / path)) return path;
  }
  return include;
}

bool is_ours(const std::string& include) {
  return include.starts_with("engine/") || include.starts_with("db/") || include.starts_with("scripting/");
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
    {"engine/learning", {"engine/base", "engine/symbolic"}},
    {"engine/record", {"engine/base", "engine/geometry", "engine/model", "engine/render", "engine/symbolic"}},
    {"db", {"engine/base", "engine/geometry", "engine/model", "engine/render", "engine/symbolic", "engine/record"}},
    {"db/research", {"engine/base", "engine/symbolic", "engine/learning", "db"}},
    {"db/recording", {"engine/base", "engine/geometry", "engine/model", "engine/render", "engine/record", "db"}},
    {"engine/start",
     {"engine/base", "engine/geometry", "engine/model", "engine/render", "engine/sim", "engine/motion",
      "engine/symbolic", "engine/record"}},
    {"engine/language",
     {"engine/base", "engine/geometry", "engine/model", "engine/symbolic", "engine/record", "engine/start"}},
    {"engine/rollout",
     {"engine/base", "engine/geometry", "engine/model", "engine/render", "engine/sim", "engine/motion",
      "engine/symbolic", "engine/record", "engine/start"}},
    {"engine/episode",
     {"engine/base", "engine/geometry", "engine/model", "engine/render", "engine/sim", "engine/motion",
      "engine/symbolic", "engine/record", "engine/start", "engine/rollout"}},
};

// Rooms in one line: each may include all before it, and what is left of the first.
const std::vector<std::string> kScripting = {"scripting/lua",     "scripting/library",   "scripting/runtime",
                                             "scripting/session", "scripting/sentences", "scripting/program",
                                             "scripting/commands"};

std::map<std::string, std::set<std::string>> all_arrows() {
  std::map<std::string, std::set<std::string>> arrows = kArrows;
  std::set<std::string> before;
  for (const auto& [room, uses] : kArrows) before.insert(room);
  for (const std::string& room : kScripting) {
    arrows[room] = before;
    before.insert(room);
  }
  // The catalogue, and episodes that run, are known from the session on; the sandbox knows nothing but errors.
  for (const char* room : {"scripting/library", "scripting/runtime"})
    for (const char* later : {"db", "db/recording", "db/research", "engine/rollout", "engine/episode"})
      arrows[room].erase(later);
  arrows["scripting/lua"] = {"engine/base"};
  return arrows;
}

// The innermost, where one room lies in the folder of another.
std::string room_of(const std::string& include, const std::map<std::string, std::set<std::string>>& arrows) {
  std::string innermost;
  for (const auto& [room, uses] : arrows)
    if (include.starts_with(room + "/") && room.size() > innermost.size()) innermost = room;
  return innermost;
}

// Of engine, db and scripting a part sees its own public headers and those of the parts before it.
bool may_see_public(const std::string& room, const std::string& part) {
  const std::vector<std::string> parts = {"engine", "db", "scripting"};
  const auto place = [&](const std::string& name) {
    return std::find(parts.begin(), parts.end(), name.substr(0, name.find('/'))) - parts.begin();
  };
  return place(part) <= place(room);
}

// `| its SQL rows | session → db → record |` of engine/README.md; a room goes by the last part of its name.
std::vector<std::vector<std::string>> walks() {
  const std::string arrow = " → ", end = " |";
  std::vector<std::vector<std::string>> walks;
  std::ifstream file(kRoot / "engine/README.md");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("| ") || line.find(arrow) == std::string::npos) continue;
    std::vector<std::string>& walk = walks.emplace_back();
    line = line.substr(line.find(end) + 3, line.rfind(end) - line.find(end) - 3);
    for (std::size_t at = 0; at != std::string::npos;) {
      const std::size_t next = line.find(arrow, at);
      walk.push_back(line.substr(at, next - at));
      at = next == std::string::npos ? next : next + arrow.size();
    }
  }
  return walks;
}

}  // namespace

TEST_CASE("no folder includes one to its right") {
  const auto arrows = all_arrows();
  for (const auto& [room, uses] : arrows)
    for (const fs::path& file : sources(room))
      for (const std::string& name : includes(file)) {
        const std::string include = path_of(name);
        if (!is_ours(include)) continue;
        INFO(file << " includes " << include);
        if (include.find("/include/stampede/") != std::string::npos) {
          CHECK(may_see_public(room, include.substr(0, include.find('/'))));
          continue;
        }
        const std::string own = room_of(fs::relative(file, kRoot).string(), arrows), other = room_of(include, arrows);
        CHECK((other == own || arrows.at(own).contains(other)));
      }
}

TEST_CASE("walks through the rooms go downhill: each room includes the next, which may not include it") {
  const auto arrows = all_arrows();
  const auto room_called = [&](const std::string& name) {
    for (const auto& [room, uses] : arrows)
      if (room == name || room.ends_with("/" + name)) return room;
    return std::string();
  };
  std::size_t steps = 0;
  for (const std::vector<std::string>& walk : walks())
    for (std::size_t i = 0; i + 1 < walk.size(); ++i, ++steps) {
      const std::string from = room_called(walk[i]), to = room_called(walk[i + 1]);
      INFO(walk[i] << " to " << walk[i + 1]);
      REQUIRE((!from.empty() && !to.empty()));
      CHECK_FALSE(arrows.at(to).contains(from));
      const std::vector<fs::path> files = sources(from);
      CHECK(std::any_of(files.begin(), files.end(), [&](const fs::path& file) {
        const std::vector<std::string> names = includes(file);
        return std::any_of(names.begin(), names.end(),
                           [&](const std::string& name) { return room_of(name, arrows) == to; });
      }));
    }
  CHECK(steps > 20);
}

TEST_CASE("public headers stand alone: they include the standard library and each other") {
  for (const std::string part : {"engine", "db", "scripting"})
    for (const fs::path& file : sources(part + "/include"))
      for (const std::string& name : includes(file)) {
        if (file.filename() == "error.h" && name == "engine/base/error.h") continue;  // installed as that file
        INFO(file << " includes " << name);
        const std::string other = path_of(name).substr(0, path_of(name).find('/'));
        CHECK((name.find('/') == std::string::npos || (name.starts_with("stampede/") && may_see_public(part, other))));
      }
}

TEST_CASE("every folder with sources is a room, and in main.cpp all meet") {
  const auto arrows = all_arrows();
  for (const std::string part : {"engine", "db", "scripting"})
    for (const fs::path& file : sources(part)) {
      const std::string shown = fs::relative(file, kRoot).string();
      INFO(shown);
      CHECK((!room_of(shown, arrows).empty() || shown.find("/include/stampede/") != std::string::npos ||
             shown.starts_with("engine/cmake/") || shown.starts_with("scripting/python/core/") ||
             shown == "scripting/main.cpp"));
    }
}

TEST_CASE("the Python module is an embedder: it sees public headers and its own alone") {
  const std::vector<fs::path> files = sources("scripting/python/core");
  CHECK(files.size() > 4);
  for (const fs::path& file : files)
    for (const std::string& include : includes(file)) {
      INFO(file << " includes " << include);
      const bool own = fs::exists(file.parent_path() / include);
      CHECK((own || include.starts_with("stampede/") || include.starts_with("nanobind/") ||
             include.find('/') == std::string::npos));
    }
}

TEST_CASE("each library is known to one folder") {
  const std::vector<std::pair<std::string, std::string>> owners = {{"bt", "engine/sim"},
                                                                   {"Bullet", "engine/sim"},
                                                                   {"ompl/", "engine/motion"},
                                                                   {"urdf_", "engine/model"},
                                                                   {"assimp/", "engine/geometry"},
                                                                   {"GL/", "engine/render"},
                                                                   {"ft2build", "engine/render"},
                                                                   {"sqlite3", "db"},
                                                                   {"lua", "scripting"},
                                                                   {"CLI/", "scripting/program"},
                                                                   {"libav", "scripting/program"},
                                                                   {"libsw", "scripting/program"},
                                                                   {"curl/", "scripting/sentences/chat_client.cpp"}};
  for (const std::string folder : {"engine", "db", "scripting"})
    for (const fs::path& file : sources(folder))
      for (const std::string& include : includes(file))
        for (const auto& [library, owner] : owners) {
          const std::string shown = fs::relative(file, kRoot).string();
          INFO(shown << " includes " << include << ", which belongs to " << owner);
          CHECK((!include.starts_with(library) || shown == owner || shown.starts_with(owner + "/")));
        }
}

TEST_CASE("the root holds the nine names and what tools insist on") {
  const std::set<std::string> allowed = {
      "CMakeLists.txt", "engine",  "scripting",         "tasks",          "skills",       "worlds",      "db", "tests",
      "README.md",      "LICENSE", "CMakePresets.json", "pyproject.toml", "CHANGELOG.md", "CITATION.cff"};
  for (const auto& entry : fs::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename();
    INFO(name);
    CHECK((name.starts_with(".") || allowed.contains(name)));
  }
}

// ctest takes lists apart at it, and then runs half a name.
TEST_CASE("no test has a semicolon in its name") {
  for (const fs::path& file : sources("tests")) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
      if (!line.starts_with("TEST_CASE(\"")) continue;
      INFO(file.string() << ": " << line);
      CHECK(line.substr(0, line.find('"', 11)).find(';') == std::string::npos);
    }
  }
}

TEST_CASE("every room opens with its README") {
  for (const auto& [room, uses] : all_arrows()) {
    INFO(room);
    CHECK(fs::exists(kRoot / room / "README.md"));
  }
}
