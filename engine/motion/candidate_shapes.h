// What grasps and placements need to know of shapes. Room-internal.
#pragma once

#include <vector>

#include "engine/base/random.h"
#include "engine/model/scene.h"

namespace stampede {

// How far a shape reaches along a unit direction, from the shape's origin; both in the shape's frame. m.
double reach(const Shape& shape, const Vector3& direction);
// How far a part's colliding shapes reach along a unit direction, all in the part's frame. m.
double reach(const Part& part, const Vector3& direction);

// A way to close two fingers on one shape; z of the tip points into it, y along the closing axis.
struct ShapeGrasp {
  Transform part_from_tip = Transform::Identity();
  double width = 0;       // distance of the two contacts, m
  double off_centre = 0;  // distance of the tip's axis from the middle of the shape, m
};
// All that fit between fingers `opening_m` apart; draws fill continuous choices (yaw about round shapes, offsets).
// `depth_m`: how deep the tip may go below the surface before the palm meets it.
std::vector<ShapeGrasp> shape_grasps(const Shape& shape, double opening_m, double depth_m, RandomKey key);

}  // namespace stampede
