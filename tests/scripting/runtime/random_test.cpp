// What rng draws for scripts.
#include <catch2/catch.hpp>
#include <lua.hpp>

#include "scripting/runtime/script_state.h"
#include "scripting/runtime/view_binding.h"
#include "scripts_fixture.h"

using namespace stampede;

namespace {

struct Drawing {
  ScriptState script{test::small_library(), "panda.hand"};

  // What a chunk returns of rng.
  lua_Integer integer(const std::string& source) {
    lua_Integer drawn = 0;
    const std::string bytecode = Sandbox::compile("return function(rng) return " + source + " end", "test.lua");
    script.sandbox().run(bytecode, "test.lua", 1);
    push_random(script.lua(), RandomKey("test"));
    script.sandbox().call(1, 1);
    drawn = lua_tointeger(script.lua(), -1);
    lua_pop(script.lua(), 1);
    return drawn;
  }
};

}  // namespace

TEST_CASE_METHOD(Drawing, "whole numbers are drawn from any range, the widest too") {
  const lua_Integer any = integer("rng:integer(math.mininteger, math.maxinteger)");
  CHECK(any != integer("rng:uniform() and rng:integer(math.mininteger, math.maxinteger)"));
  CHECK(integer("rng:integer(math.maxinteger, math.maxinteger)") == LUA_MAXINTEGER);
  CHECK(integer("rng:integer(math.mininteger, math.mininteger)") == LUA_MININTEGER);
  for (int i = 0; i < 20; ++i) {
    const std::string draws = "(function() for i = 1, " + std::to_string(i) + " do rng:uniform() end end)() or ";
    CHECK(integer(draws + "rng:integer(-1, math.maxinteger)") >= -1);
    CHECK(integer(draws + "rng:integer(math.mininteger, 0)") <= 0);
    const lua_Integer small = integer(draws + "rng:integer(-2, 2)");
    CHECK((small >= -2 && small <= 2));
  }
  CHECK_THROWS_WITH(integer("rng:integer(2, 1)"), Catch::Contains("empty range"));
}
