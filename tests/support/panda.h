// The Panda and a table with cubes, in C++, for tests and benchmarks that run without Lua.
#pragma once

#include "engine/model/scene.h"

namespace stampede {

// Reads worlds/robots/panda.urdf. Parts: link0 … link7, flange, hand, left_finger, right_finger.
Robot panda_robot(const Transform& world_from_base = Transform::Identity());

// The Panda at the origin, a fixed table in front of it whose top is the plane z = 0, and free cubes cube1 … cubeN of
// 4 cm and 0.1 kg that rest on it 9 cm or more apart. At most 30.
Scene table_scene(int cubes);

}  // namespace stampede
