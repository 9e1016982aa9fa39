// How far two pictures of the same thing agree.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/render/picture.h"

namespace stampede {

// Whether the pixels around show one surface: the same id, and no jump in depth.
inline bool away_from_silhouettes(const Picture& exact, int u, int v) {
  if (u < 1 || v < 1 || u + 1 >= exact.width || v + 1 >= exact.height) return false;
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * exact.width + x); };
  const float depth = exact.depth[at(u, v)];
  for (int y = v - 1; y <= v + 1; ++y)
    for (int x = u - 1; x <= u + 1; ++x) {
      if (exact.instance[at(x, y)] != exact.instance[at(u, v)]) return false;
      if (std::abs(exact.depth[at(x, y)] - depth) > 0.02F) return false;
    }
  return true;
}

struct Agreement {
  double depth = 0;     // share of pixels away from silhouettes whose depth is within 1 mm
  double ids = 0;       // share of all pixels with the same instance and class
  int surfaces = 0;     // pixels away from silhouettes that show something
  double worst_mm = 0;  // of those
};

inline Agreement agreement(const Picture& drawn, const Picture& exact) {
  int even = 0, close = 0, same = 0, total = exact.width * exact.height;
  Agreement result;
  for (int v = 0; v < exact.height; ++v)
    for (int u = 0; u < exact.width; ++u) {
      const auto i = static_cast<std::size_t>(v * exact.width + u);
      if (drawn.instance[i] == exact.instance[i] && drawn.semantic[i] == exact.semantic[i]) ++same;
      if (!away_from_silhouettes(exact, u, v)) continue;
      ++even;
      const double error = std::abs(static_cast<double>(drawn.depth[i]) - static_cast<double>(exact.depth[i]));
      if (error <= 0.001) ++close;
      if (exact.instance[i] == 0) continue;
      ++result.surfaces;
      result.worst_mm = std::max(result.worst_mm, 1000 * error);
    }
  result.depth = static_cast<double>(close) / even;
  result.ids = static_cast<double>(same) / total;
  return result;
}

}  // namespace stampede
