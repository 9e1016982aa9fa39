// Convex shapes and the one question asked of them: are two nearer than a distance? No Bullet, no allocation a query.
#pragma once

#include <vector>

#include "engine/model/scene.h"

namespace stampede {

// A shape as its core and a rounding: a sphere is a rounded point, a capsule a rounded segment.
struct Convex {
  explicit Convex(const Shape& shape);
  Vector3 support(const Vector3& direction) const;  // the core's farthest point that way, in the shape's frame

  ShapeKind kind;
  Vector3 half = Vector3::Zero();                                    // box
  double radius = 0, half_length = 0;                                // cylinder, cone; capsule: half_length alone
  std::vector<Vector3> points;                                       // hull
  double rounding = 0;                                               // m
  Vector3 box_centre = Vector3::Zero(), box_half = Vector3::Zero();  // bounding box, rounding included
};

// True when they touch or are at most `distance` apart. GJK (Gilbert, Johnson, Keerthi, IEEE J. Robotics Automat.
// 1988, doi:10.1109/56.2083), ended by the first bound that decides. Units: m. Repeatable.
bool closer_than(const Convex& a, const Transform& world_from_a, const Convex& b, const Transform& world_from_b,
                 double distance);

}  // namespace stampede
