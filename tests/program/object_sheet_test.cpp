#include <catch2/catch.hpp>

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

TEST_CASE("a task's hash is the same each time, and another task's is another") {
  const Said first = say({"list", "reach_target", "--hash"}), again = say({"list", "reach_target", "--hash"});
  REQUIRE(first.code == kDone);
  CHECK(first.out.size() == 33);
  CHECK(first.out == again.out);
  CHECK(first.out != say({"list", "close_drawer", "--hash"}).out);
}
