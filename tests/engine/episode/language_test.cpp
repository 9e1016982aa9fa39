// A sentence names a thing so that a person who sees the first picture finds it.
#include "engine/episode/language.h"

#include <catch2/catch.hpp>

#include "engine/model/camera.h"
#include "tests/support/panda.h"

using namespace stampede;

namespace {

void put(Scene& scene, const char* body, const Vector3& at) {
  scene.bodies[static_cast<std::size_t>(scene.body_index(body))].world_from_body = translation(at.x(), at.y(), at.z());
}

std::vector<std::string> phrases(const Scene& scene, int cubes) {
  std::vector<std::string> all;
  for (int i = 1; i <= cubes; ++i) all.push_back(phrase(scene, "cube" + std::to_string(i)));
  return all;
}

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("things that share their words are told apart from left to right") {
  Scene scene = table_scene(2);
  put(scene, "cube1", {0.5, 0.2, 0.02});
  put(scene, "cube2", {0.5, -0.2, 0.02});
  CHECK(phrases(scene, 2) == Words{"left cube", "right cube"});  // without a camera, as the robot sees them

  Camera front;  // looks at the robot, upside up
  front.name = "front";
  front.mount_from_camera = looking_at({2, 0, 0.5}, {0, 0, 0.5});
  scene.cameras = {front};
  CHECK(phrases(scene, 2) == Words{"right cube", "left cube"});

  Scene five = table_scene(5);  // at -0.2, -0.1 … 0.2
  CHECK(phrases(five, 5) == Words{"rightmost cube", "fourth cube from the left", "third cube from the left",
                                  "second cube from the left", "leftmost cube"});
  CHECK(phrase(five, "table") == "table");
}

TEST_CASE("things above each other are told apart by that") {
  Scene scene = table_scene(3);
  put(scene, "cube1", {0.5, 0.1, 0.4});
  put(scene, "cube2", {0.5, -0.1, 0.02});
  put(scene, "cube3", {0.5, 0, 0.2});
  CHECK(phrases(scene, 3) == Words{"upper cube", "lower cube", "middle cube"});
}

TEST_CASE("a number at the end of a name stands apart, the name of a square of a chess board does not") {
  const Scene scene = table_scene(0);
  CHECK(phrase(scene, "red_square12") == "red square 12");
  CHECK(phrase(scene, "socket3") == "socket 3");
  CHECK(phrase(scene, "c8") == "c8");
  CHECK(phrase(scene, "row c8") == "row c8");
}
