// robot:follow { … } and robot:tilt(…): the pieces of a way, read from Lua.
#pragma once

#include "engine/start/robot_call.h"
#include "engine/start/world_view.h"

struct lua_State;

namespace stampede {

// The list at index 2 and the options at index 3. Raises Lua errors that say which piece is wrong.
robot_call::Follow follow_at(lua_State* state, const WorldView& view);

// The list at `index`, of pieces that go as `all` where they say nothing else.
std::vector<robot_call::Piece> pieces_at(lua_State* state, int index, const WorldView& view,
                                         const robot_call::Piece& all = {});

// The angle at index 2 and the options at index 3.
robot_call::Follow tilt_at(lua_State* state, const WorldView& view);

}  // namespace stampede
