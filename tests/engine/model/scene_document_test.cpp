#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/model/scene.h"
#include "tests/support/panda.h"

using namespace stampede;

namespace {

// A scene in which every field differs from its default.
Scene rich_scene() {
  Scene scene = table_scene(2);
  scene.bodies[1].world_from_body = make_transform({0.1, 1.0 / 3.0, -0.0}, Quaternion(0.1, 0.2, 0.3, 0.4));
  Part drawer;
  drawer.name = "drawer";
  drawer.parent = 0;
  drawer.joint = {"slide",
                  JointKind::slider,
                  Vector3::UnitY(),
                  translation(1, 2, 3),
                  -0.1,
                  0.3,
                  0.05,
                  1,
                  2,
                  3,
                  4,
                  5,
                  0.01,
                  6,
                  "key",
                  0.2,
                  0.1};
  Shape hull;
  hull.kind = ShapeKind::hull;
  hull.points = {{0, 0, 0}, {1e-300, 0, 0}, {0, 0.1, 0}, {0, 0, 5e-324}};
  hull.visible = false;
  drawer.shapes.push_back(hull);
  drawer.surface = {0.1, 0.2, 0.3, 0.4, true};
  scene.bodies[0].parts.push_back(drawer);
  scene.regions.push_back({"inside", "table", 1, translation(0, 0, 0.1), {1, 2, 3}, true, {0.1, 0.2, 0.3, 0.4}});
  scene.cameras.push_back(
      {"front", "table", 1, translation(1, 0, 1), 64, 48, 70, 71, 31.5, 24.5, {0.1, 0.2, 0.3, 0.4, 0.5}, 0.02, 3.2});
  scene.objects[0].attributes = {{"colour", "röd"}, {"size", "small"}};
  scene.objects[0].numbers = {{"open_at", 0.1}};
  scene.objects[0].grasps.push_back({translation(0, 0, 0.1), 0.03, 0.07, 15});
  scene.gravity = {0.1, 0, -1.62};
  scene.physics_hz = 480;
  scene.frame_hz = 10;
  return scene;
}

}  // namespace

TEST_CASE("a scene survives its document, and the document its scene") {
  const std::string document = scene_to_document(rich_scene());
  const Scene back = scene_from_document(document);
  CHECK(scene_to_document(back) == document);
  const Scene scene = rich_scene();
  CHECK(back.bodies[1].world_from_body.matrix() == scene.bodies[1].world_from_body.matrix());
  CHECK(std::signbit(back.bodies[1].world_from_body.translation().z()));
  CHECK(back.bodies[0].parts[1].shapes[0].points == scene.bodies[0].parts[1].shapes[0].points);
  CHECK(back.bodies[0].parts[1].joint.latch_key == "key");
  CHECK(back.robot.checked_pairs == scene.robot.checked_pairs);
  CHECK(back.robot.body.parts[3].inertia == scene.robot.body.parts[3].inertia);
  CHECK(back.objects[0].attributes == scene.objects[0].attributes);
  CHECK(back.regions[0].size == scene.regions[0].size);
  CHECK(back.cameras[0].far_m == 3.2);
}

TEST_CASE("every difference shows in the document") {
  const std::string document = scene_to_document(table_scene(1));
  Scene scene = table_scene(1);
  CHECK(scene_to_document(scene) == document);
  scene.bodies[1].parts[0].mass = std::nextafter(0.1, 1.0);
  CHECK(scene_to_document(scene) != document);
}

TEST_CASE("a number that is not finite cannot be stored, and the error says where") {
  Scene scene = table_scene(1);
  scene.bodies[1].parts[0].mass = std::nan("");
  try {
    (void)scene_to_document(scene);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.where() == "scene.bodies[1].parts[0].mass");
  }
}

TEST_CASE("damaged documents are errors, never crashes") {
  const std::string document = scene_to_document(table_scene(1));
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = document;
    REQUIRE(text.find(from) != std::string::npos);
    return text.replace(text.find(from), from.size(), to);
  };
  for (const std::string& bad :
       {std::string(), std::string("[]"), document.substr(0, document.size() / 2),
        replaced("\"physics_hz\":240", "\"physics_hz\":\"fast\""),
        replaced("\"physics_hz\":240", "\"physics_herz\":240"), replaced("\"format\":1", "\"format\":2"),
        replaced("\"parent\":-1", "\"parent\":7"), replaced("\"tip_part\":9", "\"tip_part\":900"),
        replaced("\"kind\":\"box\"", "\"kind\":\"torus\"")})
    CHECK_THROWS_AS(scene_from_document(bad), Error);
}
