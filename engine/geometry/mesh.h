// Mesh files (OBJ, STL, DAE, PLY, GLB, …; assimp) as triangles and convex hulls.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/file_scope.h"
#include "engine/geometry/drawn_mesh.h"
#include "engine/geometry/transform.h"

namespace stampede {

struct Mesh {
  std::string node;                           // its name in the file, may be empty
  std::vector<Vector3> vertices;              // in the file's root frame, m
  std::vector<std::array<int, 3>> triangles;  // indices into vertices
};

// One mesh for each node that has triangles, depth first. A DAE file's up axis is ignored, its unit is applied.
// Units: `scale` turns the file's units into m. Files are read in a child process with limits of time and memory, once
// each for a process. Threads: any. Repeatable. Throws Error for a missing, unreadable, malicious or empty file, for
// coordinates that are not finite, and for what lies outside of the scope: by default the file's folder.
std::vector<Mesh> load_meshes(const std::filesystem::path& file, const Vector3& scale = Vector3::Ones());
std::vector<Mesh> load_meshes(const std::filesystem::path& file, const Vector3& scale, const FileScope& scope);

// As load_drawn of drawn_mesh.h, for files that may name what lies in the scope.
std::vector<DrawnMaterial> load_drawn(const std::filesystem::path& file, const Vector3& scale, const FileScope& scope);

// What a reader of the file should know, or nothing: a DAE whose up axis is not z, which is ignored.
std::string mesh_remark(const std::filesystem::path& file);
inline constexpr const char* kUpAxisCure = "turn it where it is used: rpy, or <origin rpy>; or export it with z up";

inline constexpr int kHullPoints = 64;  // of a hull, where nobody asks for more

// The corners of each node's convex hull, at most `most_points` of them. Throws Error as load_meshes does, and for a
// node that spans no volume.
std::vector<std::vector<Vector3>> load_hulls(const std::filesystem::path& file, const Vector3& scale = Vector3::Ones(),
                                             int most_points = kHullPoints);
std::vector<std::vector<Vector3>> load_hulls(const std::filesystem::path& file, const Vector3& scale, int most_points,
                                             const FileScope& scope);

}  // namespace stampede
