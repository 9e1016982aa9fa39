#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "engine/geometry/drawn_mesh.h"
#include "tests/program/say.h"

using namespace stampede;
using namespace stampede::program;

TEST_CASE("the page of objects shows each of them") {
  const Folder folder;
  REQUIRE(say({"list", "objects", "--sheet", folder / "objects.png"}).code == kDone);
  const Image page = load_image(folder / "objects.png");
  CHECK(page.width > 1000);
  std::size_t red = 0;  // the cube's own
  for (std::size_t i = 0; i + 3 < page.rgba.size(); i += 4)
    red += page.rgba[i] > 2 * page.rgba[i + 1] && page.rgba[i] > 2 * page.rgba[i + 2] && page.rgba[i] > 100;
  CHECK(red > 3000);
  CHECK(say({"list", "skills", "--sheet", folder / "x.png"}).code == kUsage);
  CHECK(say({"list", "objects", "--sheet", folder / "no/such/folder.png"}).code != kDone);
}

TEST_CASE("an object's parts and regions are listed as scripts name them") {
  const Folder folder;
  const Said chest = say({"list", "chest", "--json", "--sheet", folder / "chest.png"});
  REQUIRE(chest.code == kDone);
  const auto rows = nlohmann::json::parse(chest.out);
  const auto row = [&](const std::string& name) {
    for (const auto& one : rows)
      if (one["name"] == name) return one;
    FAIL("no row " << name);
    return nlohmann::json();
  };
  CHECK(row("chest")["moves"] == "stands still");
  CHECK(row("chest.top_drawer")["kind"] == "part");
  CHECK(row("chest.top_drawer")["traits"] == "container openable reach_in");
  CHECK(row("chest.top_drawer")["moves"] == "slides 0 … 0.2 m");
  CHECK(row("chest.top_drawer")["numbers"].get<std::string>().find("open_at 0.15") != std::string::npos);
  CHECK(row("chest.top_drawer.inside")["size_m"] == "0.190 0.200 0.064");
  CHECK(load_image(folder / "chest.png").width < 300);
  CHECK(say({"list", "cube", "--json"}).out.find("\"moves\": \"free\"") != std::string::npos);
  CHECK(say({"list", "chst"}).err.find("did you mean 'chest'?") != std::string::npos);
  const Said numbers = say({"list", "numbers", "--json"});
  CHECK(numbers.out.find("position of its joint from which on it is open") != std::string::npos);
}

TEST_CASE("a task's hash is the same each time, and another task's is another") {
  const Said first = say({"list", "reach_target", "--hash"}), again = say({"list", "reach_target", "--hash"});
  REQUIRE(first.code == kDone);
  CHECK(first.out.size() == 33);
  CHECK(first.out == again.out);
  CHECK(first.out != say({"list", "close_drawer", "--hash"}).out);
  CHECK(say({"list", "--hash"}).out.find(first.out.substr(0, 32) + " reach_target\n") != std::string::npos);
  CHECK(say({"list", "chest", "--hash"}).code == kUsage);
}
