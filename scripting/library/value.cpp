#include "scripting/library/value.h"

#include <cstdio>
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

const Value& Value::operator[](std::string_view field) const {
  static const Value kNothing;
  const auto found = fields.find(field);
  return found == fields.end() ? kNothing : found->second;
}

std::string Value::tag() const {
  const Value& value = (*this)["tag"];
  return value.is_text() ? value.text : std::string();
}

int Value::line() const { return static_cast<int>((*this)["line"].number); }

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

std::string Value::type_name() const {
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
    case Kind::pose:
      return "a pose";
    case Kind::function:
      return "a function";
    case Kind::other:
      return "a " + text;
  }
  return {};
}

void Value::expected(std::string_view what) const {
  throw Error(place, "expected " + std::string(what) + ", found " + type_name());
}

double Value::as_number() const {
  if (kind != Kind::number) expected("a number");
  return number;
}

bool Value::as_boolean() const {
  if (kind != Kind::boolean) expected("true or false");
  return boolean;
}

const std::string& Value::as_text() const {
  if (kind != Kind::text) expected("a text");
  return text;
}

Vector3 Value::as_vector() const {
  if (kind != Kind::table || items.size() != 3) expected("three numbers { x, y, z }");
  return Vector3(items[0].as_number(), items[1].as_number(), items[2].as_number());
}

std::vector<double> Value::as_numbers() const {
  if (kind != Kind::table) expected("a list of numbers");
  std::vector<double> numbers;
  for (const Value& item : items) numbers.push_back(item.as_number());
  return numbers;
}

std::vector<std::string> Value::as_texts() const {
  if (kind == Kind::text) return {text};
  if (kind != Kind::table) expected("a list of texts");
  std::vector<std::string> texts;
  for (const Value& item : items) texts.push_back(item.as_text());
  return texts;
}

double Value::number_or(std::string_view field, double otherwise) const {
  const Value& value = (*this)[field];
  return value.present() ? value.as_number() : otherwise;
}

bool Value::boolean_or(std::string_view field, bool otherwise) const {
  const Value& value = (*this)[field];
  return value.present() ? value.as_boolean() : otherwise;
}

std::string Value::text_or(std::string_view field, std::string_view otherwise) const {
  const Value& value = (*this)[field];
  return value.present() ? value.as_text() : std::string(otherwise);
}

Vector3 Value::vector_or(std::string_view field, const Vector3& otherwise) const {
  const Value& value = (*this)[field];
  return value.present() ? value.as_vector() : otherwise;
}

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

std::string plain_text(const Value& value) {
  switch (value.kind) {
    case Value::Kind::boolean:
      return value.boolean ? "true" : "false";
    case Value::Kind::text:
      return value.text;
    case Value::Kind::number: {
      char text[40];
      if (value.integer) {
        std::snprintf(text, sizeof text, "%.0f", value.number);
        return text;
      }
      for (int digits = 6; digits <= 17; ++digits) {  // the shortest that reads back as the same number
        std::snprintf(text, sizeof text, "%.*g", digits, value.number);
        double back = 0;
        std::sscanf(text, "%lf", &back);
        if (back == value.number) break;
      }
      return text;
    }
    case Value::Kind::table: {
      std::string text = "{";
      for (const Value& item : value.items) text += (text.size() > 1 ? "," : "") + plain_text(item);
      for (const auto& [key, field] : value.fields)
        text += (text.size() > 1 ? "," : "") + key + "=" + plain_text(field);
      return text + "}";
    }
    default:
      return {};
  }
}

}  // namespace stampede
