// What a record says of the scene in which it took place, whether that was simulated or recorded.
#pragma once

#include <vector>

#include "engine/model/scene.h"
#include "engine/record/record.h"

namespace stampede {

// All that can move, the robot's first.
std::vector<JointName> joints_of(const Scene& scene);

// World, rates, scene, objects, cameras, masks and hands. The scene has its masks numbered.
void describe_scene(const Scene& scene, EpisodeRecord& record);

}  // namespace stampede
