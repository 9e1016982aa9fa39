// What a function could carry from one call to the next.
#include "scripting/runtime/kept_values.h"

#include <catch2/catch.hpp>
#include <lua.hpp>
#include <string>

#include "scripting/lua/sandbox.h"

using namespace stampede;

namespace {

enum class Trace { none, left, unknown };

// Of one call of the function that the chunk returns.
Trace call_once(const std::string& chunk) {
  Sandbox sandbox({}, {});
  sandbox.run(Sandbox::compile(chunk, "test.lua"), "test.lua", 1);
  lua_State* const state = sandbox.state();
  const auto before = kept_values(state);
  lua_pushvalue(state, -1);
  sandbox.call(0, 0);
  const auto after = kept_values(state);
  if (!before || !after) return Trace::unknown;
  return before == after ? Trace::none : Trace::left;
}

}  // namespace

TEST_CASE("a function leaves no trace, or one that is seen, or might leave one") {
  CHECK(call_once("return function() local t = { 1 }; t[1] = math.sqrt(2) end") == Trace::none);
  CHECK(call_once("local n, s = 3, 'x'; local function f() return n .. s end; return function() return f() end") ==
        Trace::none);
  CHECK(call_once("local function f(k) return k == 0 and 0 or f(k - 1) end; return function() return f(3) end") ==
        Trace::none);
  CHECK(call_once("local n = 0; return function() n = n + 1 end") == Trace::left);
  CHECK(call_once("local n = 0; local function f() n = n + 0.5 end; return function() f() end") == Trace::left);
  CHECK(call_once("local last; return function() last = 'x' end") == Trace::left);
  CHECK(call_once("local on = false; return function() on = true end") == Trace::left);
  CHECK(call_once("local f = function() end; return function() f = function() end end") == Trace::left);
  CHECK(call_once("local t = {}; return function() t[1] = 1 end") == Trace::unknown);
  CHECK(call_once("local t = {}; local function f() t[1] = 1 end; return function() f() end") == Trace::unknown);
}
