#include "scripting/runtime/pose_binding.h"

#include <catch2/catch.hpp>
#include <lua.hpp>
#include <memory>
#include <string>
#include <vector>

using namespace stampede;

namespace {

// The numbers that a Lua chunk returns.
std::vector<double> numbers(const std::string& chunk) {
  const std::unique_ptr<lua_State, void (*)(lua_State*)> state(luaL_newstate(), lua_close);
  register_poses(state.get());
  REQUIRE(luaL_loadstring(state.get(), chunk.c_str()) == LUA_OK);
  if (lua_pcall(state.get(), 0, LUA_MULTRET, 0) != LUA_OK) throw std::runtime_error(lua_tostring(state.get(), -1));
  std::vector<double> result;
  for (int i = 1; i <= lua_gettop(state.get()); ++i) result.push_back(lua_tonumber(state.get(), i));
  return result;
}

void check(const std::string& chunk, const std::vector<double>& expected) {
  const std::vector<double> found = numbers(chunk);
  INFO(chunk);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(expected[i]).margin(1e-12));
}

}  // namespace

TEST_CASE("a quarter turn about z takes the pose's own x to the world's y") {
  const std::string quarter = "local p = pose(1, 2, 3, 0, 0, 1.5707963267948966) ";
  check(quarter + "return p:position()", {1, 2, 3});
  check(quarter + "return p:offset(0.5, 0, 0):position()", {1.5, 2, 3});  // world's axes
  check(quarter + "return p:along(0.5, 0, 0):position()", {1, 2.5, 3});   // its own
  check(quarter + "return (p * pose(0.5, 0, 0)):position()", {1, 2.5, 3});
  check(quarter + "return p:with_position(7, 8, 9):rpy()", {0, 0, 1.5707963267948966});
  check(quarter + "return (p:inverse() * p):position()", {0, 0, 0});
  check(quarter + "return p:quaternion()", {0, 0, std::sqrt(0.5), std::sqrt(0.5)});
}

TEST_CASE("rotated turns about the pose's own axes, turned about the world's z") {
  const std::string down = "local p = pose(0, 0, 0, 3.141592653589793, 0, 0) ";  // z points down
  check(down + "return (p:rotated(0, 0, 0.5) * pose(1, 0, 0)):position()", {std::cos(0.5), -std::sin(0.5), 0});
  check(down + "return (p:turned(0.5) * pose(1, 0, 0)):position()", {std::cos(0.5), std::sin(0.5), 0});
}

TEST_CASE("angles survive the round trip, also at the pole") {
  for (const double pitch : {-1.2, 0.0, 0.7}) {
    check("return pose(0, 0, 0, 0.3, " + std::to_string(pitch) + ", -2):rpy()", {0.3, pitch, -2});
  }
  // At the pole roll and yaw are one angle: the rotation is the same, the numbers are not.
  check(
      "local p = pose(0, 0, 0, 0.3, 1.5707963267948966, 1) local q = pose(0, 0, 0, p:rpy()) "
      "return (p:inverse() * q):quaternion()",
      {0, 0, 0, 1});
}

TEST_CASE("what is no pose is told by its argument") {
  CHECK_THROWS_WITH(numbers("return pose(1, 2, 3):times(4)"), Catch::Contains("stampede.pose expected"));
  CHECK_THROWS_WITH(numbers("return pose('here')"), Catch::Contains("number expected"));
}
