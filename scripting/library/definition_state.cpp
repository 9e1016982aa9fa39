#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "scripting/library/definitions.h"
#include "scripting/library/embedded.h"
#include "scripting/library/name_lists.h"
#include "scripting/lua/binding.h"

namespace stampede {
namespace {

constexpr const char kDefinitionsKey[] = "stampede.definitions";
constexpr const char kWordsKey[] = "stampede.words";

constexpr int kMostLevels = 16;  // of calls: ours are few, and finding a level takes time for all above it

// The innermost line that an author wrote: prelude.lua and C++ are passed over. False: a tail call has hidden it.
bool author_line(lua_State* state, lua_Debug& found) {
  for (int level = 1; level <= kMostLevels && lua_getstack(state, level, &found) != 0; ++level) {
    lua_getinfo(state, "Sl", &found);
    if (found.currentline > 0 && found.source[0] == '@' && std::strcmp(found.source, "@prelude") != 0) return true;
  }
  return false;
}

int here(lua_State* state) {
  lua_Debug found;
  lua_pushinteger(state, author_line(state, found) ? found.currentline : 0);
  return 1;
}

int fail(lua_State* state) {
  const char* message = luaL_checkstring(state, 1);
  lua_Debug found;
  if (author_line(state, found)) {
    lua_pushfstring(state, "%s:%d: %s", found.source + 1, found.currentline, message);
  } else {
    lua_pushstring(state, message);
  }
  return lua_error(state);
}

int set_metatable(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  luaL_checktype(state, 2, LUA_TTABLE);
  lua_settop(state, 2);
  lua_setmetatable(state, 1);
  return 1;
}

// Upvalue: the axes, by name.
int unknown_axis(lua_State* state) {
  lua_pushvalue(state, 2);
  if (lua_type(state, 2) != LUA_TSTRING || lua_rawget(state, lua_upvalueindex(1)) != LUA_TNIL) return 0;
  std::vector<std::string> axes;
  for (lua_pushnil(state); lua_next(state, lua_upvalueindex(1)) != 0; lua_pop(state, 1))
    axes.emplace_back(lua_tostring(state, -2));
  std::sort(axes.begin(), axes.end());
  const std::string name = lua_tostring(state, 2);
  const std::string cure = axes.empty() ? "the task declares no variations" : did_you_mean(name, axes);
  throw std::runtime_error("the variations have no axis '" + name + "': " + cure);
}

int forget_definitions(lua_State* state) {
  lua_newtable(state);
  lua_setfield(state, LUA_REGISTRYINDEX, kDefinitionsKey);
  return 0;
}

// Arguments: bytecode, whether there is a predicate hand_empty, then the modules of colours.
int run_prelude(lua_State* state) {
  const auto* bytecode = static_cast<const std::string*>(lua_touserdata(state, 1));
  const int modules = lua_gettop(state);
  lua_newtable(state);
  const int colours = modules + 1;
  for (int module = 3; module <= modules; ++module) {
    lua_getglobal(state, "require");
    lua_pushvalue(state, module);
    lua_call(state, 1, 1);
    if (!lua_istable(state, -1)) {
      std::string path = lua_tostring(state, module);
      std::replace(path.begin(), path.end(), '.', '/');
      lua_pushfstring(state, "%s.lua:1: it returns a %s, not a table of colours by name", path.c_str(),
                      luaL_typename(state, -1));
      return lua_error(state);
    }
    for (lua_pushnil(state); lua_next(state, -2) != 0;) {
      lua_pushvalue(state, -2);
      lua_insert(state, -2);
      lua_settable(state, colours);
    }
    lua_pop(state, 1);
  }
  if (luaL_loadbufferx(state, bytecode->data(), bytecode->size(), "=prelude", "b") != LUA_OK) return lua_error(state);
  lua_newtable(state);
  const LuaFunction own[] = {
      {"here", lua_function<here>}, {"fail", lua_function<fail>}, {"setmetatable", lua_function<set_metatable>}};
  set_functions(state, own);
  lua_pushglobaltable(state);
  lua_setfield(state, -2, "words");
  lua_pushvalue(state, colours);
  lua_setfield(state, -2, "colours");
  lua_pushvalue(state, 2);
  lua_setfield(state, -2, "hand_empty");
  lua_pushvalue(state, -1);
  lua_setfield(state, LUA_REGISTRYINDEX, kWordsKey);
  lua_call(state, 1, 0);
  return forget_definitions(state);
}

const std::string& prelude_bytecode() {
  static const std::string kBytecode = [] {
    std::string bytecode = Sandbox::compile(kPreludeSource, "prelude");
    return bytecode;
  }();
  return kBytecode;
}

std::string home_of(DefinitionKind kind) { return std::string(to_string(kind)); }

}  // namespace

void name_axes(lua_State* state, int variation, int variations) {
  variation = lua_absindex(state, variation);
  variations = lua_absindex(state, variations);
  const auto add_names = [&](int table, int to) {
    for (lua_pushnil(state); lua_next(state, table) != 0; lua_pop(state, 1)) {
      if (lua_type(state, -2) != LUA_TSTRING) continue;
      lua_pushvalue(state, -2);
      lua_pushboolean(state, 1);
      lua_rawset(state, to);
    }
  };
  lua_newtable(state);
  const int meta = lua_gettop(state);
  lua_newtable(state);
  const int axes = lua_gettop(state);
  if (lua_istable(state, variations)) {
    add_names(variations, axes);
    const auto count = static_cast<lua_Integer>(lua_rawlen(state, variations));  // a list: some may lack an axis
    for (lua_Integer i = 1; i <= count; ++i) {
      if (lua_rawgeti(state, variations, i) == LUA_TTABLE) add_names(lua_gettop(state), axes);
      lua_pop(state, 1);
    }
  }
  lua_pushcclosure(state, lua_function<unknown_axis>, 1);
  lua_setfield(state, meta, "__index");
  lua_setmetatable(state, variation);
}

struct DefinitionState::Impl {
  std::shared_ptr<const Library> library;
  Sandbox sandbox;
  Impl(std::shared_ptr<const Library> the_library, const SandboxLimits& limits)
      : library(std::move(the_library)), sandbox(limits, [raw = library.get()](std::string_view name) {
          const ScriptFile* file = raw->module(name);
          return file == nullptr ? std::string_view() : std::string_view(file->bytecode);
        }) {}
};

DefinitionState::DefinitionState(std::shared_ptr<const Library> library, const SandboxLimits& limits)
    : impl_(std::make_unique<Impl>(std::move(library), limits)) {
  lua_State* lua = state();
  lua_pushcfunction(lua, lua_function<run_prelude>);
  lua_pushlightuserdata(lua, const_cast<std::string*>(&prelude_bytecode()));
  lua_pushboolean(lua, impl_->library->file(DefinitionKind::predicate, "hand_empty") != nullptr);
  int modules = 0;
  for (const ScriptFile* file : impl_->library->files(DefinitionKind::colours)) {
    if (file->bytecode.empty()) continue;  // it has its own complaint
    std::string name = file->shown_path.substr(0, file->shown_path.rfind('.'));
    std::replace(name.begin(), name.end(), '/', '.');
    lua_pushlstring(lua, name.data(), name.size());
    ++modules;
  }
  sandbox().call(2 + modules, 0);
}

DefinitionState::~DefinitionState() = default;
Sandbox& DefinitionState::sandbox() { return impl_->sandbox; }
lua_State* DefinitionState::state() { return impl_->sandbox.state(); }
const Library& DefinitionState::library() const { return *impl_->library; }

void DefinitionState::start_afresh() {
  sandbox().start_afresh();
  lua_pushcfunction(state(), lua_function<forget_definitions>);
  sandbox().call(0, 0);
}

void DefinitionState::push(DefinitionKind kind, std::string_view name) {
  lua_State* lua = state();
  luaL_checkstack(lua, 8, "too many values");
  const int top = lua_gettop(lua);
  const std::string key = home_of(kind) + "/" + std::string(name);
  lua_getfield(lua, LUA_REGISTRYINDEX, kDefinitionsKey);
  if (lua_getfield(lua, -1, key.c_str()) != LUA_TNIL) {
    lua_remove(lua, -2);
    return;
  }
  lua_pop(lua, 1);
  const ScriptFile* file = library().file(kind, name);
  if (file == nullptr) {
    lua_pop(lua, 1);
    throw Error(std::string(name), "there is no " + home_of(kind) + " '" + std::string(name) + "'");
  }
  try {
    sandbox().run(file->bytecode, "@" + file->shown_path, 1);
  } catch (const Error& error) {
    lua_settop(lua, lua_gettop(lua) - 1);
    if (!error.where().empty()) throw;
    throw Error(file->shown_path, error.message(), error.hint());
  }
  const bool plain = kind == DefinitionKind::types || kind == DefinitionKind::colours ||
                     kind == DefinitionKind::words || kind == DefinitionKind::module;
  std::string got = luaL_typename(lua, -1);
  if (lua_istable(lua, -1) && !plain) {
    lua_getfield(lua, -1, "kind");
    got = lua_isstring(lua, -1) != 0 ? lua_tostring(lua, -1) : "table";
    lua_pop(lua, 1);
  }
  if (plain ? got != "table" : got != to_string(kind)) {
    lua_pop(lua, 2);
    throw Error(file->shown_path,
                "the file returns a " + got + (got == "nil" ? " value" : "") + ", not a " + home_of(kind),
                plain ? "end it with return { … }" : "end it with return " + home_of(kind) + " { … }");
  }
  if (!plain) {
    lua_pushlstring(lua, name.data(), name.size());
    lua_setfield(lua, -2, "name");
  }
  if (kind == DefinitionKind::skill || kind == DefinitionKind::predicate) {
    try {
      extend(*file);
    } catch (const Error&) {
      lua_settop(lua, top);
      throw;
    }
  }
  lua_pushvalue(lua, -1);
  lua_setfield(lua, -3, key.c_str());
  lua_remove(lua, -2);
}

// The skill or predicate on top of the stack gets what it leaves to the one that it extends.
void DefinitionState::extend(const ScriptFile& file) {
  lua_State* lua = state();
  const bool extends = lua_getfield(lua, -1, "extends") == LUA_TSTRING;
  const std::string base = extends ? lua_tostring(lua, -1) : "";
  lua_pop(lua, 1);
  if (!extends) return;
  if (library().file(file.kind, base) == nullptr)
    throw Error(file.shown_path, "extends: there is no " + home_of(file.kind) + " '" + base + "'",
                did_you_mean(base, names_of(library().files(file.kind))));
  if (listed(extending_, file.name) || base == file.name)
    throw Error(file.shown_path, "extends: '" + file.name + "' extends itself",
                file.kind == DefinitionKind::skill
                    ? "give it a name of its own, and name it in the skills of a task or world"
                    : "extend a predicate that does not extend this one");
  extending_.push_back(file.name);
  lua_getfield(lua, LUA_REGISTRYINDEX, kWordsKey);
  lua_getfield(lua, -1, "extend");
  lua_remove(lua, -2);
  lua_pushvalue(lua, -2);
  push(file.kind, base);
  sandbox().call(2, 0);
  extending_.pop_back();
}

}  // namespace stampede
