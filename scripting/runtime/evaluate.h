// From Lua to Value: walks a definition, calls its functions of the variation and makes its draws.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "engine/base/random.h"
#include "engine/geometry/value.h"

struct lua_State;

namespace stampede {

// Draws are pure functions of (key, path of the value): reading a field twice gives the same value, and a new field
// changes no other.
struct Evaluation {
  RandomKey key;
  int variation = 0;                     // stack index of v, the argument of functions; 0: functions are left out
  std::string file;                      // starts messages: `tasks/stack.lua`
  std::vector<std::string> skip;         // fields of the outermost table that are left alone
  std::optional<double> table_top = {};  // height that on_table means, m; nothing: it means none here
};

// Reads the value at `index` (the stack is left as it was). `path` names it: `objects.block1`.
// Throws Error; runs Lua, so call it inside a protected call.
Value read_value(lua_State* state, int index, const Evaluation& how, const std::string& path);

// The draw of a tagged value (one_of, between, sample_of) whose fields have been read; others are returned as they are.
Value draw(const Value& value, RandomKey key);
bool is_draw(const Value& value);

// A pose written as fields: at = { x, y, z } and one of yaw = rad, rpy = { r, p, y }, quaternion = { x, y, z, w }.
Transform transform_from(const Value& table);

}  // namespace stampede
