// How an arm's reference follows what an agent asks for. Private to engine/sim.
#pragma once

#include "engine/sim/world.h"

namespace stampede {

// The reference one physics step later. It goes towards a position, or takes on a velocity, as fast as each joint's
// limits of speed and acceleration allow, and never beyond its stops: near its goal, and near a stop, it slows down by
// the square root of the way that is left, and in the end linearly. Not for torques. Repeatable.
JointState guided(const JointState& now, const operation::Servo& servo, const std::vector<JointLimits>& limits,
                  double dt);

// The acceleration closest to the one asked for that breaks no joint's limit of speed and can still stop short of its
// stops. Shapes: one entry a joint. rad/s^2.
JointVector safe_acceleration(const JointVector& asked, const JointVector& position, const JointVector& velocity,
                              const std::vector<JointLimits>& limits, double dt);

}  // namespace stampede
