#include "scripting/runtime/lua_task.h"

#include <algorithm>
#include <cmath>
#include <lua.hpp>

#include "scripting/library/source_lines.h"
#include "scripting/runtime/script_error.h"
#include "scripting/runtime/task_reader.h"
#include "scripting/runtime/variation.h"

namespace stampede {
namespace {

const Library::TaskInfo& info_of(const Library& library, std::string_view name) {
  const Library::TaskInfo* info = library.task(name);
  if (info == nullptr) throw Error(std::string(name), "there is no task of this name");
  return *info;
}

std::map<std::string, std::string> axes_of(const Library::TaskInfo& info, std::string_view variation) {
  const auto& texts = info.variation_texts;
  const auto found = std::find(texts.begin(), texts.end(), variation);
  if (found != texts.end() && !info.variations.empty()) {
    return info.variations[static_cast<std::size_t>(found - texts.begin())];
  }
  if (variation.empty() && info.variations.empty()) return {};
  throw Error("task " + info.name, "has no variation '" + std::string(variation) + "'",
              texts.empty() ? "it has none" : "the first of " + std::to_string(texts.size()) + " is " + texts[0]);
}

// Predicates that a task's functions may read: w:fact("left_of", …).
std::set<std::string> read_by_name(const Library& library, const ScriptFile& file) {
  std::set<std::string> names;
  for (const std::string& text : mentions_in(file.source).texts)
    if (library.predicate_traits().contains(text)) names.insert(text);
  return names;
}

}  // namespace

LuaTask::LuaTask(TestState& tests, EpisodeJob job, int further_things, std::shared_ptr<Assets> assets)
    : tests_(tests),
      job_(std::move(job)),
      further_things_(further_things),
      axes_(axes_of(info_of(*tests.library(), job_.task), job_.variation)),
      assets_(assets_of(*tests.library(), std::move(assets))),
      first_(make(0)) {
  tests_.set_hand(first_.hand);
}

LuaTask::Drawn LuaTask::make(int draw) {
  const ScriptFile* file = tests_.library()->file(DefinitionKind::task, job_.task);
  if (file == nullptr) throw Error(job_.task, "there is no task of this name");
  ScriptState scripts(tests_.library(), "");
  const RandomKey key = RandomKey("draw").with(job_.task).with(job_.variation).with(job_.seed).with(draw);
  Drawn drawn;
  scripts.protect(
      [&](lua_State* state) { drawn = TaskReader(scripts, *file, axes_, key, *assets_).read(state, further_things_); });
  drawn.task.name = job_.task;
  drawn.task.variation = job_.variation;
  drawn.task.axes = axes_;
  if (drawn.also || drawn.fails || drawn.reward) drawn.task.named = read_by_name(*tests_.library(), *file);
  return drawn;
}

Task LuaTask::draw(int number) { return with_functions(number == 0 ? first_ : make(number)); }

Task LuaTask::with_functions(const Drawn& drawn) {
  Task task = drawn.task;
  if (drawn.also) task.also = [this](const WorldView& view) { return ask("also", view); };
  if (drawn.fails) task.fails = [this](const WorldView& view) { return ask("fails", view); };
  if (drawn.reward) task.reward = [this](const WorldView& view) { return number("reward", view); };
  return task;
}

int LuaTask::keep_variation() {
  ScriptState& scripts = tests_.get();
  int reference = 0;
  scripts.protect([&](lua_State* state) {
    scripts.definitions().push(DefinitionKind::task, job_.task);
    push_variation(state, lua_gettop(state), axes_, first_.files.front()->shown_path);
    reference = luaL_ref(state, LUA_REGISTRYINDEX);
  });
  return reference;
}

void LuaTask::call_function(const char* field, const WorldView& view) {
  ScriptState& scripts = tests_.get();
  if (generation_ != tests_.generation()) {
    functions_.clear();
    v_ = 0;
    generation_ = tests_.generation();
  }
  auto found = functions_.find(field);
  if (found == functions_.end())
    found = functions_.emplace(field, scripts.function_of(DefinitionKind::task, job_.task, field)).first;
  if (v_ == 0) v_ = keep_variation();
  const ViewScope scope(scripts.view, view, ViewScope::Facts::readable);
  scripts.push_kept(found->second);
  scripts.push_kept(scripts.view_reference());
  scripts.push_kept(v_);
  try {
    scripts.sandbox().call(2, 1);
  } catch (const Error& error) {
    throw ScriptError(error.where(), error.message(), error.hint());
  }
}

bool LuaTask::ask(const char* field, const WorldView& view) {
  call_function(field, view);
  lua_State* const state = tests_.get().lua();
  const bool result = lua_toboolean(state, -1) != 0;
  lua_pop(state, 1);
  return result;
}

double LuaTask::number(const char* field, const WorldView& view) {
  call_function(field, view);
  lua_State* const state = tests_.get().lua();
  const bool number = lua_type(state, -1) == LUA_TNUMBER;
  const double result = lua_tonumber(state, -1);
  const std::string found = number ? "" : luaL_typename(state, -1);
  lua_pop(state, 1);
  if (number && std::isfinite(result)) return result;
  throw ScriptError(first_.files.front()->shown_path,
                    "reward gives " + (number ? "a number that is not finite" : "a " + found) + " at " +
                        std::to_string(view.time_s()) + " s",
                    "return a number; look for divisions by 0");
}

}  // namespace stampede
