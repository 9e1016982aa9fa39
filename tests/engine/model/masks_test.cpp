#include "engine/model/masks.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "engine/base/error.h"
#include "tests/support/panda.h"

using namespace stampede;

namespace {

// The table is a fixture; a chest with a drawer is a task's own; a patch on the table shows.
Scene world_scene(int cubes, bool with_chest) {
  Scene scene = table_scene(cubes);
  scene.bodies[0].fixture = true;
  if (with_chest) {
    Body chest = scene.bodies[0];
    chest.name = "chest", chest.fixture = false;
    Part drawer = chest.parts[0];
    drawer.name = "drawer", drawer.parent = 0, drawer.joint.kind = JointKind::slider;
    chest.parts.push_back(drawer);
    scene.bodies.push_back(chest);
    Object whole, part;
    whole.name = whole.body = "chest", whole.class_name = "chest_of_drawers", whole.type = "furniture";
    part.kind = ObjectKind::part, part.name = "chest.drawer", part.body = "chest", part.part = 1, part.type = "drawer";
    part.class_name = "chest_of_drawers";
    scene.objects.push_back(whole), scene.objects.push_back(part);
  }
  scene.regions.push_back({"patch", "table", 0, Transform::Identity(), {0.1, 0.1, 0.01}, true, {}, 0});
  scene.regions.push_back({"hidden", "table", 0, Transform::Identity(), {0.1, 0.1, 0.01}, false, {}, 0});
  return scene;
}

Scene numbered(Scene scene, const char* purpose) {
  number_masks(scene, RandomKey(purpose));
  return scene;
}

const MaskEntry& entry(const std::vector<MaskEntry>& key, const std::string& name) {
  const auto found = std::find_if(key.begin(), key.end(), [&](const MaskEntry& e) { return e.name == name; });
  REQUIRE(found != key.end());
  return *found;
}

// Links with something to see.
int drawn_links(const Scene& scene) {
  const auto& parts = scene.robot.body.parts;
  return static_cast<int>(
      std::count_if(parts.begin(), parts.end(), [](const Part& part) { return !part.shapes.empty(); }));
}

}  // namespace

TEST_CASE("robot and fixtures have the same numbers in each task of a world, whatever the seed") {
  const auto few = mask_key(numbered(world_scene(1, false), "a")), many = mask_key(numbered(world_scene(7, true), "b"));
  int same = 0;
  for (const MaskEntry& one : few) {
    if (!one.name.starts_with("panda.") && one.name != "table") continue;
    ++same;
    CHECK(entry(many, one.name).instance == one.instance);
  }
  CHECK(same == drawn_links(table_scene(0)) + 1);
  CHECK(entry(few, "panda.link0").instance == 1);
}

TEST_CASE("the numbers of everything else depend on the key, and on it alone") {
  std::set<int> numbers;
  for (int seed = 0; seed < 60; ++seed) {
    Scene scene = world_scene(5, false), again = scene;
    number_masks(scene, RandomKey("episode").with(seed));
    number_masks(again, RandomKey("episode").with(seed));
    CHECK(scene.bodies[1].parts[0].instance == again.bodies[1].parts[0].instance);
    numbers.insert(scene.bodies[1].parts[0].instance);
  }
  CHECK(numbers.size() == 6);  // five cubes and the patch: each number comes up (missing one: 6 (5/6)^60 = 1e-4)
}

TEST_CASE("the key has each part and region that can be seen once, only links without shapes leave gaps") {
  const Scene scene = numbered(world_scene(3, true), "key");
  const auto key = mask_key(scene);
  CHECK(static_cast<int>(key.size()) == drawn_links(scene) + 1 + 3 + 2 + 1);
  CHECK(key.back().instance == static_cast<int>(scene.robot.body.parts.size()) + 1 + 3 + 2 + 1);
  for (std::size_t i = 1; i < key.size(); ++i) CHECK(key[i].instance > key[i - 1].instance);
  std::set<std::string> names;
  for (const MaskEntry& e : key) names.insert(e.name);
  CHECK(names.size() == key.size());
  CHECK(names.count("hidden") == 0);
  CHECK(scene.regions[1].instance == 0);
  CHECK(entry(key, "patch").instance == scene.regions[0].instance);
}

TEST_CASE("what is seen through or not at all has no number, an older scene keeps those it has") {
  Scene scene = world_scene(2, true);
  scene.regions[0].colour.alpha = 0.3;
  Body& chest = scene.bodies.back();
  for (Shape& shape : chest.parts[1].shapes) shape.visible = false;
  number_masks(scene, RandomKey("glass"));
  CHECK(scene.regions[0].instance == 0);
  CHECK(chest.parts[1].instance == 0);
  CHECK(chest.parts[0].instance > 0);
  std::set<std::string> names;
  for (const MaskEntry& e : mask_key(scene)) names.insert(e.name);
  CHECK(names.count("patch") + names.count("chest.drawer") == 0);
  scene.regions[0].instance = 40;
  CHECK(entry(mask_key(scene), "patch").instance == 40);
}

TEST_CASE("classes are sorted, counted from 1, and tell a drawer from its chest and the hand from the arm") {
  const Scene scene = numbered(world_scene(2, true), "classes");
  CHECK(std::is_sorted(scene.classes.begin(), scene.classes.end()));
  const auto key = mask_key(scene);
  for (const MaskEntry& e : key) CHECK(scene.classes.at(static_cast<std::size_t>(e.semantic - 1)) == e.class_name);
  CHECK(entry(key, "chest").class_name == "chest_of_drawers");
  CHECK(entry(key, "chest.drawer").class_name == "drawer");
  CHECK(entry(key, "chest.drawer").object == "chest.drawer");
  CHECK(entry(key, "panda.link3").class_name == "panda");
  CHECK(entry(key, "panda.link3").object == "panda");
  CHECK(entry(key, "panda.left_finger").class_name == "hand");
  CHECK(entry(key, "panda.left_finger").object == "panda.hand");
  CHECK(entry(key, "cube1").semantic == entry(key, "cube2").semantic);
  CHECK(entry(key, "cube1").instance != entry(key, "cube2").instance);
}

TEST_CASE("classes that are given stay, one that is left out is an error, as is a scene without numbers") {
  Scene scene = world_scene(1, false);
  CHECK_THROWS_AS(mask_key(scene), Error);
  scene.classes = {"zebra", "cube", "hand", "panda", "region", "table"};
  number_masks(scene, RandomKey("given"));
  CHECK(entry(mask_key(scene), "cube1").semantic == 2);
  scene.classes.pop_back();
  CHECK_THROWS_AS(mask_key(scene), Error);
}
