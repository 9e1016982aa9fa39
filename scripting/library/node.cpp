#include "scripting/library/node.h"

#include <cstdio>
#include <lua.hpp>

#include "engine/base/error.h"
#include "scripting/lua/binding.h"

namespace stampede {
namespace {

constexpr int kDeepest = 24;
constexpr int kMostNodes = 200'000;

struct Reading {
  Node* result;
  std::string place;
  int count = 0;
};

Node read(lua_State* state, int index, Reading& reading, int depth);

Node read_table(lua_State* state, int index, Reading& reading, int depth) {
  Node node;
  node.kind = Node::Kind::table;
  if (depth > kDeepest) throw Error(reading.place, "tables nested too deeply", "does a table hold itself?");
  const auto length = static_cast<lua_Integer>(lua_rawlen(state, index));
  node.items.reserve(static_cast<std::size_t>(length));
  for (lua_Integer i = 1; i <= length; ++i) {
    lua_rawgeti(state, index, i);
    node.items.push_back(read(state, lua_gettop(state), reading, depth + 1));
    lua_pop(state, 1);
  }
  lua_pushnil(state);
  while (lua_next(state, index) != 0) {
    if (lua_type(state, -2) == LUA_TSTRING) {
      std::size_t size = 0;
      const char* key = lua_tolstring(state, -2, &size);
      node.fields.emplace(std::string(key, size), read(state, lua_gettop(state), reading, depth + 1));
    } else if (!lua_isinteger(state, -2) || lua_tointeger(state, -2) < 1 || lua_tointeger(state, -2) > length) {
      node.odd_keys = true;
    }
    lua_pop(state, 1);
  }
  return node;
}

Node read(lua_State* state, int index, Reading& reading, int depth) {
  if (++reading.count > kMostNodes) throw Error(reading.place, "more than 200000 values in one definition");
  luaL_checkstack(state, 8, "definition nested too deeply");
  Node node;
  switch (lua_type(state, index)) {
    case LUA_TNIL:
      break;
    case LUA_TBOOLEAN:
      node.kind = Node::Kind::boolean;
      node.boolean = lua_toboolean(state, index) != 0;
      break;
    case LUA_TNUMBER:
      node.kind = Node::Kind::number;
      node.number = lua_tonumber(state, index);
      node.integer = lua_isinteger(state, index) != 0;
      break;
    case LUA_TSTRING: {
      std::size_t size = 0;
      const char* text = lua_tolstring(state, index, &size);
      node.kind = Node::Kind::text;
      node.text.assign(text, size);
      break;
    }
    case LUA_TTABLE:
      return read_table(state, index, reading, depth);
    case LUA_TFUNCTION:
      node.kind = Node::Kind::function;
      break;
    default:
      node.kind = Node::Kind::other;
      node.text = luaL_typename(state, index);
  }
  return node;
}

int read_protected(lua_State* state) {
  auto* reading = static_cast<Reading*>(lua_touserdata(state, 2));
  *reading->result = read(state, 1, *reading, 0);
  return 0;
}

}  // namespace

const Node& Node::operator[](std::string_view field) const {
  static const Node kNothing;
  const auto found = fields.find(field);
  return found == fields.end() ? kNothing : found->second;
}

std::string Node::tag() const { return (*this)["tag"].text; }
int Node::line() const { return static_cast<int>((*this)["line"].number); }

namespace {

std::string quoted(const std::string& text) {
  const bool long_one = text.size() > 40;
  std::string said = "the text \"";  // piece by piece: GCC 12 warns of a sum where there is nothing wrong
  said.append(text, 0, long_one ? 37 : text.size());
  if (long_one) said += "...";
  said += '"';
  return said;
}

}  // namespace

std::string Node::type_name() const {
  switch (kind) {
    case Kind::nothing:
      return "nothing";
    case Kind::boolean:
      return boolean ? "true" : "false";
    case Kind::number:
      return "the number " + plain_text(*this);
    case Kind::text:
      return quoted(text);
    case Kind::table:
      return tag().empty() ? "a table" : "a " + tag();
    case Kind::function:
      return "a function";
    case Kind::other:
      return "a " + text;
  }
  return {};
}

Node read_node(lua_State* state, int index, const std::string& place) {
  Node result;
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

std::string plain_text(const Node& node) {
  switch (node.kind) {
    case Node::Kind::boolean:
      return node.boolean ? "true" : "false";
    case Node::Kind::text:
      return node.text;
    case Node::Kind::number: {
      char text[40];
      if (node.integer) {
        std::snprintf(text, sizeof text, "%.0f", node.number);
        return text;
      }
      for (int digits = 6; digits <= 17; ++digits) {  // the shortest that reads back as the same number
        std::snprintf(text, sizeof text, "%.*g", digits, node.number);
        double back = 0;
        std::sscanf(text, "%lf", &back);
        if (back == node.number) break;
      }
      return text;
    }
    case Node::Kind::table: {
      std::string text = "{";
      for (const Node& item : node.items) text += (text.size() > 1 ? "," : "") + plain_text(item);
      for (const auto& [key, field] : node.fields) text += (text.size() > 1 ? "," : "") + key + "=" + plain_text(field);
      return text + "}";
    }
    default:
      return {};
  }
}

}  // namespace stampede
