// URDF files (liburdfdom) as bodies.
#pragma once

#include <filesystem>

#include "engine/model/scene.h"

namespace stampede {

// Reads a URDF into a body whose parts are its links in depth-first order, base first; fixed joints stay parts.
// Collision shapes collide, visual shapes are seen; a link without visuals shows its collision shapes.
// Mesh file names resolve beside the URDF; each mesh becomes one hull per node. Mimic joints are kept by name.
// Throws Error with the file, the element and the cure.
Body body_from_urdf(const std::filesystem::path& file);

}  // namespace stampede
