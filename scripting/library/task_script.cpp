#include "scripting/library/task_script.h"

#include <algorithm>
#include <lua.hpp>

#include "scripting/library/lua_value.h"
#include "scripting/lua/binding.h"

namespace stampede {
namespace {

constexpr std::size_t kMostVariations = 10'000;

void push_node(lua_State* state, const Value& node) {
  luaL_checkstack(state, 4, "value nested too deeply");
  switch (node.kind) {
    case Value::Kind::boolean:
      lua_pushboolean(state, node.boolean);
      break;
    case Value::Kind::number:
      if (node.integer) {
        lua_pushinteger(state, static_cast<lua_Integer>(node.number));
      } else {
        lua_pushnumber(state, node.number);
      }
      break;
    case Value::Kind::text:
      lua_pushlstring(state, node.text.data(), node.text.size());
      break;
    case Value::Kind::table:
      lua_createtable(state, static_cast<int>(node.items.size()), static_cast<int>(node.fields.size()));
      for (std::size_t i = 0; i < node.items.size(); ++i) {
        push_node(state, node.items[i]);
        lua_rawseti(state, -2, static_cast<lua_Integer>(i) + 1);
      }
      for (const auto& [key, field] : node.fields) {
        push_node(state, field);
        lua_setfield(state, -2, key.c_str());
      }
      break;
    default:
      lua_pushnil(state);
  }
}

// Arguments: the variation as a Value, the task's `variations`.
int push_protected(lua_State* state) {
  push_node(state, *static_cast<const Value*>(lua_touserdata(state, 1)));
  name_axes(state, 3, 2);
  lua_settop(state, 3);
  return 1;
}

bool is_plain(const Value& value) { return value.is_text() || value.is_number() || value.kind == Value::Kind::boolean; }

Value table_of_nothing() {
  Value node;
  node.kind = Value::Kind::table;
  return node;
}

}  // namespace

std::string variation_text(const Value& variation) {
  std::string text;
  for (const auto& [axis, value] : variation.fields) text += (text.empty() ? "" : ",") + axis + "=" + plain_text(value);
  return text;
}

std::vector<Value> TaskScript::variations() {
  std::vector<Value> kept;
  std::vector<std::string> texts;
  const Value& written = definition_.node["variations"];
  for (const Value& variation : written.items.empty() ? product(written) : written.items) {
    for (const auto& [axis, value] : variation.fields) {
      if (!is_plain(value))
        throw definition_.error("variations", "the value of '" + axis + "' is " + value.type_name(),
                                "values are numbers, texts, true and false");
    }
    if (definition_.node["where"].is_function() && !keeps(variation)) continue;
    const std::string text = variation_text(variation);
    if (listed(texts, text)) {
      definition_.complain("variations", "the variation '" + text + "' is listed twice", "leave one out");
      continue;
    }
    texts.push_back(text);
    kept.push_back(variation);
  }
  if (kept.empty()) throw definition_.error("where", "where leaves no variation", "");
  return kept;
}

// Of the axes: the first in alphabetical order varies slowest.
std::vector<Value> TaskScript::product(const Value& axes) const {
  std::vector<Value> all = {table_of_nothing()};
  for (const auto& [axis, values] : axes.fields) {
    const std::string path = "variations." + axis;
    check_name(axis, path, definition_.complainer());
    if (!values.is_table() || values.items.empty() || !values.tag().empty())
      throw definition_.error(path, "an axis is a list of values, this is " + values.type_name(),
                              "such as " + axis + " = { 1, 2 }");
    std::vector<Value> longer;
    for (const Value& before : all) {
      for (const Value& value : values.items) {
        longer.push_back(before);
        longer.back().fields[axis] = value;
      }
    }
    if (longer.size() > kMostVariations)
      throw definition_.error("variations", "more than 10000 variations", "leave an axis out");
    all = std::move(longer);
  }
  return all;
}

// Leaves the field's function and its argument on the stack.
void TaskScript::push_function(const char* field, const Value& variation) {
  lua_State* lua = state_.state();
  state_.push(DefinitionKind::task, definition_.file->name);
  const int task = lua_gettop(lua);
  lua_getfield(lua, task, field);
  lua_pushcfunction(lua, lua_function<push_protected>);
  lua_pushlightuserdata(lua, const_cast<Value*>(&variation));
  lua_getfield(lua, task, "variations");
  state_.sandbox().call(2, 1);
}

bool TaskScript::keeps(const Value& variation) {
  push_function("where", variation);
  state_.sandbox().call(1, 1);
  const bool keep = lua_toboolean(state_.state(), -1) != 0;
  lua_settop(state_.state(), 0);
  return keep;
}

Value TaskScript::field(const char* name, const Value& variation) {
  if (!definition_.node[name].is_function()) return definition_.node[name];
  push_function(name, variation);
  try {
    state_.sandbox().call(1, 1);
  } catch (const Error& error) {
    if (!error.where().empty()) throw;
    throw definition_.error(name, error.message(), error.hint());  // the call that failed was a function's last
  }
  Value result = value_as_written(state_.state(), -1, definition_.file->shown_path);
  lua_settop(state_.state(), 0);
  return result;
}

}  // namespace stampede
