#include <algorithm>
#include <lua.hpp>

#include "scripting/runtime/robot_binding.h"

namespace stampede {
namespace {

std::string text_field(lua_State* state, int index, const char* field) {
  lua_pushstring(state, field);
  lua_rawget(state, index);
  const std::string text = lua_type(state, -1) == LUA_TSTRING ? lua_tostring(state, -1) : "";
  lua_pop(state, 1);
  return text;
}

// `grasp` and the like are chosen by the runner; numbers named in a call are not arguments.
std::size_t parameter_index(const SkillInfo& info, const std::string& name, const std::string& place) {
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    if (info.parameters[i].name == name) return i;
  }
  throw Error(place, "skill '" + info.name + "' has no parameter '" + name + "'");
}

}  // namespace

SkillCall skill_call_at(lua_State* state, int index, const Library& library, const std::string& place) {
  index = lua_absindex(state, index);
  if (!lua_istable(state, index) || text_field(state, index, "tag") != "call") {
    throw Error(place, "expected a call such as act.pick(\"cup\")");
  }
  SkillCall call;
  call.skill = text_field(state, index, "skill");
  const SkillInfo* info = library.skill(call.skill);
  if (info == nullptr) throw Error(place, "there is no skill '" + call.skill + "'");
  call.controller = info->controller;
  call.stiffness = info->stiffness;
  call.arguments.resize(info->parameters.size());
  const auto given = static_cast<std::size_t>(lua_rawlen(state, index));
  if (given > call.arguments.size()) {
    throw Error(place, "skill '" + call.skill + "' takes " + std::to_string(call.arguments.size()) + " arguments");
  }
  for (std::size_t i = 0; i < given; ++i) {
    lua_rawgeti(state, index, static_cast<lua_Integer>(i) + 1);
    if (lua_type(state, -1) == LUA_TSTRING) call.arguments[i] = lua_tostring(state, -1);
    lua_pop(state, 1);
  }
  lua_pushnil(state);
  while (lua_next(state, index) != 0) {
    const bool named = lua_type(state, -2) == LUA_TSTRING && lua_type(state, -1) == LUA_TSTRING;
    const std::string name = named ? lua_tostring(state, -2) : "";
    if (named && name != "tag" && name != "skill" && name != "line") {
      call.arguments[parameter_index(*info, name, place)] = lua_tostring(state, -1);
    }
    lua_pop(state, 1);
  }
  return call;
}

}  // namespace stampede
