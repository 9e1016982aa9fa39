// What Lua sees of the robot inside a skill's `run`: each method that acts hands one RobotCall to the engine.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "engine/start/robot_call.h"
#include "scripting/library/library.h"
#include "scripting/runtime/view_binding.h"

struct lua_State;

namespace stampede {

// One for each Lua state, which it outlives.
struct RobotContext {
  ViewContext* view = nullptr;
  const Library* library = nullptr;
  lua_State* running = nullptr;   // the coroutine that may act now; nullptr: none
  std::optional<RobotCall> call;  // what it yielded for
};

// Pushes `robot`, one userdata for each state. README.md lists the methods.
void push_robot(lua_State* state, RobotContext& context, int view_index);

// The call act.place("cup", "shelf", { height = 0.2 }) at a stack index. Arguments not named are empty: the runner
// binds them. Throws Error, at `place`, for what the skill does not have and for values out of their bounds.
AskedCall asked_call_at(lua_State* state, int index, const Library& library, const std::string& place);

}  // namespace stampede
