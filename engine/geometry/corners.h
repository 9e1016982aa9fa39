// The corners of boxes.
#pragma once

#include <array>

#include "engine/geometry/transform.h"

namespace stampede {

// Of the box between these, x changing first.
inline std::array<Vector3, 8> box_corners(const Vector3& low, const Vector3& high) {
  std::array<Vector3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z()};
  return corners;
}

}  // namespace stampede
