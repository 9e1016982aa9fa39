#include <catch2/catch.hpp>
#include <lua.hpp>

#include "scripting/runtime/evaluate.h"

using namespace stampede;

namespace {

// The value of a Lua expression, drawn by `key`; v = { x = 2 }.
Value of(const std::string& expression, std::int64_t key = 0, const std::string& path = "field") {
  const std::unique_ptr<lua_State, void (*)(lua_State*)> state(luaL_newstate(), lua_close);
  const std::string chunk = "return { x = 2 }, " + expression;
  REQUIRE(luaL_loadstring(state.get(), chunk.c_str()) == LUA_OK);
  lua_call(state.get(), 0, 2);
  return read_value(state.get(), 2, {RandomKey("test").with(key), 1, "file.lua", {}}, path);
}

std::string one_of_ten() { return "{ tag = 'one_of', values = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 } }"; }

}  // namespace

TEST_CASE("plain values, lists, names and functions of the variation") {
  const Value value = of("{ 'cube', count = 4, size = function(v) return { v.x, 0.5, 1 } end, on = true }");
  CHECK(value.items[0].as_text() == "cube");
  CHECK(value["count"].integer);
  CHECK(value["size"].as_vector() == Vector3(2, 0.5, 1));
  CHECK(value["on"].as_boolean());
  CHECK_FALSE(value["absent"].present());
  CHECK(value.number_or("absent", 3) == 3.0);
}

TEST_CASE("a draw depends on key and path only") {
  const double first = of(one_of_ten(), 1, "a").as_number();
  CHECK(of(one_of_ten(), 1, "a").as_number() == first);
  CHECK(of("{ 1, a = " + one_of_ten() + " }", 1, "")["a"].as_number() == first);  // whatever stands beside it
  bool by_key = false, by_path = false;
  for (int i = 2; i < 12; ++i) {
    by_key |= of(one_of_ten(), i, "a").as_number() != first;
    by_path |= of(one_of_ten(), 1, "a" + std::to_string(i)).as_number() != first;
  }
  CHECK(by_key);
  CHECK(by_path);
}

TEST_CASE("one_of is fair, between stays between, sample_of draws without putting back") {
  std::vector<int> count(11);
  for (int i = 0; i < 2000; ++i) ++count[static_cast<std::size_t>(of(one_of_ten(), i).as_number())];
  for (std::size_t k = 1; k <= 10; ++k) CHECK(std::abs(count[k] - 200) < 5 * 14);  // 5 sigma of a binomial
  for (int i = 0; i < 100; ++i) {
    const double x = of("{ tag = 'between', low = -1, high = 2 }", i).as_number();
    CHECK((x >= -1 && x < 2));
    const Value all = of("{ tag = 'sample_of', values = { 1, 2, 3 }, n = 3 }", i);
    CHECK(all.items[0].number + all.items[1].number + all.items[2].number == 6.0);
    CHECK(all.items[0].number * all.items[1].number * all.items[2].number == 6.0);
  }
}

TEST_CASE("mistakes name the place and what was expected there") {
  CHECK_THROWS_WITH(of("{ at = { 1, 2 } }")["at"].as_vector(),
                    Catch::Contains("file.lua: field.at") && Catch::Contains("three numbers"));
  CHECK_THROWS_WITH(of("{ at = 0 / 0 }"), Catch::Contains("field.at") && Catch::Contains("finite"));
  CHECK_THROWS_WITH(of("(function() local t = {} t.t = t return t end)()"), Catch::Contains("a table hold itself"));
  CHECK_THROWS_WITH(of("{ tag = 'sample_of', values = { 1 }, n = 2 }"), Catch::Contains("2 of 1"));
}

TEST_CASE("poses are written as a position and one way of turning") {
  const Transform pose = transform_from(of("{ at = { 1, 2, 3 }, yaw = 1.5707963267948966 }"));
  CHECK((pose * Vector3::UnitX() - Vector3(1, 3, 3)).norm() < 1e-12);
  const Transform turned = transform_from(of("{ quaternion = { 0, 0, 2, 2 } }"));  // normalised
  CHECK((turned * Vector3::UnitX() - Vector3::UnitY()).norm() < 1e-12);
}
