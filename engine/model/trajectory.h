// A timed joint path: what motion planning produces, controllers follow and catalogues store.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/model/kinematics.h"

namespace stampede {

// Knots in physics steps from the start; between two knots each joint follows the quintic that joins position,
// velocity and acceleration. The first knot is at step 0; after the last the arm holds still.
struct Trajectory {
  struct Knot {
    std::int64_t step = 0;
    JointVector position, velocity, acceleration;  // rad, rad/s, rad/s^2
  };
  std::vector<Knot> knots;
  std::int64_t steps() const { return knots.empty() ? 0 : knots.back().step; }
};

struct JointState {
  JointVector position, velocity, acceleration;
};

// The set-point at a step after the start. Repeatable: depends on nothing else.
JointState evaluate(const Trajectory& trajectory, double step, int physics_hz);

}  // namespace stampede
