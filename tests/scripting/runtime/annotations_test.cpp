// Editors are told of the words and methods that there are, and of no others.
#include "scripting/library/annotations.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <lua.hpp>
#include <regex>
#include <set>
#include <string>

#include "scripting/runtime/pose_binding.h"
#include "scripting/runtime/script_state.h"
#include "scripts_fixture.h"

using namespace stampede;

namespace {

using Names = std::set<std::string>;

// The first group of each match of a pattern, line by line.
Names declared(const std::string& pattern) {
  const std::string text = word_annotations() + field_annotations();
  const std::regex regex(pattern, std::regex::multiline);
  Names names;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at) names.insert(at->str(1));
  return names;
}

Names methods_declared(const std::string& of) { return declared("^function stampede_" + of + ":(\\w+)\\("); }

Names keys(lua_State* state, int table) {
  Names names;
  table = lua_absindex(state, table);
  lua_pushnil(state);
  while (lua_next(state, table) != 0) {
    lua_pop(state, 1);
    names.insert(lua_tostring(state, -1));
  }
  return names;
}

// Of the userdata on top.
Names methods(lua_State* state) {
  REQUIRE(lua_getmetatable(state, -1) != 0);
  lua_getfield(state, -1, "__index");
  return keys(state, -1);
}

struct Script {
  ScriptState script{test::small_library(), "panda.hand"};
  lua_State* state = script.lua();
};

}  // namespace

TEST_CASE_METHOD(Script, "editors know the methods of w, robot, rng and poses") {
  push_view(state, script.view);
  CHECK(methods(state) == methods_declared("world_view"));
  push_view(state, script.view);
  push_robot(state, script.robot, -1);
  CHECK(methods(state) == methods_declared("robot_view"));
  push_random(state, RandomKey("test"));
  CHECK(methods(state) == methods_declared("random"));
  push_pose(state, Transform::Identity());
  CHECK(methods(state) == methods_declared("pose"));
}

TEST_CASE_METHOD(Script, "editors know the words of the language") {
  lua_pushglobaltable(state);
  Names words = keys(state, -1);
  for (const char* lua : {"assert", "error", "ipairs", "math", "pairs", "require", "select", "string", "table",
                          "tonumber", "tostring", "type"}) {
    words.erase(lua);
  }
  Names known = declared("^function (\\w+)\\(");
  known.merge(declared("^(\\w+) = \\{\\}"));
  CHECK(known == words);
}

TEST_CASE("a function's parameters have types that editors complete") {
  CHECK_NOTHROW(Sandbox::compile(word_annotations(), "words.lua"));
  const std::string text = field_annotations();
  CHECK_NOTHROW(Sandbox::compile(text, "stampede.lua"));
  CHECK(text.find("---@field holds? (fun(w: stampede.world_view, ...: any): any, any?)") != std::string::npos);
  CHECK(text.find("---@field run? (fun(robot: stampede.robot_view, p: ") != std::string::npos);
}

TEST_CASE("predicates and skills of a library have their parameters, without the hand") {
  const std::string text = name_annotations(*test::small_library());
  INFO(text);
  CHECK_NOTHROW(Sandbox::compile(text, "names.lua"));
  CHECK(text.find("---@field on fun(obj: string, below: string): stampede.literal") != std::string::npos);
  CHECK(text.find("hand: string") == std::string::npos);
  CHECK(text.find("string|table") != std::string::npos);
}
