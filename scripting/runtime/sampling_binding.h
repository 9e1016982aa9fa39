// The part of `w` that draws: places and joint positions. For the runtime's own use.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/start/predicates.h"
#include "scripting/runtime/view_binding.h"

namespace stampede {

inline constexpr const char* kViewType = "stampede.view";
const ViewContext& check_context(lua_State* state);  // of `w`, argument 1; raises a Lua error

// Adds the sampling methods to the table on top of the stack:
//   w:free_spots(surface, object, rng)              poses on top of a surface, free of all other things
//   w:region_spots(region, object, rng [, floating])  poses in a region
//   w:stack_spots(below, object, rng)               the pose on top of another object
//   w:joint_at(part, position)                      a joint position
//   w:joint_between(part, low, high, rng)           joint positions drawn evenly
//   w:place(object, pose)                           a pose of another object than the literal's first
void add_sampling_methods(lua_State* state);

// The results of a predicate's `sample` at the top of the stack; `object` is whom a bare pose moves.
std::vector<Placement> placements_at(lua_State* state, int index, const std::string& object, const std::string& place);

}  // namespace stampede
