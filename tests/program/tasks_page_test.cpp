// The figures of tasks/README.md are of the tasks as they are now: tests/bench/tasks_page writes them anew.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "scripting/library/library.h"
#include "tests/program/say.h"

using namespace stampede;
using namespace stampede::program;

namespace {

// `HASH stack_blocks`
std::map<std::string, std::string> hashes_in(std::istream& lines) {
  std::map<std::string, std::string> hashes;
  for (std::string hash, task; lines >> hash >> task;) hashes[task] = hash;
  return hashes;
}

}  // namespace

TEST_CASE("every task is on the page with figures of its present files: else run tests/bench/tasks_page") {
  std::ifstream page(STAMPEDE_SOURCE_DIR "/tests/bench/tasks_page.hashes");
  std::istringstream present(say({"list", "--hash"}).out);
  const auto hashes = hashes_in(page), now = hashes_in(present);
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(STAMPEDE_SOURCE_DIR "/tasks")) {
    if (entry.path().extension() != ".lua") continue;
    ++count;
    const std::string task = entry.path().stem();
    INFO(task);
    REQUIRE(hashes.contains(task));
    REQUIRE(now.contains(task));
    CHECK(hashes.at(task) == now.at(task));
  }
  CHECK(hashes.size() == count);
}

TEST_CASE("the page says of every task what success and yaw are, beside RLBench's") {
  std::set<std::string> listed;
  std::istringstream page(file_text(std::string(STAMPEDE_SOURCE_DIR) + "/tasks/README.md"));
  bool within = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) within = line == "## Success beside RLBench's";
    if (!within || !line.starts_with("| `")) continue;
    INFO(line);
    CHECK(std::count(line.begin(), line.end(), '|') == 6);
    CHECK(line.find("|  |") == std::string::npos);
    const std::string task = line.substr(3, line.find('`', 3) - 3);
    CHECK(std::filesystem::exists(STAMPEDE_SOURCE_DIR "/tasks/" + task + ".lua"));
    CHECK(listed.insert(task).second);
  }
  for (const auto& entry : std::filesystem::directory_iterator(STAMPEDE_SOURCE_DIR "/tasks"))
    if (entry.path().extension() == ".lua") CHECK(listed.contains(entry.path().stem()));
}

TEST_CASE("the page of skills tells of skills that there are which tasks use them, and of tasks that there are") {
  std::istringstream page(file_text(std::string(STAMPEDE_SOURCE_DIR) + "/skills/README.md"));
  bool within = false;
  int rows = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("<!-- ")) within = line == "<!-- begin uses -->";
    if (!within || !line.starts_with("| `")) continue;
    INFO(line);
    ++rows;
    const std::size_t end = line.find('`', 3);
    CHECK(std::filesystem::exists(STAMPEDE_SOURCE_DIR "/skills/" + line.substr(3, end - 3) + ".lua"));
    std::istringstream tasks(line.substr(end + 3, line.rfind('|') - end - 3));
    for (std::string task; tasks >> task;)
      CHECK(std::filesystem::exists(STAMPEDE_SOURCE_DIR "/tasks/" + task + ".lua"));
  }
  CHECK(rows > 15);
}
