#include "engine/sim/servo.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/sim/paces.h"

namespace stampede {
namespace {

constexpr double kLinear_s = 0.04;         // time constant of the last bit of the way
constexpr double kToolSpeed = 1.6;         // m/s: a Panda's tool may move at 1.7
constexpr double kUsualSpeed = 2;          // rad/s, where a robot states none
constexpr double kUsualAcceleration = 10;  // rad/s^2, likewise
constexpr double kUsualJerk = 5000;        // rad/s^3, likewise
constexpr double kLongestGap_s = 0.2;      // between positions of a stream
constexpr double kGentlest = 0.05;         // share of the acceleration that a start may have
constexpr double kGentle = 20;             // likewise, times the square of the pace
constexpr double kOver_rad = 0.005;  // as far as a stream that ends at once takes a joint beyond its last position
constexpr double kAsFast = 1.05;     // share of the limits of speed and acceleration that a stream may have
constexpr double kThick_m = 0.1;     // of a link, with what it holds
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

// A joint's position and velocity.
struct Moving {
  double position = 0, velocity = 0;
};

// For the next step, on the cubic that leads to a position with a velocity (Hermite).
double passing_speed(const Moving& from, const Moving& to, double left_s, double dt) {
  const double t = std::min(1.0, dt / left_s), square = t * t, cube = square * t;
  const double way = (3 * square - 2 * cube) * (to.position - from.position) +
                     (cube - 2 * square + t) * left_s * from.velocity + (cube - square) * left_s * to.velocity;
  return way / dt;
}

// What pushes an arm from outside must not take it over its stops; positions lead it up to them.
double margin_of(const operation::Servo& servo) { return leads(servo) ? 0 : kMargin_rad; }

bool limited(const JointLimits& limits) { return limits.lower < limits.upper; }

// The range of velocities that a joint may have at this place; into the margin before its stops it may only be led.
std::pair<double, double> allowed(double position, const JointLimits& limits, double margin, double pace = 1) {
  const double most = pace * speed_of(limits), acceleration = acceleration_of(limits);
  if (!limited(limits)) return {-most, most};
  return {-std::min(most, stopping_speed(position - limits.lower - margin, acceleration)),
          std::min(most, stopping_speed(limits.upper - margin - position, acceleration))};
}

// At which a joint can still stop soon after a position that it passes.
double brief_speed(const JointLimits& limits) { return std::sqrt(2 * acceleration_of(limits) * kOver_rad); }

// Towards a position that is stopped at, or, with a speed in its direction, soon after.
double leading_speed(const Moving& from, const Moving& to, const JointLimits& limits, double dt) {
  const double way =
      (limited(limits) ? std::clamp(to.position, limits.lower, limits.upper) : to.position) - from.position;
  // What the jerk takes to turn the acceleration round is not there for stopping.
  const double turning_s = acceleration_of(limits) / jerk_of(limits);
  const double lag = turning_s > dt ? std::abs(from.velocity) * turning_s : 0;
  const double linear_s = std::max(kLinear_s, 2.5 * turning_s);
  const double stopping = stopping_speed(std::abs(way) - lag, acceleration_of(limits), linear_s);
  return std::copysign(to.velocity * way > 0 ? std::hypot(stopping, brief_speed(limits)) : stopping, way);
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

bool leads(const operation::Servo& servo) {
  return servo.of == operation::Servo::Of::position || servo.of == operation::Servo::Of::passage;
}

bool as_slow_as(double pace, const Arm& arm, const JointState& now) {
  return arm.greatest_speed(now.position, now.velocity, kThick_m) <= pace * kToolSpeed;
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

const JointLimits& Governor::limits(Eigen::Index joint) const { return arm_.limits()[static_cast<std::size_t>(joint)]; }

double Governor::tool_speed(const JointVector& q, const JointVector& velocity) const {
  return (arm_.jacobian(q).topRows<3>() * velocity).norm();
}

// The tip is no faster than the robot's tool may be, by the pace: the same direction, slower.
JointVector Governor::slowed(const JointVector& q, const JointVector& velocity, double pace) const {
  const double speed = tool_speed(q, velocity);
  if (speed <= pace * kToolSpeed) return velocity;
  acted_.note(pace < 1 ? Limit::approach : Limit::tool_speed);
  return velocity * (pace * kToolSpeed / speed);
}

// What an agent asks for, of one joint.
double Governor::speed_asked(const JointState& now, const Aim& aim, Eigen::Index i) const {
  const double value = aim.servo.value[i];
  if (!leads(aim.servo)) return value;
  const double left_s = aim.stream.due_s() - aim.since_s;
  const double passing = left_s > dt_ / 2 ? aim.stream.passing(i) : 0;
  const Moving from{now.position[i], now.velocity[i]}, to{value, passing};
  const bool passage = aim.servo.of == operation::Servo::Of::passage;
  return passing != 0 && (passage || std::abs(passing) <= brief_speed(limits(i)))
             ? passing_speed(from, to, left_s, dt_)
             : leading_speed(from, to, limits(i), dt_);
}

// How far a joint's reference is ahead of the joint, in the direction in which it is to move.
double Governor::ahead(const JointState& now, double wanted, Eigen::Index i) const {
  if (guard_.position.size() == 0 || wanted == 0) return 0;
  return std::copysign(1.0, wanted) * (now.position[i] - guard_.position[i]);
}

// The speeds that the joints should have: each can stop before its end, and waits for an arm that does not get on.
JointVector Governor::speeds_wanted(const JointState& now, const Aim& aim) const {
  JointVector wanted(aim.servo.value.size());
  double slow = 1;  // share that the pace leaves
  for (Eigen::Index i = 0; i < wanted.size(); ++i) {
    const double speed = speed_asked(now, aim, i);
    const auto [slowest, fastest] = allowed(now.position[i], limits(i), margin_of(aim.servo));
    wanted[i] = std::clamp(speed, slowest, fastest);
    if (std::abs(wanted[i] - speed) > kLeastPull) acted_.note(Limit::speed);
    const double most = guard_.pace * speed_of(limits(i));
    if (guard_.pace < kYieldingPace && std::abs(wanted[i]) > most) slow = std::min(slow, most / std::abs(wanted[i]));
    const double ahead = this->ahead(now, wanted[i], i);
    if (ahead <= guard_.lead / 2) continue;
    acted_.note(Limit::reference);
    wanted[i] *= std::max(0.0, 2 - 2 * ahead / guard_.lead);
  }
  // What meets something is a point of the arm, and a wrist that turns on the spot meets it slowly; where what it
  // leans on does not give way, each joint is slow. All joints together: it keeps to its way.
  if (guard_.pace == 1) return slowed(now.position, wanted, 1);
  const double fastest = arm_.greatest_speed(now.position, wanted, kThick_m);  // the tool's is no more
  if (fastest > guard_.pace * kToolSpeed) slow = std::min(slow, guard_.pace * kToolSpeed / fastest);
  if (slow < 1) acted_.note(Limit::approach);
  return slow * wanted;
}

// Joints that change their speed each in its own time leave the way that they are on, and could make the tool faster
// than before and after; as they turn, it gets faster by itself. Then, and where the arm brakes for what is ahead, they
// change it together, but each brakes for its stops.
JointVector Governor::together(const JointState& now, const JointVector& wanted, double margin) const {
  double share = 1;
  bool waits = false;  // for an arm that is held up: at once
  JointVector soon = now.velocity;
  for (Eigen::Index i = 0; i < wanted.size(); ++i) {
    waits = waits || ahead(now, now.velocity[i], i) > guard_.lead / 2;
    const double most = acceleration_of(limits(i)) * dt_, change = wanted[i] - now.velocity[i];
    soon[i] += std::clamp(change, -most, most);
    if (std::abs(change) > most) share = std::min(share, most / std::abs(change));
  }
  const bool fast = tool_speed(now.position, soon) > kToolSpeed;
  const bool brakes = guard_.pace < 1 && !waits && wanted.norm() < now.velocity.norm();
  if (!fast && !brakes) return wanted;
  JointVector slower = now.velocity + share * (wanted - now.velocity);
  for (Eigen::Index i = 0; i < wanted.size(); ++i) {
    const auto [slowest, fastest] = allowed(now.position[i], limits(i), margin);
    slower[i] = std::clamp(slower[i], slowest, fastest);
  }
  if (!fast) return slower;
  acted_.note(Limit::tool_speed);
  return slowed(now.position, slower, 1);
}

// That leads a joint towards a velocity.
double Governor::acceleration(const JointState& now, double velocity, Eigen::Index i) const {
  const double most = acceleration_of(limits(i)), jerk = jerk_of(limits(i));
  const double asked = (velocity - now.velocity[i]) / dt_;
  double acceleration = std::clamp(asked, -most, most);
  // What is to be slow starts gently too: a stiff arm that is held by something presses as hard as it would start.
  if (std::abs(now.velocity[i] + acceleration * dt_) > std::abs(now.velocity[i])) {
    const double start = std::clamp(kGentle * guard_.pace * guard_.pace, kGentlest, 1.0) * most;
    acceleration = std::clamp(acceleration, -start, start);
  }
  if (std::abs(acceleration - asked) > kLeastPull / dt_) acted_.note(Limit::acceleration);
  const double eased = std::clamp(acceleration, std::min(now.acceleration[i] - jerk * dt_, most),
                                  std::max(now.acceleration[i] + jerk * dt_, -most));
  if (std::abs(eased - acceleration) > kLeastPull / dt_) acted_.note(Limit::jerk);
  return eased;
}

JointState Governor::guided(const JointState& now, const Aim& aim) const {
  const JointVector wanted = together(now, speeds_wanted(now, aim), margin_of(aim.servo));
  JointState next = now;
  for (Eigen::Index i = 0; i < wanted.size(); ++i) {
    const JointLimits& own = limits(i);
    const double q = now.position[i];
    double velocity =
        std::clamp(now.velocity[i] + acceleration(now, wanted[i], i) * dt_, -speed_of(own), speed_of(own));
    double position = q + velocity * dt_;
    if (limited(own) && (position < own.lower || position > own.upper)) {
      position = std::clamp(position, std::min(q, own.lower), std::max(q, own.upper));
      velocity = (position - q) / dt_;
    }
    if (guard_.position.size() > 0) {
      const double near =
          std::clamp(position, guard_.position[i] - 2 * guard_.lead, guard_.position[i] + 2 * guard_.lead);
      if (near != position) {
        position = near;
        velocity = std::clamp((near - q) / dt_, -speed_of(own), speed_of(own));
      }
    }
    next.position[i] = position;
    next.velocity[i] = velocity;
    next.acceleration[i] = (velocity - now.velocity[i]) / dt_;
  }
  return next;
}

JointVector Governor::safe_acceleration(const JointVector& asked, const JointVector& position,
                                        const JointVector& velocity, double margin) const {
  JointVector next = velocity + dt_ * asked;
  const JointVector ahead = position + dt_ * velocity;
  for (Eigen::Index i = 0; i < next.size(); ++i) {
    const auto [slowest, fastest] = allowed(ahead[i], limits(i), margin, guard_.pace);
    const double kept = std::clamp(next[i], slowest, fastest);
    if (kept != next[i]) acted_.note(guard_.pace < 1 ? Limit::approach : Limit::speed);
    next[i] = kept;
  }
  next = slowed(position, next, guard_.pace);
  JointVector result = (next - velocity) / dt_;
  for (Eigen::Index i = 0; i < next.size(); ++i) {
    const double most = acceleration_of(limits(i));
    if (std::abs(result[i]) > most) acted_.note(Limit::acceleration);
    // To stop before its end, a joint may do more.
    const auto [slowest, fastest] = allowed(ahead[i], limits(i), margin);
    result[i] =
        std::clamp(std::clamp(result[i], -most, most), (slowest - velocity[i]) / dt_, (fastest - velocity[i]) / dt_);
  }
  return result;
}

}  // namespace stampede
