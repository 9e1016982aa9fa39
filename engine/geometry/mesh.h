// Mesh files (OBJ, STL, DAE, PLY, GLB, …; assimp) as triangles and convex hulls.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/geometry/transform.h"

namespace stampede {

struct Mesh {
  std::string node;                           // its name in the file, may be empty
  std::vector<Vector3> vertices;              // in the file's root frame, m
  std::vector<std::array<int, 3>> triangles;  // indices into vertices
};

// One mesh for each node that has triangles, depth first. A DAE file's up axis is ignored, its unit is applied.
// Units: `scale` turns the file's units into m. Throws Error for a missing, unreadable or empty file and for
// coordinates that are not finite. Repeatable.
std::vector<Mesh> load_meshes(const std::filesystem::path& file, const Vector3& scale = Vector3::Ones());

// The corners of each node's convex hull, at most `most_points` of them. Throws Error as load_meshes does, and for a
// node that spans no volume.
std::vector<std::vector<Vector3>> load_hulls(const std::filesystem::path& file, const Vector3& scale = Vector3::Ones(),
                                             int most_points = 64);

}  // namespace stampede
