// Reads the arguments and options tables of the robot's methods. What is wrong becomes a Lua error at the script's
// line; `place` is said before it.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <lua.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/error.h"
#include "engine/start/world_view.h"
#include "scripting/runtime/pose_binding.h"

namespace stampede {

// Optional fields of an options table at `index`; anything but a table counts as none.
inline double number_field(lua_State* state, int index, const char* name, double otherwise,
                           const std::string& place = {}) {
  if (!lua_istable(state, index)) return otherwise;
  lua_getfield(state, index, name);
  if (!lua_isnil(state, -1) && lua_type(state, -1) != LUA_TNUMBER)
    throw Error(place, std::string(name) + " must be a number");
  const double value = lua_isnil(state, -1) ? otherwise : lua_tonumber(state, -1);
  lua_pop(state, 1);
  if (!std::isfinite(value)) throw Error(place, std::string(name) + " must be finite");
  return value;
}

inline bool has_field(lua_State* state, int index, const char* name) {
  if (!lua_istable(state, index)) return false;
  const bool found = lua_getfield(state, index, name) != LUA_TNIL;
  lua_pop(state, 1);
  return found;
}

inline bool flag_field(lua_State* state, int index, const char* name, bool otherwise = false) {
  if (!has_field(state, index, name)) return otherwise;
  lua_getfield(state, index, name);
  const bool value = lua_toboolean(state, -1) != 0;
  lua_pop(state, 1);
  return value;
}

// Three numbers at `index`, which is absolute.
inline Vector3 vector_at(lua_State* state, int index, const char* name, const std::string& place = {}) {
  const auto refuse = [&](const char* what) { throw Error(place, std::string(name) + what); };
  if (!lua_istable(state, index) || lua_rawlen(state, index) != 3) refuse(" must be three numbers: { x, y, z }");
  Vector3 vector;
  for (int i = 0; i < 3; ++i) {
    lua_rawgeti(state, index, i + 1);
    if (lua_type(state, -1) != LUA_TNUMBER) refuse(" must be three numbers: { x, y, z }");
    vector[i] = lua_tonumber(state, -1);
    if (!std::isfinite(vector[i])) refuse(" must be finite");
    lua_pop(state, 1);
  }
  return vector;
}

// A direction; zero where it is left out.
inline Vector3 direction_field(lua_State* state, int index, const char* name, const std::string& place = {}) {
  if (!has_field(state, index, name)) return Vector3::Zero();
  lua_getfield(state, index, name);
  const Vector3 direction = vector_at(state, lua_gettop(state), name, place);
  lua_pop(state, 1);
  if (direction.norm() < 1e-6) throw Error(place, std::string(name) + " must have a length");
  return direction;
}

// How wide the hand is to be: `open` of a line or piece.
inline std::optional<double> opening_field(lua_State* state, int index, double most, const std::string& place = {}) {
  if (!has_field(state, index, "open")) return std::nullopt;
  const double opening = number_field(state, index, "open", 0, place);
  if (opening < 0) throw Error(place, "open must not be negative");
  return std::min(opening, most);
}

// The joint of a part. Throws Error for a thing that has none.
inline const Joint& joint_of(const WorldView& view, const std::string& name, const std::string& place = {}) {
  const PartRef ref = view.part_of(name);
  const Part& part = view.scene().body_at(ref.body).parts[static_cast<std::size_t>(ref.part)];
  if (part.parent < 0 || part.joint.kind == JointKind::fixed) throw Error(place, "'" + name + "' has no joint");
  return part.joint;
}

inline double finite(lua_State* state, int index) {
  const double value = luaL_checknumber(state, index);
  luaL_argcheck(state, std::isfinite(value), index, "must be finite");
  return value;
}

inline Transform finite_pose(lua_State* state, int index) {
  const Transform pose = check_pose(state, index);
  if (!pose.matrix().allFinite()) throw Error("", "a pose with numbers that are not finite");
  return pose;
}

// A known option keeps a misspelt one from being ignored.
inline void only_fields(lua_State* state, int index, std::initializer_list<const char*> known,
                        const std::string& place = {}, const char* what = "option") {
  if (lua_isnoneornil(state, index)) return;
  luaL_checktype(state, index, LUA_TTABLE);
  lua_pushnil(state);
  while (lua_next(state, index) != 0) {
    lua_pop(state, 1);
    const char* key = lua_type(state, -1) == LUA_TSTRING ? lua_tostring(state, -1) : "1";
    const bool found =
        std::any_of(known.begin(), known.end(), [key](const char* name) { return std::string_view(name) == key; });
    if (found) continue;
    std::string all;
    for (const char* name : known) all += (all.empty() ? "" : " ") + std::string(name);
    throw Error(place, "no " + std::string(what) + " '" + key + "' here, there are: " + all);
  }
}

}  // namespace stampede
