// How C++ functions are handed to Lua: the one place where C++ exceptions and Lua errors meet.
#pragma once

#include <cstdio>
#include <exception>
#include <lua.hpp>
#include <string_view>

namespace stampede {

// Wraps a function of the usual Lua form: lua_pushcfunction(state, lua_function<my_function>). A std::exception becomes
// a Lua error at the calling line. Lua's own errors and yields are C++ exceptions too (of no standard type): they must
// pass untouched, so nothing here or anywhere in scripting may catch `...`, and no other function bound to Lua has a
// try block. The message is copied to plain memory, because luaL_error leaves by an exception and the string must be
// gone by then.
template <int (*Function)(lua_State*)>
int lua_function(lua_State* state) {
  char message[2048];
  try {
    return Function(state);
  } catch (const std::exception& error) {
    std::snprintf(message, sizeof message, "%s", error.what());
  }
  return luaL_error(state, "%s", message);
}

struct LuaFunction {
  const char* name;
  lua_CFunction function;
};

// Sets functions in the table on top of the stack.
template <std::size_t N>
void set_functions(lua_State* state, const LuaFunction (&functions)[N]) {
  for (const LuaFunction& entry : functions) {
    lua_pushcfunction(state, entry.function);
    lua_setfield(state, -2, entry.name);
  }
}

inline std::string_view check_text(lua_State* state, int argument) {
  std::size_t length = 0;
  const char* text = luaL_checklstring(state, argument, &length);
  return {text, length};
}

}  // namespace stampede
