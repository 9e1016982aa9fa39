#include "scripting/runtime/kept_values.h"

#include <lua.hpp>
#include <set>

#include "scripting/lua/sandbox.h"

namespace stampede {
namespace {

constexpr int kMostDeep = 16;

bool follow(lua_State* state, int function, int depth, std::set<const void*>& seen, std::vector<KeptValue>& values) {
  if (depth > kMostDeep || !lua_checkstack(state, 4)) return false;
  for (int i = 1; lua_getupvalue(state, function, i) != nullptr; ++i) {
    KeptValue value;
    value.type = lua_type(state, -1);
    bool followed = true;
    switch (value.type) {
      case LUA_TNIL:
        break;
      case LUA_TBOOLEAN:
        value.integer = lua_toboolean(state, -1);
        break;
      case LUA_TNUMBER:
        if (lua_isinteger(state, -1) != 0)
          value.integer = lua_tointeger(state, -1);
        else
          value.number = lua_tonumber(state, -1);
        break;
      case LUA_TSTRING:
        value.pointer = lua_tostring(state, -1);
        break;
      case LUA_TFUNCTION:
        value.pointer = lua_topointer(state, -1);
        if (lua_iscfunction(state, -1) == 0 && seen.insert(value.pointer).second)
          followed = follow(state, lua_gettop(state), depth + 1, seen, values);
        break;
      default:
        followed = is_environment(state, -1);  // refuses writes
        break;
    }
    lua_pop(state, 1);
    if (!followed) return false;
    values.push_back(value);
  }
  return true;
}

}  // namespace

std::optional<std::vector<KeptValue>> kept_values(lua_State* state) {
  std::set<const void*> seen = {lua_topointer(state, -1)};
  std::vector<KeptValue> values;
  if (!follow(state, lua_gettop(state), 0, seen, values)) return std::nullopt;
  return values;
}

}  // namespace stampede
