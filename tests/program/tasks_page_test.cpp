// The figures of tasks/README.md are of the tasks as they are now: tests/bench/tasks_page writes them anew.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>

#include "scripting/library/library.h"
#include "scripting/runtime/episode_scripts.h"
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

struct Turned {
  double least = 0, most = 0;  // degrees, from facing straight
  std::set<int> sides;         // 0: opposite the arm; 1, -1: at the table's sides, towards +y and -y
};

// `±22 across, −30 … 14 on two sides: why`; nothing for what does not stand at a side.
std::vector<Turned> furniture_in(std::string cell) {
  cell = cell.substr(0, cell.find(": "));
  for (const auto& [from, to] : {std::pair("−", "-"), std::pair("±", "+-")})
    for (std::size_t at = cell.find(from); at != std::string::npos; at = cell.find(from))
      cell.replace(at, std::strlen(from), to);
  static const std::regex kRange(R"((?:\+-(\d+)|(-?\d+) … (-?\d+)) (across|on (?:one|two|three) sides?))");
  std::vector<Turned> all;
  for (std::sregex_iterator one(cell.begin(), cell.end(), kRange), end; one != end; ++one) {
    const std::smatch& found = *one;
    Turned& turned = all.emplace_back();
    turned.most = std::stod(found[1].matched ? found[1] : found[3]);
    turned.least = found[1].matched ? -turned.most : std::stod(found[2]);
    const std::string where = found[4];
    if (where == "across") turned.sides = {0};
    if (where == "on one side") turned.sides = {1};
    if (where == "on two sides") turned.sides = {-1, 1};
    if (where == "on three sides") turned.sides = {-1, 0, 1};
  }
  return all;
}

constexpr double kDegrees = 180 / std::numbers::pi;

// Of what stands fixed in a task's draws, by side; the table and what does not turn are not there.
std::map<int, std::vector<double>> turned_in(const std::shared_ptr<const Library>& library, const std::string& task,
                                             int draws) {
  std::map<std::string, std::map<int, std::vector<double>>> by_body;
  const Library::TaskInfo& info = *library->task(task);
  EpisodeScripts scripts(library, task, info.variation_texts.empty() ? "" : info.variation_texts.front(), 1);
  for (int draw = 0; draw < draws; ++draw) {
    const Task drawn = scripts.task()(draw);
    for (const Body& body : drawn.scene.bodies) {
      if (body.free) continue;
      const Matrix3 axes = body.world_from_body.linear();
      const double yaw = kDegrees * std::atan2(axes(1, 0), axes(0, 0)), y = body.world_from_body.translation().y();
      const int side = std::abs(y) < 0.3 ? 0 : y > 0 ? 1 : -1;
      by_body[body.name][side].push_back(std::remainder(yaw - 90 * side, 360));
    }
  }
  std::map<int, std::vector<double>> turned;
  for (const auto& [name, sides] : by_body)
    for (const auto& [side, yaws] : sides)
      if (std::ranges::max(yaws) - std::ranges::min(yaws) > 1)
        turned[side].insert(turned[side].end(), yaws.begin(), yaws.end());
  return turned;
}

}  // namespace

TEST_CASE("furniture is turned as far as the page says, and no further") {
  const std::shared_ptr<const Library> library = Library::load(Roots{{STAMPEDE_SOURCE_DIR}});
  std::istringstream page(file_text(std::string(STAMPEDE_SOURCE_DIR) + "/tasks/README.md"));
  int count = 0;
  bool within = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) within = line == "## Success beside RLBench's";
    if (!within || !line.starts_with("| `")) continue;
    const std::string task = line.substr(3, line.find('`', 3) - 3);
    const std::size_t last = line.rfind('|', line.rfind('|') - 1);
    const std::vector<Turned> told = furniture_in(line.substr(last + 1));
    if (told.empty()) continue;
    ++count;
    const auto seen = turned_in(library, task, 160);
    std::set<int> sides;
    for (const Turned& one : told) {
      for (const int side : one.sides) {
        INFO(task << ", side " << side);
        REQUIRE(seen.contains(side));
        sides.insert(side);
        const auto [least, most] = std::ranges::minmax(seen.at(side));
        CHECK(least > one.least - 0.6);
        CHECK(least < one.least + 9);
        CHECK(most < one.most + 0.6);
        CHECK(most > one.most - 9);
      }
    }
    INFO(task);
    CHECK(sides.size() == seen.size());
  }
  CHECK(count > 25);
}

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
