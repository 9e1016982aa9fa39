// How deep two convex shapes lie in each other. For what is told and for starts: much slower than closer_than.
#pragma once

#include "engine/sim/convex.h"

namespace stampede {

// The least way that would part them, m; 0: they do not overlap. Bullet's EPA (van den Bergen, GDC 2001), to 0.1 mm.
double depth_between(const Convex& a, const Transform& world_from_a, const Convex& b, const Transform& world_from_b);

}  // namespace stampede
