#include "engine/model/randomise.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "tests/support/panda.h"

using namespace stampede;

namespace {

const RandomKey kKey = RandomKey("randomise test").with(7);

// The cubes have a colour that tells them apart, the last one has none; the table has a drawer; two cameras.
Scene furnished(int cubes) {
  Scene scene = table_scene(cubes);
  for (Object& object : scene.objects)
    if (object.name.starts_with("cube") && object.name != "cube1") object.attributes["colour"] = "red";
  Part drawer = scene.bodies[0].parts[0];
  drawer.name = "drawer", drawer.parent = 0, drawer.mass = 1, drawer.inertia = Matrix3::Identity();
  drawer.joint.kind = JointKind::slider, drawer.joint.damping = 3;
  scene.bodies[0].parts.push_back(drawer);
  for (const char* name : {"front", "wrist"}) scene.cameras.emplace_back().name = name;
  scene.cameras[1].mount_body = scene.robot.name;
  return scene;
}

Scene drawn(Scene scene, const Randomisation& ranges, RandomKey key = kKey) {
  randomise(scene, ranges, key);
  return scene;
}

const Part& part(const Scene& scene, const std::string& body, std::size_t i = 0) {
  return scene.bodies.at(static_cast<std::size_t>(scene.body_index(body))).parts.at(i);
}

std::array<double, 4> colour(const Part& p) {
  const Colour& c = p.shapes.at(0).colour;
  return {c.red, c.green, c.blue, c.alpha};
}

std::string complaint(const Randomisation& ranges) {
  Scene scene = furnished(2);
  const std::string before = scene_to_document(scene);
  try {
    randomise(scene, ranges, kKey);
  } catch (const Error& error) {
    CHECK(scene_to_document(scene) == before);
    return error.where() + ": " + error.message() + " | " + error.hint();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("ranges as they come change nothing") {
  Scene scene = furnished(2);
  scene.light.ambient = 0.7;
  CHECK(scene_to_document(drawn(scene, {})) == scene_to_document(scene));
}

TEST_CASE("the same key draws the same scene, another key another, and both survive their documents") {
  const Scene a = drawn(furnished(3), default_randomisation());
  const std::string document = scene_to_document(a);
  CHECK(scene_to_document(drawn(furnished(3), default_randomisation())) == document);
  CHECK(scene_to_document(drawn(furnished(3), default_randomisation(), kKey.with(1))) != document);
  CHECK(scene_to_document(scene_from_document(document)) == document);
}

TEST_CASE("one more thing changes nobody else's draw") {
  const Scene few = drawn(furnished(2), default_randomisation()), many = drawn(furnished(9), default_randomisation());
  for (const std::string name : {"table", "cube1", "cube2"}) {
    CHECK(colour(part(few, name)) == colour(part(many, name)));
    CHECK(part(few, name).mass == part(many, name).mass);
    CHECK(part(few, name).surface.friction == part(many, name).surface.friction);
  }
  CHECK(few.light.ambient == many.light.ambient);
  Scene more = furnished(2);
  more.cameras.insert(more.cameras.begin(), Camera());
  CHECK(drawn(more, default_randomisation()).cameras[1].mount_from_camera.matrix() ==
        few.cameras[0].mount_from_camera.matrix());
}

TEST_CASE("what instructions tell by its colour keeps it, whether `*`, its name or its class is to look otherwise") {
  const Scene before = furnished(3);
  Randomisation ranges;
  ranges.looks = {"*"};
  const Scene all = drawn(before, ranges);
  CHECK(colour(part(all, "table")) != colour(part(before, "table")));
  CHECK(colour(part(all, "table")) != colour(part(all, "table", 1)));  // a drawer is not its chest
  CHECK(colour(part(all, "cube1")) != colour(part(before, "cube1")));
  CHECK(colour(part(all, "cube2")) == colour(part(before, "cube2")));
  for (const char* name : {"cube2", "cube"}) {
    ranges.looks = {name};
    CHECK(colour(part(drawn(before, ranges), "cube2")) == colour(part(before, "cube2")));
    CHECK(colour(part(drawn(before, ranges), "table")) == colour(part(before, "table")));
  }
  CHECK(colour(part(drawn(before, ranges), "cube1")) != colour(part(before, "cube1")));  // of the class, untold
}

TEST_CASE("colours come from the list, textures from the names, and alpha stays") {
  Scene before = furnished(8);
  for (Object& object : before.objects) object.attributes.clear();
  for (Shape& shape : before.bodies[0].parts[0].shapes) shape.colour.alpha = 0.5;
  before.textures["tiles"].kind = TextureKind::checker;
  before.textures["random_cube3"].kind = TextureKind::stripes;  // a name that is taken
  Randomisation ranges;
  ranges.looks = {"cube", "table", "robot"};
  ranges.colours = {{1, 0, 0, 1}, {0, 0, 1, 1}};
  ranges.textures = {"noise"};
  const Scene noise = drawn(before, ranges);
  const Texture& texture = noise.textures.at("random_table");
  CHECK(texture.kind == TextureKind::noise);
  CHECK(texture.first.red + texture.second.red == 1);  // the two of the list
  CHECK(part(noise, "table").shapes[0].texture == "random_table");
  CHECK(part(noise, "table", 1).shapes[0].texture == "random_table_drawer");
  CHECK(part(noise, "table").shapes[0].colour.alpha == 0.5);
  CHECK(part(noise, "cube3").shapes[0].texture == "random_cube3_2");
  CHECK(noise.textures.at("random_cube3").kind == TextureKind::stripes);
  CHECK(scene_to_document(scene_from_document(scene_to_document(noise))) == scene_to_document(noise));
  ranges.textures = {"tiles"};
  CHECK(part(drawn(before, ranges), "cube3").shapes[0].texture == "tiles");
  ranges.textures = {"plain"};
  for (Body& body : before.bodies)
    for (Part& each : body.parts)
      for (Shape& shape : each.shapes) shape.texture = "tiles";
  const Scene plain = drawn(before, ranges);
  CHECK(part(plain, "cube3").shapes[0].texture.empty());
  CHECK(colour(part(plain, "cube3"))[0] + colour(part(plain, "cube3"))[2] == 1);
}

TEST_CASE("light is drawn within its ranges and tilts no further than it may") {
  Randomisation ranges;
  ranges.ambient = {0.2, 0.3}, ranges.diffuse = {0.7, 0.9}, ranges.light_direction_rad = 0.4;
  double widest = 0, brightest = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const Light before = furnished(0).light, light = drawn(furnished(0), ranges, kKey.with(seed)).light;
    CHECK((light.ambient >= 0.2 && light.ambient < 0.3));
    CHECK((light.diffuse >= 0.7 && light.diffuse < 0.9));
    const double tilt =
        std::atan2(light.direction.cross(before.direction).norm(), light.direction.dot(before.direction));
    CHECK(tilt <= 0.4 + 1e-9);
    widest = std::max(widest, tilt), brightest = std::max(brightest, light.ambient);
  }
  CHECK(widest > 0.35);
  CHECK(brightest > 0.29);
}

TEST_CASE("each camera is moved on its own, within its ball and angle, and stays rigid") {
  Randomisation ranges;
  ranges.camera_position_m = 0.03, ranges.camera_rotation_rad = 0.1;
  double furthest = 0;
  for (int seed = 0; seed < 100; ++seed) {
    const Scene before = furnished(0), after = drawn(before, ranges, kKey.with(seed));
    for (std::size_t i = 0; i < 2; ++i) {
      const Transform& old = before.cameras[i].mount_from_camera;
      const Transform& moved = after.cameras[i].mount_from_camera;
      const double shift = (moved.translation() - old.translation()).norm();
      CHECK(shift <= 0.03 + 1e-12);
      furthest = std::max(furthest, shift);
      CHECK(angle_between(Quaternion(old.linear()), Quaternion(moved.linear())) <= 0.1 + 1e-9);
      CHECK((moved.linear() * moved.linear().transpose() - Matrix3::Identity()).norm() < 1e-12);
    }
    CHECK((after.cameras[0].mount_from_camera.translation() - after.cameras[1].mount_from_camera.translation()).norm() >
          1e-6);
  }
  CHECK(furthest > 0.028);
}

TEST_CASE("a mass factor scales inertia too, friction and damping follow their own") {
  Randomisation ranges;
  ranges.dynamics = {"cube1", "table"};
  ranges.mass = {2, 2}, ranges.friction = {0.5, 0.5}, ranges.damping = {3, 3};
  const Scene before = furnished(2), after = drawn(before, ranges);
  CHECK(part(after, "cube1").mass == 2 * part(before, "cube1").mass);
  CHECK(part(after, "cube1").inertia == 2 * part(before, "cube1").inertia);
  CHECK(part(after, "cube1").surface.friction == 0.5 * part(before, "cube1").surface.friction);
  CHECK(part(after, "table", 1).joint.damping == 9);
  CHECK(part(after, "cube2").mass == part(before, "cube2").mass);
  const std::size_t link = static_cast<std::size_t>(before.robot.arm[3]);
  CHECK(after.robot.body.parts[link].mass == before.robot.body.parts[link].mass);
  ranges.dynamics = {"*"};
  const Scene all = drawn(before, ranges);
  CHECK(part(all, "cube2").mass == 2 * part(before, "cube2").mass);
  CHECK(part(all, "table", 1).mass == part(before, "table", 1).mass);  // it stands fast
  CHECK(part(all, "table", 1).joint.damping == 9);
  CHECK(all.robot.body.parts[link].joint.damping == before.robot.body.parts[link].joint.damping);
  ranges.dynamics = {"robot"};
  const Scene robot = drawn(before, ranges);
  CHECK(robot.robot.body.parts[link].mass == 2 * before.robot.body.parts[link].mass);
  CHECK(robot.robot.body.parts[link].joint.damping == 3 * before.robot.body.parts[link].joint.damping);
}

TEST_CASE("factors fill their range, and two things draw different ones") {
  Randomisation ranges;
  ranges.dynamics = {"*"}, ranges.mass = {0.5, 1.5};
  double low = 9, high = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const Scene scene = drawn(furnished(2), ranges, kKey.with(seed));
    const double one = part(scene, "cube1").mass / 0.1, two = part(scene, "cube2").mass / 0.1;
    CHECK(one != two);
    low = std::min({low, one, two}), high = std::max({high, one, two});
  }
  CHECK((low >= 0.5 - 1e-12 && low < 0.52));
  CHECK((high < 1.5 && high > 1.48));
}

TEST_CASE("names that the scene does not have, and ranges that are none, are errors that change nothing") {
  using Catch::Contains;
  Randomisation ranges;
  ranges.looks = {"tabel"};
  CHECK_THAT(complaint(ranges), Contains("randomise.looks") && Contains("did you mean 'table'"));
  ranges = {}, ranges.dynamics = {"cube1", ""};
  CHECK_THAT(complaint(ranges), Contains("randomise.dynamics"));
  ranges = {}, ranges.looks = {"*"}, ranges.textures = {"cheker"};
  CHECK_THAT(complaint(ranges), Contains("did you mean 'checker'"));
  for (const Range& bad : {Range{2, 1}, Range{0, 1}, Range{-1, 1}, Range{NAN, 1}, Range{1, INFINITY}}) {
    ranges = {}, ranges.dynamics = {"*"}, ranges.mass = bad;
    CHECK_THAT(complaint(ranges), Contains("randomise.mass"));
  }
  ranges = {}, ranges.camera_position_m = -0.1;
  CHECK_THAT(complaint(ranges), Contains("randomise.camera_position_m"));
  ranges = {}, ranges.light_direction_rad = NAN;
  CHECK_THAT(complaint(ranges), Contains("randomise.light_direction_rad"));
}
