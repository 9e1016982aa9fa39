// Mesh files as assimp's scenes; inside this folder, and inside of a child process (careful.h) only.
#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>

#include "engine/geometry/careful.h"

namespace stampede {

inline constexpr const char* kMeshCure = "write it again as OBJ, STL, DAE, PLY or GLB with triangles, in metres";
inline constexpr int kDeepestNode = 256;
inline constexpr double kFarthest = 1e6;                  // m, of a corner from the root's origin
inline constexpr std::size_t kMostTriangles = 2'000'000;  // of a file, what is placed twice counted twice

// How a file is read: what it may name, and what it named.
struct ImportContext {
  const std::filesystem::path& file;
  const FileScope& scope;
  Companions& companions;
};

// Reads a file; `removed` are aiComponents that go first, `steps` aiPostProcessSteps. A DAE file's up axis is ignored,
// its unit is applied. Indices of faces and meshes are sound. Lifetime: the scene is the importer's.
// Throws Error, for a bad `scale` and for files outside of the scope too.
const aiScene& import_scene(Assimp::Importer& importer, const ImportContext& context, const Vector3& scale,
                            unsigned removed, unsigned steps);

}  // namespace stampede
