// One object by itself, for its portrait.
#pragma once

#include <memory>
#include <string>

#include "engine/model/scene.h"
#include "scripting/library/library.h"

namespace stampede {

// A scene of the object alone, as its file has it, its draws by a fixed seed; numbered (masks.h), without a robot.
// Throws Error for bad scripts.
Scene object_scene(std::shared_ptr<const Library> library, const std::string& object);

}  // namespace stampede
