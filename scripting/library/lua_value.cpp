#include "scripting/library/lua_value.h"

#include <lua.hpp>

#include "engine/base/error.h"
#include "engine/base/utf8.h"
#include "scripting/lua/binding.h"

namespace stampede {
namespace {

constexpr int kDeepest = 24;
constexpr int kMostValues = 200'000;

struct Reading {
  Value* result;
  std::string place;
  int count = 0;
};

Value read(lua_State* state, int index, Reading& reading, int depth);

Value read_table(lua_State* state, int index, Reading& reading, int depth) {
  Value value;
  value.kind = Value::Kind::table;
  if (depth > kDeepest) throw Error(reading.place, "tables nested too deeply", "does a table hold itself?");
  const auto length = static_cast<lua_Integer>(lua_rawlen(state, index));
  value.items.reserve(static_cast<std::size_t>(length));
  for (lua_Integer i = 1; i <= length; ++i) {
    lua_rawgeti(state, index, i);
    value.items.push_back(read(state, lua_gettop(state), reading, depth + 1));
    lua_pop(state, 1);
  }
  lua_pushnil(state);
  while (lua_next(state, index) != 0) {
    if (lua_type(state, -2) == LUA_TSTRING) {
      std::size_t size = 0;
      const char* key = lua_tolstring(state, -2, &size);
      value.fields.emplace(std::string(key, size), read(state, lua_gettop(state), reading, depth + 1));
    } else if (!lua_isinteger(state, -2) || lua_tointeger(state, -2) < 1 || lua_tointeger(state, -2) > length) {
      value.odd_keys = true;
    }
    lua_pop(state, 1);
  }
  return value;
}

Value read(lua_State* state, int index, Reading& reading, int depth) {
  if (++reading.count > kMostValues) throw Error(reading.place, "more than 200000 values in one definition");
  luaL_checkstack(state, 8, "definition nested too deeply");
  if (lua_istable(state, index)) return read_table(state, index, reading, depth);
  Value value = plain_value(state, index);
  if (lua_isfunction(state, index)) value.kind = Value::Kind::function;
  if (value.is_text() && not_text_at(value.text) != std::string::npos)
    throw Error(reading.place, "a text that is no UTF-8", "write letters as they are, without escapes such as \\xE9");
  return value;
}

int read_protected(lua_State* state) {
  auto* reading = static_cast<Reading*>(lua_touserdata(state, 2));
  *reading->result = read(state, 1, *reading, 0);
  return 0;
}

}  // namespace

Value plain_value(lua_State* state, int index) {
  Value value;
  switch (lua_type(state, index)) {
    case LUA_TNIL:
      break;
    case LUA_TBOOLEAN:
      value.kind = Value::Kind::boolean;
      value.boolean = lua_toboolean(state, index) != 0;
      break;
    case LUA_TNUMBER:
      value.kind = Value::Kind::number;
      value.number = lua_tonumber(state, index);
      value.integer = lua_isinteger(state, index) != 0;
      break;
    case LUA_TSTRING: {
      std::size_t size = 0;
      const char* text = lua_tolstring(state, index, &size);
      value.kind = Value::Kind::text;
      value.text.assign(text, size);
      break;
    }
    default:
      value.kind = Value::Kind::other;
      value.text = luaL_typename(state, index);
  }
  return value;
}

Value value_as_written(lua_State* state, int index, const std::string& place) {
  Value result;
  Reading reading{&result, place};
  index = lua_absindex(state, index);
  lua_checkstack(state, 8);
  lua_pushcfunction(state, lua_function<read_protected>);  // pushing a key may run out of memory
  lua_pushvalue(state, index);
  lua_pushlightuserdata(state, &reading);
  if (lua_pcall(state, 2, 0, 0) != LUA_OK) {
    const char* text = lua_tostring(state, -1);
    std::string message = text != nullptr ? text : "no memory";
    lua_pop(state, 1);
    if (message.starts_with(place + ": ")) message.erase(0, place.size() + 2);
    throw Error(place, message);
  }
  return result;
}

}  // namespace stampede
