#include "engine/sim/servo.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stampede {
namespace {

constexpr double kLinear_s = 0.04;         // time constant of the last bit of the way
constexpr double kToolSpeed = 1.6;         // m/s: a Panda's tool may move at 1.7
constexpr double kUsualSpeed = 2;          // rad/s, where a robot states none
constexpr double kUsualAcceleration = 10;  // rad/s^2, likewise
constexpr double kUsualJerk = 5000;        // rad/s^3, likewise
constexpr double kLongestGap_s = 0.2;      // between positions of a stream
constexpr double kGentlest = 0.05;         // share of the acceleration
constexpr double kOver_rad = 0.005;  // as far as a stream that ends at once takes a joint beyond its last position
constexpr double kAsFast = 1.05;     // share of the limits of speed and acceleration that a stream may have
constexpr double kLeastPull = 1e-9;  // what rounding changes is no limit that acted
// A motor takes away a small error at this rate: a fifth of it in a step of 1/240 s.
constexpr double kCatch_s = 1.0 / 48;

constexpr std::array<const char*, kLimits> kLimitNames{"speed",      "acceleration", "jerk",     "torque",
                                                       "tool_speed", "reference",    "approach", "contact"};

double jerk_of(const JointLimits& limits) { return limits.jerk > 0 ? limits.jerk : kUsualJerk; }

// At which a joint can still stop within `way`: linear close by, the square root of the way beyond, joined smoothly.
double stopping_speed(double way, double acceleration, double linear_s = kLinear_s) {
  if (way <= 0) return 0;
  const double linear = acceleration * linear_s * linear_s;
  return way <= linear ? way / linear_s : std::sqrt(2 * acceleration * (way - linear / 2));
}

// For the next step, on the cubic that leads to a position with a velocity (Hermite).
double passing_speed(double from, double velocity, double to, double end_velocity, double left_s, double dt) {
  const double t = std::min(1.0, dt / left_s), square = t * t, cube = square * t;
  const double way = (3 * square - 2 * cube) * (to - from) + (cube - 2 * square + t) * left_s * velocity +
                     (cube - square) * left_s * end_velocity;
  return way / dt;
}

bool limited(const JointLimits& limits) { return limits.lower < limits.upper; }

// The range of velocities that a joint may have at this place; into the margin before its stops it may only be led.
std::pair<double, double> allowed(double position, const JointLimits& limits, double margin, double pace) {
  const double most = pace * speed_of(limits), acceleration = acceleration_of(limits);
  if (!limited(limits)) return {-most, most};
  return {-std::min(most, stopping_speed(position - limits.lower - margin, acceleration)),
          std::min(most, stopping_speed(limits.upper - margin - position, acceleration))};
}

// At which a joint can still stop soon after a position that it passes.
double brief_speed(const JointLimits& limits) { return std::sqrt(2 * acceleration_of(limits) * kOver_rad); }

// Towards a position that is stopped at, or, with a speed in its direction, soon after.
double leading_speed(double from, double velocity, double to, double passing, const JointLimits& limits, double dt) {
  const double way = (limited(limits) ? std::clamp(to, limits.lower, limits.upper) : to) - from;
  // What the jerk takes to turn the acceleration round is not there for stopping.
  const double turning_s = acceleration_of(limits) / jerk_of(limits);
  const double lag = turning_s > dt ? std::abs(velocity) * turning_s : 0;
  const double linear_s = std::max(kLinear_s, 2.5 * turning_s);
  const double stopping = stopping_speed(std::abs(way) - lag, acceleration_of(limits), linear_s);
  return std::copysign(passing * way > 0 ? std::hypot(stopping, brief_speed(limits)) : stopping, way);
}

}  // namespace

std::vector<std::string> Limits::names() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kLimits; ++i)
    if (acted_[i]) names.emplace_back(kLimitNames[i]);
  return names;
}

double speed_of(const JointLimits& limits) { return limits.velocity > 0 ? limits.velocity : kUsualSpeed; }

double acceleration_of(const JointLimits& limits) {
  return limits.acceleration > 0 ? limits.acceleration : kUsualAcceleration;
}

double catching_up(double error, double acceleration) {
  return std::copysign(stopping_speed(std::abs(error), acceleration, kCatch_s), error);
}

JointVector slowed(const Arm& arm, const JointVector& q, JointVector velocity, double pace, Limits& acted) {
  const double speed = (arm.jacobian(q).topRows<3>() * velocity).norm();
  if (speed <= pace * kToolSpeed) return velocity;
  acted.note(pace < 1 ? Limit::approach : Limit::tool_speed);
  return velocity * (pace * kToolSpeed / speed);
}

bool leads(const operation::Servo& servo) {
  return servo.of == operation::Servo::Of::position || servo.of == operation::Servo::Of::passage;
}

void Stream::follow(const JointVector& from, const JointVector& to, double seconds,
                    const std::vector<JointLimits>& limits) {
  if (seconds <= 0 || seconds > kLongestGap_s) return end();
  if (due_s_ == 0) mean_ = JointVector::Zero(to.size());
  const JointVector mean = (to - from) / seconds;
  passing_ = JointVector::Zero(to.size());
  for (Eigen::Index i = 0; i < to.size(); ++i) {
    const JointLimits& own = limits[static_cast<std::size_t>(i)];
    const double change = mean[i] - mean_[i];
    if (std::abs(mean[i]) > kAsFast * speed_of(own) || std::abs(change) > kAsFast * acceleration_of(own) * seconds)
      continue;
    const double soon = std::clamp(mean[i] + change / 2, -speed_of(own), speed_of(own));
    if (soon * mean[i] > 0) passing_[i] = soon;
  }
  mean_ = mean;
  due_s_ = seconds;
}

JointState guided(const JointState& now, const operation::Servo& servo, const Stream& stream, double since,
                  const Arm& arm, double dt, const Guard& guard, Limits& acted) {
  const std::vector<JointLimits>& limits = arm.limits();
  const bool led = leads(servo), passage = servo.of == operation::Servo::Of::passage;
  const double left_s = led ? stream.due_s() - since : 0;
  JointVector wanted = servo.value;
  // What each joint may have at its place, so that it can stop before its end.
  const auto range = [&](Eigen::Index i) {
    return allowed(now.position[i], limits[static_cast<std::size_t>(i)], led ? 0 : kMargin_rad, 1);
  };
  double slow = 1;  // share that the pace leaves
  for (Eigen::Index i = 0; i < wanted.size(); ++i) {
    const JointLimits& own = limits[static_cast<std::size_t>(i)];
    const double q = now.position[i];
    if (led) {
      const double passing = left_s > dt / 2 ? stream.passing(i) : 0;
      wanted[i] = passing != 0 && (passage || std::abs(passing) <= brief_speed(own))
                      ? passing_speed(q, now.velocity[i], wanted[i], passing, left_s, dt)
                      : leading_speed(q, now.velocity[i], wanted[i], passing, own, dt);
    }
    const auto [slowest, fastest] = range(i);
    const double kept = std::clamp(wanted[i], slowest, fastest);
    if (std::abs(kept - wanted[i]) > kLeastPull) acted.note(Limit::speed);
    wanted[i] = kept;
    // Where it has to be slow it keeps to its way: all joints together.
    if (std::abs(kept) > guard.pace * speed_of(own)) slow = std::min(slow, guard.pace * speed_of(own) / std::abs(kept));
    if (guard.position.size() == 0) continue;
    const double ahead = std::copysign(1.0, wanted[i]) * (q - guard.position[i]);
    if (ahead <= guard.lead / 2 || wanted[i] == 0) continue;
    acted.note(Limit::reference);
    wanted[i] *= std::max(0.0, 2 - 2 * ahead / guard.lead);
  }
  if (slow < 1) acted.note(Limit::approach);
  wanted *= slow;
  wanted = slowed(arm, now.position, wanted, guard.pace, acted);

  // Joints that change their speed each in its own time could make the tool faster than before and after; and as they
  // turn, the tool gets faster by itself.
  double share = 1;
  JointVector soon = now.velocity;
  for (Eigen::Index i = 0; i < wanted.size(); ++i) {
    const double most = acceleration_of(limits[static_cast<std::size_t>(i)]) * dt, change = wanted[i] - now.velocity[i];
    soon[i] += std::clamp(change, -most, most);
    if (std::abs(change) > most) share = std::min(share, most / std::abs(change));
  }
  if ((arm.jacobian(now.position).topRows<3>() * soon).norm() > kToolSpeed) {
    wanted = now.velocity + share * (wanted - now.velocity);
    for (Eigen::Index i = 0; i < wanted.size(); ++i) {  // but each brakes for its stops
      const auto [slowest, fastest] = range(i);
      wanted[i] = std::clamp(wanted[i], slowest, fastest);
    }
    wanted = slowed(arm, now.position, wanted, 1, acted);
    acted.note(Limit::tool_speed);
  }

  JointState next = now;
  for (Eigen::Index i = 0; i < wanted.size(); ++i) {
    const JointLimits& own = limits[static_cast<std::size_t>(i)];
    const double q = now.position[i], most = acceleration_of(own), jerk = jerk_of(own);
    const double asked = (wanted[i] - now.velocity[i]) / dt;
    double acceleration = std::clamp(asked, -most, most);
    // What is to be slow starts gently too: a stiff arm that is held by something presses as hard as it would start.
    if (std::abs(now.velocity[i] + acceleration * dt) > std::abs(now.velocity[i])) {
      const double start = std::max(guard.pace, kGentlest) * most;
      acceleration = std::clamp(acceleration, -start, start);
    }
    if (std::abs(acceleration - asked) > kLeastPull / dt) acted.note(Limit::acceleration);
    const double eased = std::clamp(acceleration, std::min(now.acceleration[i] - jerk * dt, most),
                                    std::max(now.acceleration[i] + jerk * dt, -most));
    if (std::abs(eased - acceleration) > kLeastPull / dt) acted.note(Limit::jerk);
    double velocity = std::clamp(now.velocity[i] + eased * dt, -speed_of(own), speed_of(own));
    double position = q + velocity * dt;
    if (limited(own) && (position < own.lower || position > own.upper)) {
      position = std::clamp(position, std::min(q, own.lower), std::max(q, own.upper));
      velocity = (position - q) / dt;
    }
    if (guard.position.size() > 0) {
      const double near = std::clamp(position, guard.position[i] - 2 * guard.lead, guard.position[i] + 2 * guard.lead);
      if (near != position) {
        position = near;
        velocity = std::clamp((near - q) / dt, -speed_of(own), speed_of(own));
      }
    }
    next.position[i] = position;
    next.velocity[i] = velocity;
    next.acceleration[i] = (velocity - now.velocity[i]) / dt;
  }
  return next;
}

JointVector safe_acceleration(const JointVector& asked, const JointVector& position, const JointVector& velocity,
                              const Arm& arm, double dt, double pace, double margin, Limits& acted) {
  JointVector next = velocity + dt * asked;
  const JointVector ahead = position + dt * velocity;
  for (Eigen::Index i = 0; i < next.size(); ++i) {
    const auto [slowest, fastest] = allowed(ahead[i], arm.limits()[static_cast<std::size_t>(i)], margin, pace);
    const double kept = std::clamp(next[i], slowest, fastest);
    if (kept != next[i]) acted.note(pace < 1 ? Limit::approach : Limit::speed);
    next[i] = kept;
  }
  next = slowed(arm, position, next, pace, acted);
  JointVector result = (next - velocity) / dt;
  for (Eigen::Index i = 0; i < next.size(); ++i) {
    const JointLimits& own = arm.limits()[static_cast<std::size_t>(i)];
    const double most = acceleration_of(own);
    if (std::abs(result[i]) > most) acted.note(Limit::acceleration);
    // To stop before its end, a joint may do more.
    const auto [slowest, fastest] = allowed(ahead[i], own, margin, 1);
    result[i] =
        std::clamp(std::clamp(result[i], -most, most), (slowest - velocity[i]) / dt, (fastest - velocity[i]) / dt);
  }
  return result;
}

}  // namespace stampede
