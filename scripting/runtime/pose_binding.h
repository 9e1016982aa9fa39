// Poses in Lua: `pose(x, y, z)`, p:offset(x, y, z), p:along(d), p * q …
#pragma once

#include <optional>

#include "engine/geometry/transform.h"

struct lua_State;

namespace stampede {

// Makes the type known to a state and defines the global `pose`. Units: m, rad.
//   pose(x, y, z [, roll, pitch, yaw])   pose{ at = …, yaw | rpy | quaternion = … }
//   p:position() -> x, y, z              p:rpy() -> roll, pitch, yaw      p:quaternion() -> x, y, z, w
//   p:offset(x, y, z)  moved along the world's axes       p:along(x, y, z)  along its own axes
//   p:rotated(roll, pitch, yaw)  about its own axes       p:turned(yaw)     about the world's z through its origin
//   p:times(q), p * q  composition       p:inverse()      p:with_position(x, y, z)
void register_poses(lua_State* state);

void push_pose(lua_State* state, const Transform& pose);
std::optional<Transform> pose_at(lua_State* state, int index);  // nothing: not a pose
Transform check_pose(lua_State* state, int index);              // raises a Lua error

}  // namespace stampede
