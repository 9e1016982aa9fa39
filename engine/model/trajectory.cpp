#include "engine/model/trajectory.h"

#include <algorithm>

namespace stampede {
namespace {

// The quintic that joins both knots, t seconds after the first; `span` seconds lie between them.
JointState quintic(const Trajectory::Knot& a, const Trajectory::Knot& b, double t, double span) {
  const JointVector gap = b.position - a.position - span * a.velocity - 0.5 * span * span * a.acceleration;
  const JointVector speed = span * (b.velocity - a.velocity - span * a.acceleration);
  const JointVector force = span * span * (b.acceleration - a.acceleration);
  const JointVector c3 = 10.0 * gap - 4.0 * speed + 0.5 * force;
  const JointVector c4 = -15.0 * gap + 7.0 * speed - force;
  const JointVector c5 = 6.0 * gap - 3.0 * speed + 0.5 * force;
  const double s = t / span;
  JointState state;
  state.position = a.position + t * (a.velocity + 0.5 * t * a.acceleration) + s * s * s * (c3 + s * (c4 + s * c5));
  state.velocity = a.velocity + t * a.acceleration + s * s / span * (3.0 * c3 + s * (4.0 * c4 + s * (5.0 * c5)));
  state.acceleration = a.acceleration + s / (span * span) * (6.0 * c3 + s * (12.0 * c4 + s * (20.0 * c5)));
  return state;
}

}  // namespace

JointState evaluate(const Trajectory& trajectory, double step, int physics_hz) {
  const auto& knots = trajectory.knots;
  if (knots.empty()) return {};
  if (step >= static_cast<double>(knots.back().step)) {
    const JointVector still = JointVector::Zero(knots.back().position.size());
    return {knots.back().position, still, still};
  }
  const auto after = std::upper_bound(knots.begin(), knots.end(), step, [](double value, const Trajectory::Knot& knot) {
    return value < static_cast<double>(knot.step);
  });
  if (after == knots.begin()) return {knots.front().position, knots.front().velocity, knots.front().acceleration};
  const Trajectory::Knot& a = *(after - 1);
  const double rate = physics_hz;
  return quintic(a, *after, (step - static_cast<double>(a.step)) / rate,
                 static_cast<double>(after->step - a.step) / rate);
}

}  // namespace stampede
