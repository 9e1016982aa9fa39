#include "scripting/runtime/evaluate.h"

#include <algorithm>
#include <cmath>
#include <lua.hpp>

#include "engine/base/utf8.h"
#include "scripting/library/lua_value.h"
#include "scripting/runtime/pose_binding.h"

namespace stampede {
namespace {

constexpr int kDeepest = 32;

std::string joined(const std::string& path, const std::string& step) { return path.empty() ? step : path + "." + step; }

std::string place_of(const Evaluation& how, const std::string& path) {
  return path.empty() ? how.file : how.file + ": " + path;
}

// String keys in order: a table's own order changes from run to run.
std::vector<std::string> sorted_keys(lua_State* state, int index, const std::string& place) {
  std::vector<std::string> keys;
  lua_pushnil(state);
  while (lua_next(state, index) != 0) {
    lua_pop(state, 1);
    if (lua_type(state, -1) == LUA_TSTRING) {
      std::size_t length = 0;
      const char* text = lua_tolstring(state, -1, &length);
      keys.emplace_back(text, length);
    } else if (!lua_isinteger(state, -1)) {
      throw Error(place, "a key that is neither a name nor a whole number");
    }
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

Value read(lua_State* state, int index, const Evaluation& how, const std::string& path, int depth);

// { x, y } or { x, y, above } as { x, y, z }.
Value on_table(Value value, const Evaluation& how) {
  if (!how.table_top)
    throw Error(value.place, "on_table stands where there is no table",
                "it is for `at` of a task's objects, in a world whose fixtures have a table; else write { x, y, z }");
  value.fields.clear();
  double height = *how.table_top;
  if (value.items.size() < 3)
    value.items.push_back(value.items.at(1));
  else
    height += value.items[2].as_number();
  value.items[2].number = height;
  value.items[2].integer = false;
  return value;
}

Value read_table(lua_State* state, int index, const Evaluation& how, const std::string& path, int depth) {
  Value value;
  value.kind = Value::Kind::table;
  value.place = place_of(how, path);
  if (depth >= kDeepest) throw Error(value.place, "tables nested too deeply", "does a table hold itself?");
  for (const std::string& key : sorted_keys(state, index, value.place)) {
    if (depth == 0 && std::find(how.skip.begin(), how.skip.end(), key) != how.skip.end()) continue;
    lua_pushlstring(state, key.data(), key.size());
    lua_rawget(state, index);
    Value field = read(state, lua_gettop(state), how, joined(path, key), depth + 1);
    lua_pop(state, 1);
    if (field.present()) value.fields.emplace(key, std::move(field));
  }
  const auto length = static_cast<lua_Integer>(lua_rawlen(state, index));
  for (lua_Integer i = 1; i <= length; ++i) {
    lua_rawgeti(state, index, i);
    value.items.push_back(read(state, lua_gettop(state), how, joined(path, std::to_string(i)), depth + 1));
    lua_pop(state, 1);
  }
  if (value.tag() == "on_table") return on_table(std::move(value), how);
  return is_draw(value) ? draw(value, how.key.with(path)) : value;
}

Value read(lua_State* state, int index, const Evaluation& how, const std::string& path, int depth) {
  luaL_checkstack(state, 8, "definition nested too deeply");
  if (lua_istable(state, index)) return read_table(state, index, how, path, depth);
  if (lua_isfunction(state, index) && how.variation != 0) {
    lua_pushvalue(state, index);
    lua_pushvalue(state, how.variation);
    lua_call(state, 1, 1);
    Value result = read(state, lua_gettop(state), how, path, depth + 1);
    lua_pop(state, 1);
    return result;
  }
  Value value = lua_isfunction(state, index) ? Value() : plain_value(state, index);
  value.place = place_of(how, path);
  if (value.is_number() && !std::isfinite(value.number)) throw Error(value.place, "a number that is not finite");
  if (value.is_text() && not_text_at(value.text) != std::string::npos)
    throw Error(value.place, "a text that is no UTF-8", "write letters as they are, without escapes such as \\xE9");
  if (value.kind == Value::Kind::other) {
    const std::optional<Transform> pose = pose_at(state, index);
    if (!pose) throw Error(value.place, "cannot hold a " + value.text);
    value.kind = Value::Kind::pose;
    value.pose = *pose;
  }
  return value;
}

// The list that one_of and sample_of draw from.
const std::vector<Value>& choices(const Value& value) {
  const Value& set = value["values"].present() ? value["values"] : value["set"];
  const Value& list = set.present() ? set : value;
  if (list.items.empty()) value.expected("at least one value to draw from");
  return list.items;
}

Value draw_sample(const Value& value, Random& random) {
  std::vector<Value> left = choices(value);
  const auto count = static_cast<std::size_t>(value.number_or("n", value.number_or("count", 1)));
  if (count > left.size()) {
    throw Error(value.place,
                "sample_of draws " + std::to_string(count) + " of " + std::to_string(left.size()) + " values",
                "draw fewer, or from a larger set");
  }
  Value sample;
  sample.kind = Value::Kind::table;
  sample.place = value.place;
  sample.fields["sampled"].kind = Value::Kind::boolean;  // told from a list that the author wrote
  for (std::size_t i = 0; i < count; ++i) {
    const auto chosen = static_cast<std::ptrdiff_t>(random.below(static_cast<std::int64_t>(left.size())));
    sample.items.push_back(left[static_cast<std::size_t>(chosen)]);
    left.erase(left.begin() + chosen);
  }
  return sample;
}

}  // namespace

bool is_draw(const Value& value) {
  const std::string tag = value.tag();
  return tag == "one_of" || tag == "between" || tag == "sample_of";
}

Value draw(const Value& value, RandomKey key) {
  Random random(key);
  const std::string tag = value.tag();
  if (tag == "one_of") {
    const std::vector<Value>& list = choices(value);
    return list[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(list.size())))];
  }
  if (tag == "sample_of") return draw_sample(value, random);
  if (tag != "between") return value;
  Value number;
  number.kind = Value::Kind::number;
  number.place = value.place;
  const double low = value["low"].as_number(), high = value["high"].as_number();
  if (high < low) throw Error(value.place, "between(low, high) needs low <= high");
  number.number = random.between(low, high);
  return number;
}

Value read_value(lua_State* state, int index, const Evaluation& how, const std::string& path) {
  return read(state, lua_absindex(state, index), how, path, 0);
}

Transform transform_from(const Value& table) {
  const Value& at = table["at"];
  if (at.kind == Value::Kind::pose) return at.pose;
  const Vector3 origin = at.present() ? at.as_vector() : Vector3::Zero();
  Vector3 rpy = table.vector_or("rpy", Vector3::Zero());
  rpy.z() += table.number_or("yaw", 0);
  Transform pose = translation(origin) * rotation_rpy(rpy.x(), rpy.y(), rpy.z());
  if (const Value& quaternion = table["quaternion"]; quaternion.present()) {
    const std::vector<double> xyzw = quaternion.as_numbers();
    if (xyzw.size() != 4) quaternion.expected("four numbers { x, y, z, w }");
    pose = make_transform(origin, Quaternion(xyzw[3], xyzw[0], xyzw[1], xyzw[2]).normalized());
  }
  return pose;
}

}  // namespace stampede
