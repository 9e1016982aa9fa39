// One object, or one world, by itself.
#pragma once

#include <memory>
#include <string>

#include "engine/model/scene.h"
#include "scripting/library/library.h"

namespace stampede {

class Assets;

// A scene of the object alone, as its file has it, its draws by a fixed seed; numbered (masks.h), without a robot.
// Throws Error for bad scripts.
// `assets`: as of EpisodeScripts.
Scene object_scene(std::shared_ptr<const Library> library, const std::string& object,
                   std::shared_ptr<Assets> assets = nullptr);

// A world's robot, fixtures, cameras and sensors, as a task without objects would have them. Throws as object_scene.
Scene world_scene(const std::shared_ptr<const Library>& library, const std::string& world,
                  std::shared_ptr<Assets> assets = nullptr);

}  // namespace stampede
