// Convex hulls of points and the mass properties of closed solids.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/geometry/transform.h"

namespace stampede {

struct Hull {
  std::vector<Vector3> points;                // its corners, m
  std::vector<std::array<int, 3>> triangles;  // indices into points, counter-clockwise seen from outside
  double deviation_m = 0;  // greatest height of an input point over a face: 0 unless points were left out
};

// Quickhull (Barber, Dobkin, Huhdanpaa, ACM TOMS 1996, doi:10.1145/235815.235821), farthest point first: stopping at
// `most_points` gives the corners that matter most. 0 takes them all.
// Result: nothing when the points span no volume (fewer than four, or all in one plane).
// Repeatable: depends on the points and their order only.
std::optional<Hull> convex_hull(std::span<const Vector3> points, int most_points = 0);

// Of a solid of density 1. Units: m^3; m; kg m^2 about the centre, in the axes of the input.
struct MassProperties {
  double volume = 0;
  Vector3 centre = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();
};

// Exact, as a sum of tetrahedra. The triangles must close a surface and face outwards.
MassProperties mass_properties(const Hull& solid);

}  // namespace stampede
