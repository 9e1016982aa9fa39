#include "scripting/runtime/lua_symbols.h"

#include <algorithm>
#include <lua.hpp>

#include "engine/sim/collision_state.h"
#include "scripting/library/source_lines.h"
#include "scripting/runtime/sampling_binding.h"

namespace stampede {
namespace {

bool has_trait(const Object& object, const std::string& trait) {
  return std::find(object.traits.begin(), object.traits.end(), trait) != object.traits.end();
}

bool has_attribute(const Object& object, const std::string& key, const std::string& value) {
  const auto found = object.attributes.find(key);
  return found != object.attributes.end() && found->second == value;
}

std::optional<std::vector<KeptValue>> kept_by(ScriptState& scripts, int function) {
  std::optional<std::vector<KeptValue>> kept;
  if (function == 0) return std::vector<KeptValue>{};
  scripts.protect([&](lua_State* state) {
    scripts.push_kept(function);
    kept = kept_values(state);
  });
  return kept;
}

void push_arguments(lua_State* state, const Fact& fact) {
  for (const std::string& name : fact.arguments) lua_pushlstring(state, name.data(), name.size());
}

}  // namespace

PredicateTraits LuaSymbols::traits(const std::string& predicate) const {
  const auto& all = tests_.library()->predicate_traits();
  const auto found = all.find(predicate);
  return found == all.end() ? PredicateTraits{} : found->second;
}

// Functions of another state are void.
void LuaSymbols::forget_void() {
  if (generation_ == tests_.generation()) return;
  for (Functions* functions : {&holds_, &observable_, &seen_in_task_}) functions->clear();
  generation_ = tests_.generation();
}

int LuaSymbols::function_of(Functions& known, const char* field, const std::string& predicate) {
  forget_void();
  const auto found = known.find(predicate);
  if (found != known.end()) return found->second;
  const bool scripted = tests_.library()->file(DefinitionKind::predicate, predicate) != nullptr;
  const int function = scripted ? tests_.get().function_of(DefinitionKind::predicate, predicate, field) : 0;
  known.emplace(predicate, function);
  return function;
}

bool LuaSymbols::can_hide(const std::string& predicate) const {
  return tests_.library()->can_hide(predicate) || hidden_by_task(predicate);
}

bool LuaSymbols::hidden_by_task(const std::string& predicate) const {
  const Library::TaskInfo* task = tests_.library()->task(task_);
  return task != nullptr && task->hiding.contains(predicate);
}

// `observable = false`: never.
bool LuaSymbols::observable(const Fact& fact, const WorldView& view) {
  const auto sees = [&](int function) { return function != 0 && call(function, fact, view).holds; };
  if (tests_.library()->can_hide(fact.predicate) && !sees(function_of(observable_, "observable", fact.predicate)))
    return false;
  return !hidden_by_task(fact.predicate) || sees(seen_in_task(fact.predicate));
}

int LuaSymbols::seen_in_task(const std::string& predicate) {
  forget_void();
  if (const auto known = seen_in_task_.find(predicate); known != seen_in_task_.end()) return known->second;
  ScriptState& scripts = tests_.get();
  int function = 0;
  scripts.protect([&](lua_State* state) {
    scripts.definitions().push(DefinitionKind::task, task_);
    lua_getfield(state, -1, "observable");
    lua_getfield(state, -1, predicate.c_str());
    if (lua_isfunction(state, -1)) function = scripts.keep();
  });
  seen_in_task_.emplace(predicate, function);
  return function;
}

Symbols::Value LuaSymbols::value(const Fact& fact, const WorldView& view) {
  if (const int holds = function_of(holds_, "holds", fact.predicate); holds != 0) return call(holds, fact, view);
  const std::vector<std::string>& arguments = fact.arguments;
  if (arguments.size() == 1) return {has_trait(view.object(arguments[0]), fact.predicate), std::nullopt};
  if (arguments.size() == 2) return {has_attribute(view.object(arguments[0]), fact.predicate, arguments[1]), {}};
  throw Error("predicate " + fact.predicate, "has no 'holds', and is neither a trait nor an attribute");
}

std::string LuaSymbols::asked_at(const Fact& fact) const {
  const ScriptFile* file = tests_.library()->file(DefinitionKind::task, task_);
  const int line = file == nullptr ? 0 : line_of_atom(file->source, fact.predicate, fact.arguments);
  return line == 0 ? std::string() : file->shown_path + ":" + std::to_string(line);
}

Error LuaSymbols::asked_by_task(const Fact& fact, const Error& error) const {
  const std::string place = asked_at(fact);
  if (place.empty()) return error;
  return Error(place, to_text(fact) + ": " + (error.where().empty() ? "" : error.where() + ": ") + error.message(),
               error.hint());
}

Symbols::Value LuaSymbols::call(int function, const Fact& fact, const WorldView& view) {
  ScriptState& scripts = tests_.get();
  const ViewScope scope(scripts.view, view, nullptr, 0, turned_down_);
  lua_State* const state = scripts.lua();
  lua_rawgeti(state, LUA_REGISTRYINDEX, function);
  lua_rawgeti(state, LUA_REGISTRYINDEX, scripts.view_reference());
  push_arguments(state, fact);
  try {
    scripts.sandbox().call(static_cast<int>(fact.arguments.size()) + 1, 2);
  } catch (const Error& error) {
    throw asked_by_task(fact, error);
  }
  Value value;
  value.holds = lua_toboolean(state, -2) != 0;
  if (lua_type(state, -1) == LUA_TNUMBER) value.margin = lua_tonumber(state, -1);
  value.asked_arm = scripts.view.asked_arm;
  lua_pop(state, 2);
  return value;
}

std::vector<Placement> LuaSymbols::sample(const Fact& fact, const WorldView& view, const CollisionState& free,
                                          RandomKey key, int most) {
  if (tests_.library()->file(DefinitionKind::predicate, fact.predicate) == nullptr || most <= 0) return {};
  Sampler own = sampler(fact.predicate);
  ScriptState& scripts = *own.scripts;
  std::vector<Placement> placements;
  if (own.function != 0) {
    const ViewScope scope(scripts.view, view, &free, most, turned_down_);
    const auto draw = [&](lua_State* state) {
      scripts.push_kept(own.function);
      scripts.push_kept(scripts.view_reference());
      push_arguments(state, fact);
      push_random(state, key);
      lua_call(state, static_cast<int>(fact.arguments.size()) + 2, 1);
      const std::string object = fact.arguments.empty() ? std::string() : fact.arguments[0];
      placements = placements_at(state, -1, object, "predicate " + fact.predicate);
    };
    try {
      scripts.protect(draw);
    } catch (const Error& error) {
      throw asked_by_task(fact, error);
    }
    if (placements.size() > static_cast<std::size_t>(most)) placements.resize(static_cast<std::size_t>(most));
  }
  if (own.kept && own.kept == kept_by(scripts, own.function)) samplers_[fact.predicate] = std::move(own);
  return placements;
}

// Out of those that are kept: it goes back when it is as it was.
LuaSymbols::Sampler LuaSymbols::sampler(const std::string& predicate) {
  if (auto known = samplers_.extract(predicate)) return std::move(known.mapped());
  Sampler fresh;
  fresh.scripts = std::make_unique<ScriptState>(tests_.library(), tests_.hand());
  fresh.function = fresh.scripts->function_of(DefinitionKind::predicate, predicate, "sample");
  // Modules can be reached by name, and keep what they like. The name is a constant of the file, behind its length.
  const std::string& bytecode = tests_.library()->file(DefinitionKind::predicate, predicate)->bytecode;
  if (bytecode.find("\x88require") == std::string::npos) fresh.kept = kept_by(*fresh.scripts, fresh.function);
  return fresh;
}

}  // namespace stampede
