#include <algorithm>
#include <lua.hpp>

#include "scripting/library/builder.h"
#include "scripting/library/naming.h"
#include "scripting/lua/binding.h"

namespace stampede {
namespace {

constexpr std::size_t kMostVariations = 10'000;

int push_protected(lua_State* state) {
  const auto* node = static_cast<const Value*>(lua_touserdata(state, 1));
  lua_settop(state, 0);
  push_node(state, *node);
  return 1;
}

bool is_plain(const Value& value) { return value.is_text() || value.is_number() || value.kind == Value::Kind::boolean; }

Value table_of_nothing() {
  Value node;
  node.kind = Value::Kind::table;
  return node;
}

}  // namespace

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

std::string variation_text(const Value& variation) {
  std::string text;
  for (const auto& [axis, value] : variation.fields) text += (text.empty() ? "" : ",") + axis + "=" + plain_text(value);
  return text;
}

// The product of the axes (the first in alphabetical order varies slowest) or the list, without what `where` leaves
// out.
std::vector<Value> LibraryBuilder::variations_of(const Definition& definition, DefinitionState& state) {
  const Value& written = definition.node["variations"];
  std::vector<Value> all;
  if (!written.items.empty()) {
    all = written.items;
  } else {
    all.push_back(table_of_nothing());
    for (const auto& [axis, values] : written.fields) {
      const std::string path = "variations." + axis;
      if (const auto fault = name_fault(axis))
        complain(definition, path, "the name '" + axis + "' " + *fault, "such as '" + proposed_name(axis) + "'");
      if (!values.is_table() || values.items.empty() || !values.tag().empty()) {
        throw error_at(definition, path, "an axis is a list of values, this is " + values.type_name(),
                       "such as " + axis + " = { 1, 2 }");
      }
      std::vector<Value> longer;
      for (const Value& before : all) {
        for (const Value& value : values.items) {
          longer.push_back(before);
          longer.back().fields[axis] = value;
        }
      }
      if (longer.size() > kMostVariations)
        throw error_at(definition, "variations", "more than 10000 variations", "leave an axis out");
      all = std::move(longer);
    }
  }
  std::vector<Value> kept;
  std::vector<std::string> texts;
  for (const Value& variation : all) {
    for (const auto& [axis, value] : variation.fields) {
      if (!is_plain(value))
        throw error_at(definition, "variations", "the value of '" + axis + "' is " + value.type_name(),
                       "values are numbers, texts, true and false");
    }
    if (definition.node["where"].is_function()) {
      lua_State* lua = state.state();
      state.push(DefinitionKind::task, definition.file->name);
      lua_getfield(lua, -1, "where");
      lua_pushcfunction(lua, lua_function<push_protected>);
      lua_pushlightuserdata(lua, const_cast<Value*>(&variation));
      state.sandbox().call(1, 1);
      state.sandbox().call(1, 1);
      const bool keep = lua_toboolean(lua, -1) != 0;
      lua_settop(lua, 0);
      if (!keep) continue;
    }
    const std::string text = variation_text(variation);
    if (std::find(texts.begin(), texts.end(), text) != texts.end()) {
      complain(definition, "variations", "the variation '" + text + "' is listed twice", "leave one out");
      continue;
    }
    texts.push_back(text);
    kept.push_back(variation);
  }
  if (kept.empty()) throw error_at(definition, "where", "where leaves no variation", "");
  return kept;
}

// A field's value for a variation: functions of it are called.
Value LibraryBuilder::field_for(const Definition& definition, DefinitionState& state, const char* field,
                                const Value& variation) {
  if (!definition.node[field].is_function()) return definition.node[field];
  lua_State* lua = state.state();
  state.push(DefinitionKind::task, definition.file->name);
  lua_getfield(lua, -1, field);
  lua_pushcfunction(lua, lua_function<push_protected>);
  lua_pushlightuserdata(lua, const_cast<Value*>(&variation));
  state.sandbox().call(1, 1);
  try {
    state.sandbox().call(1, 1);
  } catch (const Error& error) {
    if (!error.where().empty()) throw;
    throw error_at(definition, field, error.message(), error.hint());  // the call that failed was a function's last
  }
  Value result = value_as_written(lua, -1, definition.file->shown_path);
  lua_settop(lua, 0);
  return result;
}

}  // namespace stampede
