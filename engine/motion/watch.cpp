#include "engine/motion/watch.h"

#include <algorithm>
#include <cmath>

namespace stampede {
namespace {

constexpr double kStopped_s = 0.3;  // fingers that have not moved for this long have stopped
constexpr double kHandTimeout_s = 3;
constexpr double kStill_m = 2e-4;
constexpr double kOpeningTolerance_m = 1e-3;

// The parts that hang on the arm's last joint: the last link and the hand.
std::set<PartRef> hand_parts(const Robot& robot, int index) {
  std::set<PartRef> parts;
  if (robot.arm.empty()) return parts;
  for (int part = 0; part < static_cast<int>(robot.body.parts.size()); ++part) {
    int up = part;
    while (up >= 0 && up != robot.arm.back()) up = robot.body.parts[static_cast<std::size_t>(up)].parent;
    if (up >= 0) parts.insert(PartRef::of_robot(part, index));
  }
  return parts;
}

}  // namespace

std::int64_t steps_of(double seconds, const World& world) {
  return static_cast<std::int64_t>(std::llround(seconds / world.dt()));
}

Trajectory brake(const World& world, int robot) {
  const JointState now = world.reference(robot);
  double time_s = 0.1;
  const auto& limits = world.arm(robot).limits();
  for (Eigen::Index i = 0; i < now.position.size(); ++i) {
    const double acceleration = limits[static_cast<std::size_t>(i)].acceleration;
    if (acceleration > 0) time_s = std::max(time_s, 2 * std::abs(now.velocity[i]) / acceleration);
  }
  const std::int64_t steps = std::max<std::int64_t>(1, steps_of(time_s, world));
  const double span = static_cast<double>(steps) * world.dt();
  const JointVector still = JointVector::Zero(now.position.size());
  Trajectory stop;
  stop.knots.push_back({0, now.position, now.velocity, now.acceleration});
  stop.knots.push_back({steps, now.position + 0.5 * span * now.velocity, still, still});
  return stop;
}

ContactWatch::ContactWatch(const World& world, std::optional<PartRef> held, int robot)
    : hand_(hand_parts(world.scene().robot, robot)), held_(held) {
  for (const Contact& contact : world.contacts()) known_.insert({contact.a, contact.b});
}

bool ContactWatch::met(const World& world, double new_force, double most_force) const {
  if (new_force <= 0 && most_force <= 0) return false;
  return std::any_of(world.contacts().begin(), world.contacts().end(), [&](const Contact& contact) {
    if (mine(contact.a) == mine(contact.b)) return false;
    if (most_force > 0 && contact.mean_force > most_force) return true;
    return new_force > 0 && contact.mean_force > new_force && !known_.contains({contact.a, contact.b});
  });
}

double ContactWatch::force_along(const World& world, const Vector3& direction) const {
  double sum = 0;
  for (const Contact& contact : world.contacts()) {
    if (mine(contact.a) == mine(contact.b)) continue;
    sum += (mine(contact.a) ? 1 : -1) * contact.force.dot(direction);
  }
  return sum;
}

void FingerWatch::begin(const World& world, double opening, int robot) {
  opening_ = opening;
  robot_ = robot;
  last_m_ = world.opening(robot);
  count_ = still_ = 0;
}

bool FingerWatch::arrived(const World& world) const {
  return std::abs(world.opening(robot_) - opening_) <= kOpeningTolerance_m;
}

bool FingerWatch::stopped(const World& world) {
  const std::int64_t elapsed = count_++;
  still_ = std::abs(world.opening(robot_) - last_m_) > kStill_m ? 0 : still_ + 1;
  if (still_ == 0) last_m_ = world.opening(robot_);
  return still_ > steps_of(kStopped_s, world) || elapsed > steps_of(kHandTimeout_s, world);
}

}  // namespace stampede
