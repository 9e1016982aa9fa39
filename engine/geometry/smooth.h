// Corners that faces share, and normals; inside this folder.
#pragma once

#include <cmath>
#include <numbers>

#include "engine/geometry/drawn_mesh.h"

namespace stampede {

inline const double kSmooth = std::cos(40.0 / 180.0 * std::numbers::pi);  // what bends by less is rounded

// Triangles one by one: corner i belongs to triangle i / 3. `normals` and `coordinates` may be empty.
struct Corners {
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<float, 2>> coordinates;
};

// Leaves out triangles without area.
void drop_flat(Corners& corners);

// Sets each corner's normal to the mean of the faces' that meet there (weighted by their angles: Thuermer, Wuethrich,
// Journal of Graphics Tools 1998, doi:10.1080/10867651.1998.10487487) and bend by less than 40 degrees from its own.
void smooth_normals(Corners& corners);

// Equal corners become one, in the order in which they first came.
DrawnMesh joined(const Corners& corners);

}  // namespace stampede
