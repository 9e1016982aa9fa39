// v: the variation as a task's functions see it.
#pragma once

#include <map>
#include <string>

struct lua_State;

namespace stampede {

// Pushes v: each axis with the value that the file gives it, of its own kind (a number, not its digits), found by its
// text. `task` is the stack index of the task's table. Throws Error; call it inside a protected call.
void push_variation(lua_State* state, int task, const std::map<std::string, std::string>& axes,
                    const std::string& file);

}  // namespace stampede
