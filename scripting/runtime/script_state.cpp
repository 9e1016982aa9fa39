#include "scripting/runtime/script_state.h"

#include <exception>
#include <lua.hpp>
#include <optional>
#include <string_view>

#include "scripting/lua/binding.h"
#include "scripting/runtime/pose_binding.h"

namespace stampede {
namespace {

struct Work {
  const std::function<void(lua_State*)>* run;
  std::optional<Error> error;  // that it threw: Lua keeps its text alone
};

int perform(lua_State* state) {
  auto* work = static_cast<Work*>(lua_touserdata(state, 1));
  lua_settop(state, 0);
  try {
    (*work->run)(state);
  } catch (const Error& error) {
    work->error = error;
    throw;
  }
  return 0;
}

// Lua calls this when memory ends outside any protected call; by default it would abort the program.
int outside_protection(lua_State* state) {
  const char* text = lua_tostring(state, -1);
  throw Error("", text != nullptr ? text : "Lua ran out of memory");
}

}  // namespace

ScriptState::ScriptState(std::shared_ptr<const Library> library, std::string hand)
    : library_(std::move(library)), definitions_(library_) {
  lua_State* state = lua();
  lua_atpanic(state, outside_protection);
  view.hand = std::move(hand);
  view.numbers = &library_->numbers();
  robot.view = &view;
  robot.library = library_.get();
  protect([&](lua_State* inner) {
    register_poses(inner);
    push_view(inner, view);
    push_robot(inner, robot, -1);
    robot_reference_ = luaL_ref(inner, LUA_REGISTRYINDEX);
    view_reference_ = luaL_ref(inner, LUA_REGISTRYINDEX);
  });
}

ScriptState::~ScriptState() = default;

void ScriptState::protect(const std::function<void(lua_State*)>& work) {
  lua_State* state = lua();
  Work handed{&work, {}};
  lua_pushcfunction(state, lua_function<perform>);
  lua_pushlightuserdata(state, &handed);
  try {
    sandbox().call(1, 0);
  } catch (const Error& error) {
    if (handed.error && std::string_view(handed.error->what()) == error.what()) throw *handed.error;
    throw;
  }
}

int ScriptState::keep() { return luaL_ref(lua(), LUA_REGISTRYINDEX); }

void ScriptState::push_kept(int reference) { lua_rawgeti(lua(), LUA_REGISTRYINDEX, reference); }

void ScriptState::drop(int reference) { luaL_unref(lua(), LUA_REGISTRYINDEX, reference); }

int ScriptState::function_of(DefinitionKind kind, std::string_view name, const char* field) {
  lua_State* state = lua();
  definitions_.push(kind, name);
  lua_pushstring(state, field);
  lua_rawget(state, -2);
  int reference = 0;
  if (lua_isfunction(state, -1)) {
    reference = keep();
  } else {
    lua_pop(state, 1);
  }
  lua_pop(state, 1);
  return reference;
}

}  // namespace stampede
