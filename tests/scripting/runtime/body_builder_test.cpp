#include "scripting/runtime/body_builder.h"

#include <catch2/catch.hpp>
#include <functional>
#include <lua.hpp>
#include <memory>
#include <numbers>

#include "engine/geometry/hull.h"
#include "scripting/runtime/evaluate.h"

using namespace stampede;

namespace {

// An object named `thing` from the fields of a Lua table; shapes are tables with `shape`.
BuiltObject built(const std::string& table) {
  const std::unique_ptr<lua_State, void (*)(lua_State*)> state(luaL_newstate(), lua_close);
  REQUIRE(luaL_loadstring(state.get(), ("return " + table).c_str()) == LUA_OK);
  lua_call(state.get(), 0, 1);
  const Value fields = read_value(state.get(), 1, {RandomKey("test"), 0, "objects/thing.lua", {}}, "");
  return build_object({"thing", "thing", fields, {}}, {{"red", {1, 0, 0, 1}}});
}

std::vector<Shape> shapes_that(const BuiltObject& object, const std::function<bool(const Shape&)>& test) {
  std::vector<Shape> result;
  for (const Shape& shape : object.body->parts[0].shapes)
    if (test(shape)) result.push_back(shape);
  return result;
}
std::vector<Shape> colliding(const BuiltObject& object) {
  return shapes_that(object, [](const Shape& shape) { return shape.collides; });
}

double volume(const Shape& shape) { return mass_properties(*convex_hull(shape.points)).volume; }

}  // namespace

TEST_CASE("movable things are free, all others stand still, and fixed decides") {
  const std::string box = "shape = { shape = 'box', 1, 1, 1 }, mass = 1";
  CHECK(built("{ traits = { 'movable' }, " + box + " }").body->free);
  CHECK_FALSE(built("{ traits = { 'surface' }, " + box + " }").body->free);
  CHECK_FALSE(built("{ traits = { 'movable' }, fixed = true, " + box + " }").body->free);
  CHECK_THROWS_WITH(built("{ traits = { 'movable' }, shape = { shape = 'box', 1, 1, 1 } }"),
                    Catch::Contains("needs a mass"));
}

TEST_CASE("a lathe is one convex band between two rings, or wedges where it has a wall") {
  const auto solid = built("{ shape = { shape = 'lathe', { 0.1, 0 }, { 0.1, 0.2 }, { 0.05, 0.3 }, segments = 64 } }");
  const std::vector<Shape> bands = colliding(solid);
  REQUIRE(bands.size() == 2);
  // A regular 64-gon of radius r has the area 32 r^2 sin(2 pi / 64).
  const double area = 32 * 0.01 * std::sin(2 * std::numbers::pi / 64);
  CHECK(volume(bands[0]) == Approx(area * 0.2).epsilon(1e-9));
  CHECK(volume(bands[1]) == Approx(area * 0.1 * (1 + 0.5 + 0.25) / 3).epsilon(1e-9));  // a frustum

  const auto cup = built("{ shape = { shape = 'lathe', { 0.1, 0 }, { 0.1, 0.2 }, wall = 0.02, segments = 16 } }");
  REQUIRE(colliding(cup).size() == 16);
  double sum = 0;
  for (const Shape& wedge : colliding(cup)) sum += volume(wedge);
  CHECK(sum == Approx(8 * (0.01 - 0.0064) * std::sin(2 * std::numbers::pi / 16) * 0.2).epsilon(1e-9));
}

TEST_CASE("the size of an object fills a shape without numbers") {
  const auto cube = built("{ size = { 1, 2, 3 }, shape = { shape = 'box' } }");
  CHECK(cube.body->parts[0].shapes[0].size == Vector3(1, 2, 3));
  CHECK(cube.objects[0].size == Vector3(1, 2, 3));
}

TEST_CASE("an object that is a region has no body") {
  const auto zone =
      built("{ at = { 1, 2, 3 }, region = { size = { 0.1, 0.2, 0.3 }, visible = true }, colour = 'red' }");
  CHECK_FALSE(zone.body.has_value());
  REQUIRE(zone.regions.size() == 1);
  CHECK(zone.regions[0].part_from_region.translation() == Vector3(1, 2, 3));
  CHECK(zone.regions[0].visible);
  CHECK(zone.objects[0].attributes.at("colour") == "red");
  CHECK(zone.placed);
}

TEST_CASE("a tool's tip is a region without volume on the tool, or next to it") {
  const std::string stick = "traits = { 'movable' }, mass = 1, shape = { shape = 'box', 0.02, 0.02, 0.30 }";
  const auto tool = built("{ tip = { at = { 0, 0, -0.153 }, rpy = { 0, 0, 0 } }, " + stick + " }");
  REQUIRE(tool.regions.size() == 1);
  CHECK(tool.regions[0].name == "thing.tip");
  CHECK(tool.regions[0].size == Vector3::Zero());
  CHECK(tool.regions[0].part_from_region.translation() == Vector3(0, 0, -0.153));
  REQUIRE(tool.objects.size() == 2);
  CHECK(tool.objects[1].kind == ObjectKind::region);
  CHECK(tool.objects[1].attributes.at("part_of") == "thing");
  CHECK_THROWS_WITH(built("{ tip = { at = { 0, 0, -0.18 } }, " + stick + " }"),
                    Catch::Contains("objects/thing.lua: tip") && Catch::Contains("the tip is 30 mm outside the tool") &&
                        Catch::Contains("its shapes reach from { -0.01, -0.01, -0.15 } to { 0.01, 0.01, 0.15 } m"));
}

TEST_CASE("mistakes of an object name the field") {
  const std::string part = "shapes = { { shape = 'box', 1, 1, 1 } }, mass = 1";
  CHECK_THROWS_WITH(built("{ shape = { shape = 'box', 1, 1 } }"), Catch::Contains("without its size"));
  CHECK_THROWS_WITH(built("{ shape = { shape = 'box', 1, 1, -1 } }"), Catch::Contains("must be positive"));
  CHECK_THROWS_WITH(built("{ shape = { shape = 'ring', 1 } }"), Catch::Contains("this is no shape"));
  CHECK_THROWS_WITH(built("{ colour = 'reed', shape = { shape = 'sphere', 1 } }"), Catch::Contains("no colour 'reed'"));
  CHECK_THROWS_WITH(built("{ parts = { door = { hinge = {}, " + part + " } } }"), Catch::Contains("parts.door.hinge"));
  CHECK_THROWS_WITH(built("{ parts = { door = { parent = 'wall', hinge = { range = { 0, 1 } }, " + part + " } } }"),
                    Catch::Contains("no part 'wall'"));
  CHECK_THROWS_WITH(built("{ parts = { a = { hinge = { range = { 0, 1 } } } } }"), Catch::Contains("needs a mass"));
  CHECK_THROWS_WITH(built("{ joints = { lid = 1 }, shape = { shape = 'sphere', 1 } }"),
                    Catch::Contains("no part 'lid'"));
  CHECK_THROWS_WITH(built("{ joints = { a = 2 }, parts = { a = { hinge = { range = { 0, 1 } }, " + part + " } } }"),
                    Catch::Contains("within its range"));
}
