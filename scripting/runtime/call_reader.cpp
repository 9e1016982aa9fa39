#include <algorithm>
#include <lua.hpp>

#include "engine/base/error.h"
#include "engine/start/call_settings.h"
#include "scripting/runtime/pose_binding.h"
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

std::size_t parameter_index(const SkillInfo& info, const std::string& name, const std::string& place) {
  for (std::size_t i = 0; i < info.parameters.size(); ++i)
    if (info.parameters[i].name == name) return i;
  throw Error(place, "skill '" + info.name + "' has no parameter '" + name + "'");
}

// A number, a list of numbers or a pose at a stack index.
std::vector<double> numbers_at(lua_State* state, int index, const std::string& place) {
  if (lua_type(state, index) == LUA_TNUMBER) return {lua_tonumber(state, index)};
  if (const std::optional<Transform> transform = pose_at(state, index)) {
    const Pose pose = to_pose(*transform);
    std::vector<double> values(pose.position.begin(), pose.position.end());
    values.insert(values.end(), pose.quaternion.begin(), pose.quaternion.end());
    return values;
  }
  std::vector<double> values;
  const auto count = lua_istable(state, index) ? static_cast<lua_Integer>(lua_rawlen(state, index)) : 0;
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(state, index, i);
    if (lua_type(state, -1) != LUA_TNUMBER) throw Error(place, "expected numbers");
    values.push_back(lua_tonumber(state, -1));
    lua_pop(state, 1);
  }
  if (values.empty()) throw Error(place, "expected a number, a list of numbers or a pose");
  return values;
}

// The call's field `set`: what act was given beside names of objects. In alphabetical order.
CallSettings settings_at(lua_State* state, int call, const SkillInfo& info, const std::string& place) {
  CallSettings set;
  lua_pushstring(state, "set");
  lua_rawget(state, call);
  if (lua_istable(state, -1)) {
    const int table = lua_gettop(state);
    lua_pushnil(state);
    while (lua_next(state, table) != 0) {
      const std::string name = lua_type(state, -2) == LUA_TSTRING ? lua_tostring(state, -2) : "";
      const std::string where = place + ": " + info.name + "." + name;
      if (lua_type(state, -1) == LUA_TSTRING)
        add_setting(name, lua_tostring(state, -1), set, where);
      else
        set.values.push_back({name, 0, numbers_at(state, lua_gettop(state), where)});
      lua_pop(state, 1);
    }
  }
  lua_pop(state, 1);
  std::sort(set.values.begin(), set.values.end(),
            [](const auto& a, const auto& b) { return a.parameter < b.parameter; });
  check_settings(info, set, place);
  return set;
}

}  // namespace

AskedCall asked_call_at(lua_State* state, int index, const Library& library, const std::string& place) {
  index = lua_absindex(state, index);
  if (!lua_istable(state, index) || text_field(state, index, "tag") != "call") {
    throw Error(place, "expected a call such as act.pick(\"cup\")");
  }
  AskedCall call;
  call.skill = text_field(state, index, "skill");
  const SkillInfo* info = library.skill(call.skill);
  if (info == nullptr) throw Error(place, "there is no skill '" + call.skill + "'");
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
  call.set = settings_at(state, index, *info, place);
  return call;
}

}  // namespace stampede
