#include "scripting/runtime/variation.h"

#include <lua.hpp>

#include "engine/base/error.h"
#include "scripting/library/definitions.h"
#include "scripting/library/lua_value.h"

namespace stampede {
namespace {

// Is the value on top of the stack the one that reads `text`? Tells; leaves the stack as it is.
bool reads(lua_State* state, const std::string& text, const std::string& place) {
  return !lua_isnil(state, -1) && plain_text(value_as_written(state, -1, place)) == text;
}

// Pushes the value of one axis from `variations` at `index`, a table of axes or a list of combinations.
bool push_value(lua_State* state, int index, const std::string& axis, const std::string& text,
                const std::string& place) {
  lua_getfield(state, index, axis.c_str());
  const bool product = lua_istable(state, -1);
  const int values = product ? lua_gettop(state) : index;
  const auto count = static_cast<lua_Integer>(lua_rawlen(state, values));
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(state, values, i);
    if (!product) {
      lua_getfield(state, -1, axis.c_str());
      lua_remove(state, -2);
    }
    if (reads(state, text, place)) {
      lua_remove(state, -2);
      return true;
    }
    lua_pop(state, 1);
  }
  lua_pop(state, 1);
  return false;
}

}  // namespace

void push_variation(lua_State* state, int task, const std::map<std::string, std::string>& axes,
                    const std::string& file) {
  const std::string place = file + ": variations";
  lua_createtable(state, 0, static_cast<int>(axes.size()));
  const int variation = lua_gettop(state);
  lua_getfield(state, task, "variations");
  const int variations = lua_gettop(state);
  for (const auto& [axis, text] : axes) {
    if (!lua_istable(state, variations) || !push_value(state, variations, axis, text, place)) {
      throw Error(place, "no value of '" + axis + "' reads '" + text + "'");
    }
    lua_setfield(state, variation, axis.c_str());
  }
  name_axes(state, variation, variations);
  lua_settop(state, variation);
}

}  // namespace stampede
