#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/error.h"
#include "engine/model/kinematics.h"

namespace stampede {
namespace {

constexpr double kPositionTolerance = 1e-4;  // m
constexpr double kRotationTolerance = 1e-3;  // rad
constexpr double kRotationWeight = 0.3;      // m/rad, in the measure of progress
constexpr double kLargestStep = 0.5;         // rad
constexpr double kDistinct = 0.1;            // rad
constexpr int kIterations = 60;
constexpr int kPatience = 8;  // iterations without 2 % progress

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 16>;

// The rotation vector of a rotation matrix.
Vector3 rotation_vector(const Matrix3& rotation) {
  const Quaternion q(rotation);
  const double sine = q.vec().norm();
  if (sine < 1e-12) return 2.0 * q.vec() * (q.w() < 0 ? -1.0 : 1.0);
  const double angle = 2.0 * std::atan2(sine, std::abs(q.w()));
  return q.vec() * ((q.w() < 0 ? -angle : angle) / sine);
}

struct Attempt {
  Vector6 error;  // target minus tip, in base axes
  Jacobian jacobian;
};

double measure(const Vector6& error) { return error.head<3>().norm() + kRotationWeight * error.tail<3>().norm(); }

bool converged(const Vector6& error) {
  return error.head<3>().norm() < kPositionTolerance && error.tail<3>().norm() < kRotationTolerance;
}

// Damped step of the joints that are not frozen; frozen columns are left out.
JointVector damped_step(const Attempt& attempt, const std::array<bool, 16>& frozen, double damping) {
  const Eigen::Index n = attempt.jacobian.cols();
  Matrix6 square = damping * Matrix6::Identity();
  for (Eigen::Index i = 0; i < n; ++i)
    if (!frozen[static_cast<std::size_t>(i)])
      square.noalias() += attempt.jacobian.col(i) * attempt.jacobian.col(i).transpose();
  const Vector6 force = square.llt().solve(attempt.error);
  JointVector step(n);
  for (Eigen::Index i = 0; i < n; ++i)
    step[i] = frozen[static_cast<std::size_t>(i)] ? 0.0 : attempt.jacobian.col(i).dot(force);
  return step;
}

// A joint at its limit that is pushed outwards is frozen and the others take over.
void limited_step(const Attempt& attempt, const std::vector<JointLimits>& limits, JointVector& q) {
  const double damping = 1e-3 * std::min(1.0, measure(attempt.error)) + 1e-8;
  std::array<bool, 16> frozen{};
  JointVector step;
  for (Eigen::Index round = 0; round <= q.size(); ++round) {
    step = damped_step(attempt, frozen, damping);
    bool changed = false;
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const JointLimits& limit = limits[static_cast<std::size_t>(i)];
      const bool outwards = (step[i] > 0 && q[i] >= limit.upper) || (step[i] < 0 && q[i] <= limit.lower);
      if (!outwards || frozen[static_cast<std::size_t>(i)]) continue;
      frozen[static_cast<std::size_t>(i)] = changed = true;
    }
    if (!changed) break;
  }
  const double largest = step.cwiseAbs().maxCoeff();
  if (largest > kLargestStep) step *= kLargestStep / largest;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const JointLimits& limit = limits[static_cast<std::size_t>(i)];
    q[i] = std::clamp(q[i] + step[i], limit.lower, limit.upper);
  }
}

JointVector random_joints(const std::vector<JointLimits>& limits, Random& random) {
  JointVector q(static_cast<Eigen::Index>(limits.size()));
  for (std::size_t i = 0; i < limits.size(); ++i)
    q[static_cast<Eigen::Index>(i)] = random.between(limits[i].lower, limits[i].upper);
  return q;
}

void check_inputs(const Transform& target, const JointVector& start, int joints) {
  if (!target.matrix().allFinite() || !start.allFinite() || start.size() != joints)
    throw Error("inverse kinematics", "the pose and the start must be finite, with one start value for each joint");
}

}  // namespace

std::optional<JointVector> Arm::descend(const Transform& base_from_tip, JointVector q) const {
  const std::size_t n = axes_.size();
  Attempt attempt;
  attempt.jacobian.resize(6, static_cast<Eigen::Index>(n));
  std::array<Vector3, 16> origins;
  const auto evaluate = [&] {
    Transform joint = Transform::Identity();
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Index column = static_cast<Eigen::Index>(i);
      joint = product(joint, parent_from_joint_[i]);
      origins[i] = joint.translation();
      attempt.jacobian.col(column).tail<3>() = joint.linear() * axes_[i];
      joint.linear() *= Eigen::AngleAxisd(q[column], axes_[i]).toRotationMatrix();
    }
    const Transform tip = product(joint, last_from_tip_);
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Index column = static_cast<Eigen::Index>(i);
      const Vector3 axis = attempt.jacobian.col(column).tail<3>();
      attempt.jacobian.col(column).head<3>() = axis.cross(tip.translation() - origins[i]);
    }
    attempt.error.head<3>() = base_from_tip.translation() - tip.translation();
    attempt.error.tail<3>() = rotation_vector(base_from_tip.linear() * tip.linear().transpose());
  };
  evaluate();
  double best = measure(attempt.error);
  int idle = 0;
  for (int iteration = 0; iteration < kIterations && !converged(attempt.error); ++iteration) {
    limited_step(attempt, limits_, q);
    evaluate();
    const double now = measure(attempt.error);
    if (now < 0.98 * best) {
      best = now;
      idle = 0;
    } else if (++idle >= kPatience) {
      return std::nullopt;
    }
  }
  if (!converged(attempt.error)) return std::nullopt;
  // One more step squares the error: solutions are exact to about 1e-7 instead of just inside the tolerance.
  const JointVector accepted = q;
  const double error = measure(attempt.error);
  limited_step(attempt, limits_, q);
  evaluate();
  return measure(attempt.error) < error ? q : accepted;
}

std::optional<JointVector> Arm::solve(const Transform& world_from_tip, const JointVector& start, RandomKey key,
                                      int restarts) const {
  check_inputs(world_from_tip, start, joints());
  const Transform base_from_tip = world_from_base_.inverse() * world_from_tip;
  JointVector first = start;
  for (Eigen::Index i = 0; i < first.size(); ++i)
    first[i] =
        std::clamp(first[i], limits_[static_cast<std::size_t>(i)].lower, limits_[static_cast<std::size_t>(i)].upper);
  std::optional<JointVector> solution = descend(base_from_tip, first);
  Random random(key);
  for (int k = 0; k < restarts && !solution; ++k) solution = descend(base_from_tip, random_joints(limits_, random));
  return solution;
}

std::vector<JointVector> Arm::solutions(const Transform& world_from_tip, const JointVector& start, RandomKey key,
                                        int most, int restarts) const {
  check_inputs(world_from_tip, start, joints());
  const Transform base_from_tip = world_from_base_.inverse() * world_from_tip;
  std::vector<JointVector> found;
  Random random(key);
  for (int k = 0; k <= restarts && static_cast<int>(found.size()) < most; ++k) {
    JointVector q = k == 0 ? start : random_joints(limits_, random);
    for (Eigen::Index i = 0; i < q.size(); ++i)
      q[i] = std::clamp(q[i], limits_[static_cast<std::size_t>(i)].lower, limits_[static_cast<std::size_t>(i)].upper);
    const std::optional<JointVector> solution = descend(base_from_tip, q);
    if (!solution) continue;
    const bool known = std::any_of(found.begin(), found.end(), [&](const JointVector& other) {
      return (other - *solution).cwiseAbs().maxCoeff() <= kDistinct;
    });
    if (!known) found.push_back(*solution);
  }
  std::stable_sort(found.begin(), found.end(), [&](const JointVector& a, const JointVector& b) {
    return (a - start).squaredNorm() < (b - start).squaredNorm();
  });
  return found;
}

}  // namespace stampede
