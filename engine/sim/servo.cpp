#include "engine/sim/servo.h"

#include <algorithm>
#include <cmath>

namespace stampede {
namespace {

constexpr double kLinear_s = 0.04;  // time constant of the last bit of the way
// What pushes the arm from outside must not take it over its stops: speeds and torques do not lead nearer than this.
constexpr double kMargin_rad = 0.05;
constexpr double kUsualSpeed = 2;          // rad/s, where a robot states none
constexpr double kUsualAcceleration = 10;  // rad/s^2, likewise

double speed_of(const JointLimits& limits) { return limits.velocity > 0 ? limits.velocity : kUsualSpeed; }

double acceleration_of(const JointLimits& limits) {
  return limits.acceleration > 0 ? limits.acceleration : kUsualAcceleration;
}

// At which a joint can still stop within `way`: linear close by, the square root of the way beyond, joined smoothly.
double stopping_speed(double way, double acceleration) {
  if (way <= 0) return 0;
  const double linear = acceleration * kLinear_s * kLinear_s;
  return way <= linear ? way / kLinear_s : std::sqrt(2 * acceleration * (way - linear / 2));
}

bool limited(const JointLimits& limits) { return limits.lower < limits.upper; }

// The range of velocities that a joint may have at this place; into the margin before its stops it may only be led.
std::pair<double, double> allowed(double position, const JointLimits& limits, double margin) {
  const double most = speed_of(limits), acceleration = acceleration_of(limits);
  if (!limited(limits)) return {-most, most};
  return {-std::min(most, stopping_speed(position - limits.lower - margin, acceleration)),
          std::min(most, stopping_speed(limits.upper - margin - position, acceleration))};
}

}  // namespace

JointState guided(const JointState& now, const operation::Servo& servo, const std::vector<JointLimits>& limits,
                  double dt) {
  JointState next = now;
  for (Eigen::Index i = 0; i < now.position.size(); ++i) {
    const JointLimits& own = limits[static_cast<std::size_t>(i)];
    const double q = now.position[i], most = acceleration_of(own);
    double wanted = servo.value[i];
    const bool led = servo.of == operation::Servo::Of::position;
    if (led) {
      const double way = (limited(own) ? std::clamp(wanted, own.lower, own.upper) : wanted) - q;
      wanted = std::copysign(stopping_speed(std::abs(way), most), way);
    }
    const auto [slowest, fastest] = allowed(q, own, led ? 0 : kMargin_rad);
    wanted = std::clamp(wanted, slowest, fastest);
    double velocity = std::clamp(wanted, now.velocity[i] - most * dt, now.velocity[i] + most * dt);
    double position = q + velocity * dt;
    if (limited(own) && (position < own.lower || position > own.upper)) {
      position = std::clamp(position, std::min(q, own.lower), std::max(q, own.upper));
      velocity = (position - q) / dt;
    }
    next.position[i] = position;
    next.velocity[i] = velocity;
    next.acceleration[i] = (velocity - now.velocity[i]) / dt;
  }
  return next;
}

JointVector safe_acceleration(const JointVector& asked, const JointVector& position, const JointVector& velocity,
                              const std::vector<JointLimits>& limits, double dt) {
  JointVector result = asked;
  for (Eigen::Index i = 0; i < asked.size(); ++i) {
    const auto [slowest, fastest] =
        allowed(position[i] + velocity[i] * dt, limits[static_cast<std::size_t>(i)], kMargin_rad);
    result[i] = std::clamp(asked[i], (slowest - velocity[i]) / dt, (fastest - velocity[i]) / dt);
  }
  return result;
}

}  // namespace stampede
