// A sentence names a thing so that a person who sees the first picture finds it.
#include "engine/start/language.h"

#include <algorithm>
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
  CHECK(phrases(scene, 2) == Words{"right cube", "left cube"});  // without a camera, for who looks at the robot

  Camera front;  // looks at the robot, upside up
  front.name = "front";
  front.mount_from_camera = looking_at({2, 0, 0.5}, {0, 0, 0.5});
  scene.cameras = {front};
  CHECK(phrases(scene, 2) == Words{"right cube", "left cube"});

  Scene five = table_scene(5);  // at -0.2, -0.1 … 0.2
  CHECK(phrases(five, 5) == Words{"leftmost cube", "second cube from the left", "third cube from the left",
                                  "fourth cube from the left", "rightmost cube"});
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

namespace {

void add_region(Scene& scene, const std::string& name, const std::string& type = "region") {
  Object region;
  region.name = name;
  region.kind = ObjectKind::region;
  region.type = type;
  region.body = name.substr(0, name.find('.'));
  region.part = 0;
  scene.objects.push_back(region);
  std::sort(scene.objects.begin(), scene.objects.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
}

}  // namespace

TEST_CASE("numbered places of a thing are called as a person would") {
  Scene scene = table_scene(1);
  for (const char* name : {"table.base1", "table.base2", "table.base3", "table.d7", "table.slot", "table.row12"})
    add_region(scene, name);
  add_region(scene, "table.black_square1", "black_square");
  add_region(scene, "table.black_square4", "black_square");
  CHECK(phrase(scene, "table.base3") == "third base place of the table");
  CHECK(phrase(scene, "table.base1") == "first base place of the table");
  CHECK(phrase(scene, "table.black_square4") == "fourth black square of the table");
  CHECK(phrase(scene, "table.d7") == "square d7 of the table");
  CHECK(phrase(scene, "table.slot") == "slot of the table");
  CHECK(phrase(scene, "table.row12") == "row 12 of the table");  // the only one
  add_region(scene, "table.top1");
  CHECK(phrase(scene, "table.top1") == "top place of the table");
}

TEST_CASE("sizes stand before colours, numbers of kinds are words, and no word is said twice") {
  Scene scene = table_scene(1);
  const auto called = [&](const char* class_name, const char* colour, const std::string& part = {}) {
    Scene named = scene;
    for (Object& object : named.objects)
      if (object.name == "cube1") {
        object.class_name = class_name;
        object.attributes.clear();
        if (*colour != 0) object.attributes["colour"] = colour;
      }
    if (!part.empty()) add_region(named, "cube1." + part);
    return phrase(named, part.empty() ? "cube1" : "cube1." + part);
  };
  CHECK(called("wide_block", "red") == "wide red block");
  CHECK(called("push_button", "red") == "red push button");
  CHECK(called("numbered_block_2", "") == "numbered block two");
  CHECK(called("square_peg", "olive", "peg") == "square olive peg");
  CHECK(called("basin_tap", "", "left_tap") == "left tap of the basin");
  CHECK(called("chest", "", "drawer") == "drawer of the chest");
}

TEST_CASE("nothing is said of what is hidden, nor of a thing's own regions") {
  Scene scene = table_scene(2);
  add_region(scene, "table.inside");
  Domain domain;
  const auto declare = [&](const char* name, const char* label) {
    Predicate predicate;
    predicate.name = name;
    predicate.label = label;
    predicate.parameters = {{"a", "", {}}, {"b", "", {}}};
    domain.predicates.push_back(predicate);
  };
  declare("inside", "the {a} is inside the {b}");
  declare("on", "the {a} is on the {b}");
  declare("behind", "the {a} is behind the {b}");
  const Fact hides{"inside", {"cube1", "table.inside"}}, lies{"on", {"cube1", "table"}};
  const Fact open{"on", {"cube2", "table"}}, own{"behind", {"table.inside", "table"}};
  Predicate blocked;
  blocked.name = "blocked", blocked.label = "something is before the {a}", blocked.kind = PredicateKind::derived;
  blocked.parameters = {{"a", "", {}}};
  domain.predicates.push_back(blocked);
  const Facts made = {own, {"blocked", {"table.inside"}}, {"blocked", {"cube1"}}};
  CHECK(describe_world(made, domain, scene) == std::vector<std::string>{"something is before the left cube"});
  const Facts holds = {hides, lies, open, own};
  CHECK(mentionable(holds, {lies, open, own}, domain, scene) == Facts{open, own});
  CHECK(mentionable(holds, holds, domain, scene) == holds);  // seen, or told
  CHECK(describe_world(holds, domain, scene).size() == 3);
  for (const std::string& sentence : describe_world(holds, domain, scene))
    CHECK(sentence.find("behind") == std::string::npos);
}
