// Mesh files as assimp's scenes; inside this folder.
#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>

#include "engine/geometry/transform.h"

namespace stampede {

inline constexpr const char* kMeshCure = "write it again as OBJ, STL, DAE, PLY or GLB with triangles, in metres";

// Reads a file; `removed` are aiComponents that go first, `steps` aiPostProcessSteps. A DAE file's up axis is ignored,
// its unit is applied. Lifetime: the scene is the importer's. Throws Error, for a bad `scale` too.
const aiScene& import_scene(Assimp::Importer& importer, const std::filesystem::path& file, const Vector3& scale,
                            unsigned removed, unsigned steps);

}  // namespace stampede
