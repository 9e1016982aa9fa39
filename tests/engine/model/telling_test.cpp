#include "engine/model/telling.h"

#include <catch2/catch.hpp>

#include "engine/model/randomise.h"
#include "tests/support/panda.h"

using namespace stampede;

namespace {

constexpr int kSeeds = 40;

Body& body(Scene& scene, const std::string& name) {
  return scene.bodies.at(static_cast<std::size_t>(scene.body_index(name)));
}

Object& object(Scene& scene, const std::string& name) {
  return *std::find_if(scene.objects.begin(), scene.objects.end(), [&](const Object& o) { return o.name == name; });
}

// Cubes without colours that anybody speaks of, all grey.
Scene cubes(int count) {
  Scene scene = table_scene(count);
  for (Object& one : scene.objects) one.attributes.clear();
  for (Body& one : scene.bodies)
    for (Part& part : one.parts)
      for (Shape& shape : part.shapes) shape.colour = {0.5, 0.5, 0.5, 1};
  return scene;
}

Scene drawn(Scene scene, int seed, const std::vector<std::string>& sentences = {}) {
  randomise(scene, default_randomisation(), RandomKey("telling").with(seed), sentences);
  return scene;
}

std::vector<double> look(const Scene& scene, const std::string& name, std::size_t shape = 0) {
  const Shape& s = scene.bodies.at(static_cast<std::size_t>(scene.body_index(name))).parts[0].shapes.at(shape);
  return {s.colour.red, s.colour.green, s.colour.blue, s.texture.empty() ? 0.0 : 1.0};
}

bool keeps(const Scene& before, const std::string& name, const std::vector<std::string>& sentences = {}) {
  bool kept = true;
  for (int seed = 0; seed < kSeeds; ++seed)
    kept = kept && look(drawn(before, seed, sentences), name) == look(before, name);
  return kept;
}

}  // namespace

TEST_CASE("things of no name, fact or sentence that tells how they look may look otherwise") {
  const Scene before = cubes(3);
  for (const char* name : {"table", "cube1", "cube3"}) CHECK_FALSE(keeps(before, name));
}

TEST_CASE("a name that speaks of a look keeps it: of a thing, of its kind, of a place on it") {
  Scene before = cubes(3);
  object(before, "cube1").class_name = "red_cube";
  CHECK(keeps(before, "cube1"));
  Region place;
  place.name = "cube3.wooden_side7", place.body = "cube3";
  before.regions.push_back(place);
  Object named;
  named.name = place.name, named.kind = ObjectKind::region;
  before.objects.push_back(named);
  CHECK(keeps(before, "cube3"));
  CHECK_FALSE(keeps(before, "table"));
}

TEST_CASE("a fact about a thing keeps its look, where it belongs does not") {
  Scene before = cubes(2);
  object(before, "cube1").attributes["digit"] = "one";
  object(before, "cube2").attributes["part_of"] = "table";
  CHECK(keeps(before, "cube1"));
  CHECK_FALSE(keeps(before, "cube2"));
}

TEST_CASE("things of one type that only their looks tell apart keep them") {
  Scene before = cubes(4);
  for (Shape& shape : body(before, "cube1").parts[0].shapes) shape.colour = {0.1, 0.6, 0.2, 1};
  for (const char* name : {"cube1", "cube2", "cube3"}) CHECK(keeps(before, name));
  Scene tins = cubes(2);
  object(tins, "cube1").class_name = "soup_tin", object(tins, "cube2").class_name = "tuna_tin";
  for (const char* name : {"cube1", "cube2"}) CHECK(keeps(tins, name));
}

TEST_CASE(
    "what a sentence gives a look keeps it, and where nobody knows what is meant, all that the task brings does") {
  Scene before = cubes(2);
  body(before, "table").fixture = true;
  object(before, "cube1").class_name = "die", object(before, "cube1").type = "toy";
  object(before, "cube2").class_name = "basketball", object(before, "cube2").type = "ball";
  CHECK(keeps(before, "cube1", {"roll the old grey die"}));
  CHECK_FALSE(keeps(before, "cube2", {"roll the old grey die"}));
  CHECK(keeps(before, "cube2", {"Throw the orange balls."}));
  for (const char* name : {"cube1", "cube2"}) {
    CHECK(keeps(before, name, {"take the thing with the red stripe"}));
    CHECK_FALSE(keeps(before, name, {"take the thing"}));
  }
  CHECK_FALSE(keeps(before, "table", {"take the thing with the red stripe"}));
  object(before, "cube2").attributes["colour"] = "red";
  CHECK_FALSE(keeps(before, "cube1", {"take the thing that is red"}));  // it is known which
}

TEST_CASE("marks stay, and what they are on stands out from them") {
  Scene before = cubes(1);
  Part& part = body(before, "cube1").parts[0];
  Shape mark = part.shapes[0];
  mark.kind = ShapeKind::box, mark.size = {0.01, 0.01, 0.001};
  for (const Colour& colour : {Colour{0.8, 0.1, 0.1, 1}, Colour{0.1, 0.2, 0.8, 1}})
    mark.colour = colour, part.shapes.push_back(mark);
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Scene after = drawn(before, seed);
    for (const std::size_t i : {1u, 2u}) {
      CHECK(look(after, "cube1", i) == look(before, "cube1", i));
      const Shape& ground = after.bodies.at(static_cast<std::size_t>(after.body_index("cube1"))).parts[0].shapes[0];
      std::vector<Colour> seen{ground.colour};
      if (const auto texture = after.textures.find(ground.texture); texture != after.textures.end())
        seen = {texture->second.first, texture->second.second};
      for (const Colour& colour : seen) CHECK(difference(colour, part.shapes[i].colour) >= 25);
    }
  }
  CHECK_FALSE(keeps(before, "cube1"));
}

TEST_CASE("shapes that show a fact keep their looks, under every sort of draw") {
  Scene before = cubes(1);
  Part& part = body(before, "cube1").parts[0];
  part.shapes.push_back(part.shapes[0]);
  part.shapes[0].shown_by = part.shapes[1].shown_by = {"pressed", "cube1"};
  part.shapes[1].shown_without = true, part.shapes[1].colour = {1, 0.9, 0.5, 1};
  CHECK(keeps(before, "cube1"));
  for (int seed = 0; seed < kSeeds; ++seed) CHECK(look(drawn(before, seed), "cube1", 1) == look(before, "cube1", 1));
}

TEST_CASE("the difference of colours is CIE 1976") {
  CHECK(difference({1, 1, 1, 1}, {0, 0, 0, 1}) == Approx(100).margin(0.05));
  CHECK(difference({1, 0, 0, 1}, {0, 1, 0, 1}) == Approx(170.6).margin(0.3));
  CHECK(difference({0.3, 0.4, 0.5, 1}, {0.3, 0.4, 0.5, 1}) == 0);
}
