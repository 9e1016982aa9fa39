// URDF files (liburdfdom) as bodies.
#pragma once

#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/file_scope.h"
#include "engine/model/drawn_assets.h"

namespace stampede {

struct UrdfBody {
  Body body;
  DrawnAssets drawn;           // what its shapes of kind mesh and their textures are
  std::vector<Error> remarks;  // what was put right or left aside, and is worth knowing
};

// Reads a URDF into a body whose parts are its links in depth-first order, base first; fixed joints stay parts.
// Collision shapes collide, visual shapes are seen; a link without visuals shows its collision shapes.
// Masses and inertias that no body has are put right (inertials.h), as of a body whose base stands still; where it is
// `free`, they stay as they are: who knows what it weighs puts them right. Names of mesh and texture files are relative
// to the URDF, or those of ROS: see urdf_files.h; each mesh collides as one hull per node, and is drawn as it is, in
// the colour and texture of the visual's material or else of its file. Mimic joints are kept by name. Files that it
// names lie in the scope: by default in its folder. Throws Error with the file, the element and the cure.
UrdfBody read_urdf(const std::filesystem::path& file);
UrdfBody read_urdf(const std::filesystem::path& file, const FileScope& scope, bool free = false);

}  // namespace stampede
