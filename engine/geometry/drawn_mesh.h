// What is drawn: triangles with normals and texture coordinates, and pictures. Plain values.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/transform.h"

namespace stampede {

// Shapes: 4 bytes a pixel (red, green, blue, alpha; sRGB), rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
  friend bool operator==(const Image&, const Image&) = default;
};

// Triangles that one colour or picture covers. Units: m. Corners counter-clockwise seen from outside.
struct DrawnMesh {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;      // one per position, unit length
  std::vector<std::array<float, 2>> coordinates;  // of the texture, one per position, v down; empty: none
  std::vector<std::array<std::uint32_t, 3>> triangles;
  friend bool operator==(const DrawnMesh&, const DrawnMesh&) = default;
};

// A mesh as a file has it: where it has a material, its colour and picture too.
struct DrawnMaterial {
  DrawnMesh mesh;
  std::optional<std::array<double, 4>> colour;  // red, green, blue, alpha; 0 … 1, sRGB
  std::shared_ptr<const Image> image;           // nothing: plain
};

// One for each material of each node, in the order of the file, in the file's root frame. Normals that the file
// lacks are computed, smooth across edges below 40 degrees. Pictures beside the file or inside it are read.
// Units: `scale` turns the file's units into m. Throws Error, as load_meshes does, and for a missing or broken picture.
std::vector<DrawnMaterial> load_drawn(const std::filesystem::path& file, const Vector3& scale = Vector3::Ones());

// PNG and JPEG files. Throws Error for a missing, broken or huge (over 4096 pixels a side) picture.
Image load_image(const std::filesystem::path& file);

// The surface of revolution about z of a profile of (radius, z), m: smooth along the turn, and along the profile where
// it bends by less than 40 degrees. Radii are not negative; both ends are closed when their radius is above 0.
DrawnMesh lathe_mesh(const std::vector<std::array<double, 2>>& profile, int sides);

// Bytes that a document can hold, and back: to(from(x)) is the identity. Throws Error for damaged bytes.
std::string to_bytes(const DrawnMesh& mesh);
DrawnMesh mesh_from_bytes(std::string_view bytes);

}  // namespace stampede
