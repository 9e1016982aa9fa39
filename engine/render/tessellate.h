// Shapes as triangles.
#pragma once

#include "engine/geometry/drawn_mesh.h"
#include "engine/model/scene.h"

namespace stampede {

// How far drawn round shapes may stray from exact ones, to either side of them: a polygon's corners stand a little
// outside, the middles of its edges a little inside. Units: m.
inline constexpr double kRoundTolerance = 0.0003;

// In the shape's frame; round shapes have as many sides as kRoundTolerance asks, 12 to 64. A mesh is looked up.
// Throws Error for shapes without volume, and meshes that are missing or broken.
DrawnMesh tessellate(const Shape& shape, const Scene& scene);

// Whether only front faces are ever seen from outside: every edge is shared by two triangles that run through it in
// opposite ways, and the volume inside is positive.
bool is_closed(const DrawnMesh& mesh);

// Tells apart what tessellate makes different triangles of; equal content, equal key.
std::string tessellation_key(const Shape& shape, const Scene& scene);

}  // namespace stampede
