// The same way with the arm at rest at some of its points.
#pragma once

#include "engine/motion/planner.h"

namespace stampede {

// Slows a planned motion down to a stand at each of its via-points, and at as many points more as it takes for straight
// lines of the tool from one stand to the next to stay within half a centimetre and two degrees of the way. It goes
// where it went, so what was certified stays so; vias and fingers keep their places on it. Joint limits are kept.
// `lines_from`: the step from which it follows lines; before, it may go another way to the same place.
void stop_at_vias(const Arm& arm, const MotionLimits& limits, int physics_hz, std::int64_t lines_from,
                  PlannedMotion& motion);

}  // namespace stampede
