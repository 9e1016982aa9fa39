// Depth as points in the world.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/render/picture.h"

namespace stampede {

// One point for each pixel with a depth, row by row. Units: m, world. Shapes: all lists have one entry a point; colours
// and ids are empty when the picture has none.
struct PointCloud {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<std::uint8_t, 3>> colours;
  std::vector<std::uint16_t> instance, semantic;
};

// Throws Error when the picture has no depth. Lens distortion is undone.
PointCloud point_cloud(const Picture& picture, const View& view);

// Clouds of several cameras as one. Throws Error when only one of them has colours, or ids of a kind.
void append(PointCloud& cloud, const PointCloud& more);

// Binary PLY: x y z (float), red green blue (uchar), instance semantic (ushort).
std::string to_ply(const PointCloud& cloud);

}  // namespace stampede
