// How much is missing where inverse kinematics finds nothing.
#include <algorithm>

#include "engine/model/kinematics.h"

namespace stampede {
namespace {

constexpr double kBeyond_rad = 0.8;       // further beyond a limit nobody wants to know
constexpr double kMetresPerRadian = 0.3;  // which of two shortfalls is the smaller one
constexpr double kFirstStep_m = 0.005, kFarthest_m = 0.8;
constexpr int kRestarts = 8, kHalvings = 5;

double size_of(const Shortfall& one) { return one.joint >= 0 ? kMetresPerRadian * one.angle : one.way_m; }

}  // namespace

// Solves for an arm whose joints go further; of its ways the one that goes least too far.
std::optional<Shortfall> Arm::beyond_limits(const Transform& world_from_tip, const JointVector& start,
                                            RandomKey key) const {
  Arm loose = *this;
  for (JointLimits& limit : loose.limits_) {
    limit.lower -= kBeyond_rad;
    limit.upper += kBeyond_rad;
  }
  std::optional<Shortfall> least;
  for (const JointVector& q : loose.solutions(world_from_tip, start, key, 6, 3 * kRestarts)) {
    Shortfall worst;
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const JointLimits& limit = limits_[static_cast<std::size_t>(i)];
      const double beyond = std::max(limit.lower - q[i], q[i] - limit.upper);
      if (beyond > worst.angle) worst = {0, static_cast<int>(i), beyond};
    }
    if (worst.joint >= 0 && (!least || worst.angle < least->angle)) least = worst;
  }
  return least;
}

// The same hand, drawn towards the second joint: doubles the way until it works, then halves what is between.
std::optional<Shortfall> Arm::nearer(const Transform& world_from_tip, const JointVector& start, RandomKey key) const {
  Transform shoulder = world_from_base_ * parent_from_joint_.front();
  if (parent_from_joint_.size() > 1) shoulder = shoulder * parent_from_joint_[1];
  const Vector3 way = shoulder.translation() - world_from_tip.translation();
  const double length = std::min(way.norm(), kFarthest_m);
  const auto works = [&](double metres) {
    Transform moved = world_from_tip;
    moved.translation() += metres * way.normalized();
    return solve(moved, start, key, kRestarts).has_value();
  };
  double short_of = 0, enough = kFirstStep_m;
  while (enough < length && !works(enough)) {
    short_of = enough;
    enough *= 2;
  }
  if (enough >= length) return std::nullopt;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (short_of + enough) / 2;
    (works(middle) ? enough : short_of) = middle;
  }
  return Shortfall{enough, -1, 0};
}

std::optional<Shortfall> Arm::shortfall(const Transform& world_from_tip, const JointVector& start,
                                        RandomKey key) const {
  const std::optional<Shortfall> turned = beyond_limits(world_from_tip, start, key);
  const std::optional<Shortfall> moved = nearer(world_from_tip, start, key);
  if (!turned || !moved) return turned ? turned : moved;
  return size_of(*turned) < size_of(*moved) ? turned : moved;
}

}  // namespace stampede
