// A Lua value as a plain C++ tree, which no script can change or fail.
#pragma once

#include <string>

#include "engine/geometry/value.h"

struct lua_State;

namespace stampede {

// nil, a boolean, a number or a text at `index`; anything else is `other`. Raises no error of Lua.
Value plain_value(lua_State* state, int index);

// The value at `index` with nothing called and nothing drawn; the stack is left as it was. Throws Error for trees
// deeper than 24 or larger than 200,000 values.
Value value_as_written(lua_State* state, int index, const std::string& place);

}  // namespace stampede
