// What untrusted scripts can and cannot do.
#include "scripting/lua/sandbox.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <ctime>
#include <lua.hpp>
#include <thread>

#include "engine/base/error.h"
#include "engine/base/stopping.h"
#include "scripting/lua/binding.h"

using namespace stampede;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

constexpr SandboxLimits kSmall{200'000, 4u << 20};

struct Fixture {
  Sandbox sandbox{kSmall, {}};
  std::string run(const std::string& source) {
    sandbox.run(Sandbox::compile(source, "test.lua"), "test.lua", 1);
    const std::string result = luaL_tolstring(sandbox.state(), -1, nullptr);
    lua_pop(sandbox.state(), 2);
    return result;
  }
  std::string fault(const std::string& source) {
    try {
      run(source);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
};

}  // namespace

TEST_CASE("what is not on the whitelist is not there") {
  for (const char* name : {"io",       "os",      "debug",     "load",         "loadstring",   "dofile",
                           "loadfile", "next",    "rawset",    "rawget",       "rawequal",     "rawlen",
                           "pcall",    "xpcall",  "coroutine", "setmetatable", "getmetatable", "collectgarbage",
                           "print",    "package", "_G",        "_VERSION",     "utf8",         "warn"}) {
    INFO(name);
    Fixture fixture;
    const std::string text = fixture.fault(std::string("return ") + name);
    CHECK(text.find("test.lua:1: unknown name '" + std::string(name) + "'") == 0);
  }
  Fixture fixture;
  CHECK(fixture.fault("os.execute('true')").find("unknown name 'os'") != std::string::npos);
  for (const char* field : {"string.gsub", "string.gmatch", "string.match", "string.dump", "string.pack", "math.random",
                            "math.randomseed", "table.move", "table.pack"}) {
    INFO(field);
    CHECK(fixture.fault(std::string("return ") + field).find("test.lua:1: there is no '" + std::string(field) + "'") ==
          0);
  }
  CHECK(fixture.fault("return math.random(3)").find("': between(low, high), one_of") != std::string::npos);
  CHECK(fixture.fault("return ('a'):gsub('a', 'b')").find("'string.gsub': there are no patterns") != std::string::npos);
  CHECK(fixture.fault("return math.sine(1)").find("there is no 'math.sine': did you mean 'sin'?") != std::string::npos);
  CHECK(fixture.fault("print('x')").find("unknown name 'print': a script prints nothing") != std::string::npos);
  CHECK(fixture.fault("return ipair").find("unknown name 'ipair': did you mean 'ipairs'?") != std::string::npos);
}

TEST_CASE("globals and libraries cannot be changed") {
  Fixture fixture;
  CHECK(fixture.fault("x = 1").find("test.lua:1: 'x' is assigned without local") == 0);
  CHECK(fixture.fault("string.rep = nil").find("'rep' cannot be changed") != std::string::npos);
  CHECK(fixture.fault("table.sort = nil").find("'sort' cannot be changed") != std::string::npos);
  CHECK(fixture.fault("_ENV.pairs = 1").find("'pairs' is assigned") != std::string::npos);
}

TEST_CASE("pairs goes through keys in order: whole numbers, then texts") {
  Fixture fixture;
  const std::string body =
      "local s = '' for k, v in pairs(t) do s = s .. tostring(k) .. '=' .. tostring(v) .. ' ' end return s";
  CHECK(fixture.run("local t = { b = 1, a = 2, [10] = 3, [-1] = 4, 7 } " + body) == "-1=4 1=7 10=3 a=2 b=1 ");
  // What is removed while it runs is passed over.
  CHECK(fixture.run(
            "local t = { a = 1, b = 2, c = 3 } local n = 0 for k in pairs(t) do t.b = nil n = n + 1 end return n") ==
        "2");
  CHECK(fixture.fault("for k in pairs { [true] = 1 } do end").find("keys are names and whole numbers") !=
        std::string::npos);
}

TEST_CASE("no address leaks") {
  Fixture fixture;
  CHECK(fixture.run("return tostring({}) .. ' ' .. tostring(function() end)") == "table function");
  CHECK(fixture.run("return string.format('%s %5.2f %s', {}, 1.5, true)") == "table  1.50 true");
  CHECK(fixture.fault("return string.format('%p', {})").find("no %p") != std::string::npos);
  CHECK(fixture.fault("error({})").find("0x") == std::string::npos);
}

TEST_CASE("strings and tables keep their bounds") {
  Fixture fixture;
  CHECK(fixture.run("return ('ab'):rep(3, '-')") == "ab-ab-ab");
  CHECK(fixture.fault("return ('x'):rep(1e9)").find("string.rep makes at most") != std::string::npos);
  CHECK(fixture.fault("return ('x'):rep(9007199254740993, 'yyyy')").find("at most") != std::string::npos);
  CHECK(fixture.run("local a, b = ('a.b'):find('.') return a + 10 * b") == "22");  // plain: no pattern
  CHECK(fixture.run("return ('abcabc'):find('c', 4)") == "6");
  CHECK(fixture.run("return ('abc'):find('z')") == "nil");
  CHECK(fixture.fault("return ('a'):find(('a'):rep(300))").find("at most 256") != std::string::npos);
  CHECK(fixture.fault("return table.unpack({}, 1, 1e8)").find("at most 10000") != std::string::npos);
  CHECK(fixture.run("local t = { 1, 2 } table.insert(t, 1, 0) table.insert(t, 3) return table.concat(t, ',')") ==
        "0,1,2,3");
  CHECK(fixture.run("local t = { 1, 2, 3 } local x = table.remove(t, 1) return x .. #t") == "12");
}

TEST_CASE("sort is stable and ends for every comparator") {
  Fixture fixture;
  const std::string show = " local s = '' for _, v in ipairs(t) do s = s .. v.k .. v.n end return s";
  CHECK(fixture.run("local t = { {k=2,n='a'}, {k=1,n='b'}, {k=2,n='c'}, {k=1,n='d'}, {k=0,n='e'} } "
                    "table.sort(t, function(a, b) return a.k < b.k end)" +
                    show) == "0e1b1d2a2c");
  CHECK(fixture.run("local t = { 3, 1, 2 } table.sort(t) return table.concat(t)") == "123");
  CHECK(fixture.run("local t = {} for i = 1, 50 do t[i] = i end table.sort(t, function() return true end) return #t") ==
        "50");
}

TEST_CASE("a runaway script is an error with its place, never a hang") {
  const char* const sources[] = {
      "while true do end",
      "local function f() return f() end return f()",
      "local t = {} for i = 1, 100 do t[i] = i end table.sort(t, function() while true do end end)",
      "local s = ('a'):rep(60000) while true do local n = s:find('b') end",
      "local s = ('a'):rep(60000) while true do s = s:reverse() end",
      "local t = {} for i = 1, 1000 do t[i] = i end while true do table.insert(t, 1, table.remove(t)) end",
      "for i = 1, 1e15 do local t = { i } end",
      "while true do local s = string.format('%s', ('a'):rep(60000)) end",
      "local s = ('0'):rep(60000) .. '65' while true do local x = math.floor(s) end",
      "local s = ('0'):rep(60000) .. '2' while true do local x = ('abc'):sub(s, s) end",
      "local s = ('0'):rep(60000) .. '2' while true do local x = select(s, 1, 2, 3) end",
  };
  for (const char* source : sources) {
    INFO(source);
    Fixture fixture;
    const std::string text = fixture.fault(source);
    CHECK(text.find("instruction budget is spent") != std::string::npos);
  }
  Fixture fixture;
  CHECK_THAT(fixture.fault("local x = 1\nwhile true do end"),
             Catch::StartsWith("test.lua:2: the script ran for too long"));
}

// A tenth of the usual budget must be spent within a tenth of the 10 s that nothing may take.
TEST_CASE("what costs time is charged for, whatever it is") {
  const char* const sources[] = {
      "local a, b = ('x'):rep(65000) .. 1, ('x'):rep(65000) .. 2 while true do local x = a < b end",
      "local a, b = ('x'):rep(65000) .. 1, ('x'):rep(65000) .. 1 while true do local x = a == b end",
      "local a, b = ('x'):rep(2000) .. 1, ('x'):rep(2000) .. 2 while true do local x = a < b end",
      "local s = ('9'):rep(200) while true do local x = tonumber(s) end",
      "local s = ('9'):rep(60000) while true do local x = tonumber(s) end",
      "local s = ('9'):rep(190) while true do local x = s + s end",
      "local s = ' ' .. ('0'):rep(60000) .. '5' while true do local x = s | 0 end",
      "local s = ('x'):rep(10000) while true do local x = s:byte(1, -1) end",
      "local t = {} for i = 1, 50 do t[('k'):rep(2000) .. i] = i end while true do for k in pairs(t) do end end",
  };
  for (const char* source : sources) {
    INFO(source);
    Sandbox sandbox({5'000'000, 64u << 20}, {});
    const std::clock_t start = std::clock();
    CHECK_THROWS_AS(sandbox.run(Sandbox::compile(source, "test.lua"), "test.lua", 0), Error);
    CHECK(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC < (kSanitized ? 10.0 : 1.0));
  }
}

TEST_CASE("a net of processor time lies under the budgets") {
  Sandbox sandbox({std::int64_t{1} << 50, 64u << 20, 0.2}, {});
  CHECK_THROWS_WITH(sandbox.run(Sandbox::compile("local x = 1\nwhile true do end", "test.lua"), "test.lua", 0),
                    Catch::StartsWith("test.lua:2: the script ran for too long"));
}

TEST_CASE("texts have no zero bytes, and long ones are no numbers") {
  Fixture fixture;
  for (const std::string& source :
       {std::string(R"(return "\0")"), std::string(R"(return 'a\000b')"), std::string(R"(return "\x00")"),
        std::string(R"(return "\u{000}")"), std::string("return 'a\0b'", 12)}) {
    INFO(source);
    CHECK_THAT(fixture.fault("\n" + source), Catch::StartsWith("test.lua:2: a text with a zero byte"));
  }
  CHECK(fixture.run(R"(return "\\0" .. "\10\u{00e9}" == "")") == "false");
  CHECK_THAT(fixture.fault("return string.char(65, 0)"), Catch::Contains("zero bytes"));
  CHECK_THAT(fixture.fault("return ('%c'):format(0)"), Catch::Contains("string.char"));
  CHECK(fixture.run("return string.char(72, 105)") == "Hi");
  CHECK(fixture.run("return table.concat({ ('abc'):byte(1, -1) }, ' ')") == "97 98 99");
  CHECK(fixture.run("return ('abc'):byte() .. ' ' .. ('abc'):byte(-1) .. ' ' .. select('#', ('abc'):byte(4))") ==
        "97 99 0");
  CHECK_THAT(fixture.fault("return ('x'):rep(20000):byte(1, -1)"), Catch::Contains("10000"));
  CHECK(fixture.run("return '10' + 5") == "15");
  CHECK(fixture.run("return -'10' .. ' ' .. tonumber('0x10') .. ' ' .. tonumber('z', 36)") == "-10 16 35");
  CHECK_THAT(fixture.fault("return ('1'):rep(300) + 1"), Catch::Contains("is no number"));
  CHECK(fixture.run("return tonumber(('1'):rep(300)) == nil") == "true");
}

TEST_CASE("a spent budget stays spent") {
  Fixture fixture;
  CHECK(fixture.run("return 1") == "1");
  CHECK(fixture.fault("while true do end").find("spent") != std::string::npos);
  CHECK(fixture.fault("return 1").find("spent") != std::string::npos);
}

TEST_CASE("each call has a budget of its own") {
  Fixture fixture;  // 200,000: each loop takes about three quarters of it
  for (int i = 0; i < 5; ++i) CHECK(fixture.run("for i = 1, 140000 do end return 'done'") == "done");
}

TEST_CASE("memory ends in an error, and a string in its limit") {
  for (const char* source :
       {"local t = {} for i = 1, 1e9 do t[i] = { i, i, i } end", "local s = 'x' while true do s = s .. s end",
        "local t = {} for i = 1, 1e9 do t[i] = ('x'):rep(60000) .. i end"}) {
    INFO(source);
    Fixture fixture;
    const std::string text = fixture.fault(source);
    const bool ended = text.find("memory") != std::string::npos || text.find("spent") != std::string::npos;
    CHECK(ended);
  }
  Sandbox roomy({50'000'000, 4u << 20}, {});
  const std::string bomb = Sandbox::compile("local t = {} for i = 1, 1e9 do t[i] = { i, i, i } end", "test.lua");
  CHECK_THROWS_WITH(roomy.run(bomb, "test.lua", 0), Catch::Contains("too much memory"));
}

TEST_CASE("the budget holds inside coroutines, and stays spent on all of them") {
  Fixture fixture;
  lua_State* main = fixture.sandbox.state();
  const auto coroutine_of = [&](const std::string& source) {
    fixture.sandbox.run(Sandbox::compile(source, "skill.lua"), "skill.lua", 1);
    lua_State* thread = lua_newthread(main);
    lua_insert(main, -2);
    lua_xmove(main, thread, 1);
    return thread;
  };
  lua_State* quiet = coroutine_of("return function() return 7 end");
  lua_State* endless = coroutine_of("return function()\n  while true do end\nend");
  int results = 0;
  CHECK_THROWS_WITH(fixture.sandbox.resume(endless, 0, results), Catch::Contains("spent"));
  CHECK_THROWS_WITH(fixture.sandbox.resume(quiet, 0, results), Catch::Contains("spent"));
}

TEST_CASE("an error in a coroutine tells its place and who called") {
  Fixture fixture;
  lua_State* main = fixture.sandbox.state();
  fixture.sandbox.run(
      Sandbox::compile("local function inner() error('oops') end\nreturn function() inner() return 1 end", "skill.lua"),
      "skill.lua", 1);
  lua_State* thread = lua_newthread(main);
  lua_insert(main, -2);
  lua_xmove(main, thread, 1);
  int results = 0;
  try {
    fixture.sandbox.resume(thread, 0, results);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.where() == "skill.lua:1");
    CHECK(error.message() == "oops");
    CHECK(error.hint().find("skill.lua:2: in function") != std::string::npos);
  }
}

namespace {
int throwing(lua_State*) { throw Error("place", "from C++", "cure"); }
int guarded_by_destructor(lua_State* state) {
  struct Guard {
    ~Guard() { ++*count; }
    int* count;
  } guard{static_cast<int*>(lua_touserdata(state, 1))};
  return luaL_error(state, "left");
}
}  // namespace

TEST_CASE("C++ exceptions become Lua errors, and Lua errors run destructors") {
  Fixture fixture;
  lua_State* state = fixture.sandbox.state();
  lua_pushcfunction(state, lua_function<throwing>);
  CHECK_THROWS_WITH(fixture.sandbox.call(0, 0), Catch::Contains("from C++") && Catch::Contains("cure"));
  int destroyed = 0;
  lua_pushcfunction(state, lua_function<guarded_by_destructor>);
  lua_pushlightuserdata(state, &destroyed);
  CHECK_THROWS_WITH(fixture.sandbox.call(1, 0), Catch::Contains("left"));
  CHECK(destroyed == 1);
}

TEST_CASE("require gives a module once and names what it lacks") {
  const std::string module = Sandbox::compile("local n = { count = 0 } return n", "tasks/lib/a.lua");
  const std::string loop = Sandbox::compile("return require 'loop'", "loop.lua");
  Sandbox sandbox(kSmall, [&](std::string_view name) -> std::string_view {
    return name == "tasks.lib.a" ? std::string_view(module)
           : name == "loop"      ? std::string_view(loop)
                                 : std::string_view();
  });
  sandbox.run(Sandbox::compile(
                  "local a = require 'tasks.lib.a' a.count = a.count + 1 return require('tasks.lib.a').count", "t.lua"),
              "t.lua", 1);
  CHECK(lua_tointeger(sandbox.state(), -1) == 1);
  CHECK_THROWS_WITH(sandbox.run(Sandbox::compile("require '../../etc/passwd'", "t.lua"), "t.lua", 0),
                    Catch::Contains("finds no"));
  CHECK_THROWS_WITH(sandbox.run(Sandbox::compile("require 'loop'", "t.lua"), "t.lua", 0),
                    Catch::Contains("requires itself"));
}

TEST_CASE("after a fresh start, modules are as nobody has changed them, and long texts of others cost nothing") {
  const std::string module = Sandbox::compile("return { count = 0 }", "tasks/lib/a.lua");
  Sandbox sandbox({200'000, 4u << 20}, [&](std::string_view) { return std::string_view(module); });
  const auto count = [&] {
    sandbox.run(Sandbox::compile("local a = require 'a' a.count = a.count + 1 return a.count", "t.lua"), "t.lua", 1);
    return lua_tointeger(sandbox.state(), -1);
  };
  CHECK(count() == 1);
  CHECK(count() == 2);
  sandbox.start_afresh();
  CHECK(lua_gettop(sandbox.state()) == 0);
  CHECK(count() == 1);
  sandbox.run(Sandbox::compile("return ('x'):rep(60000)", "long.lua"), "long.lua", 1);
  sandbox.start_afresh();
  sandbox.run(Sandbox::compile("for i = 1, 50000 do end", "t.lua"), "t.lua", 0);  // 30 times as dear beside the text
}

TEST_CASE("a syntax error names file and line") {
  try {
    Sandbox::compile("return task {\n  world = \n}", "tasks/bad.lua");
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.where() == "tasks/bad.lua:3");
    CHECK(error.message().find("unexpected symbol near '}'") != std::string::npos);
  }
}

TEST_CASE("a fresh state knows nothing of another") {
  const std::string counter = Sandbox::compile("local n = 0 return function() n = n + 1 return n end", "c.lua");
  for (int i = 0; i < 2; ++i) {
    Sandbox sandbox(kSmall, {});
    sandbox.run(counter, "c.lua", 1);
    lua_pushvalue(sandbox.state(), -1);
    sandbox.call(0, 1);
    CHECK(lua_tointeger(sandbox.state(), -1) == 1);
  }
}

TEST_CASE("a script that runs when an end is asked for is ended at once, and that is no mistake of its own") {
  for (const char* source : {"while true do end", "local s = ('x'):rep(60000) while true do s = s:upper() end"}) {
    INFO(source);
    Sandbox sandbox(SandboxLimits{}, {});
    std::atomic<bool> stop = false;
    const StopScope scope(&stop);
    std::thread later([&stop] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      stop = true;
    });
    CHECK_THROWS_AS(sandbox.run(Sandbox::compile(source, "test.lua"), "test.lua", 0), Interrupted);
    later.join();
  }
}
