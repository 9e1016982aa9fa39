// Forward and inverse kinematics of a robot's arm.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/random.h"
#include "engine/model/scene.h"

namespace stampede {

using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 16, 1>;  // at most 16 joints, no allocation

// World poses of all parts of a body whose joint positions are given per part (fixed and base entries ignored).
void forward_kinematics(const Body& body, const Transform& world_from_base, std::span<const double> part_positions,
                        std::vector<Transform>& world_from_part);

// What is missing of a pose that an arm cannot reach: it would have to be `way_m` nearer to the arm's shoulder, or
// where `joint` is an index (from 0), that joint would have to turn by `angle` rad beyond a limit.
struct Shortfall {
  double way_m = 0;
  int joint = -1;
  double angle = 0;
};

class Arm {
 public:
  explicit Arm(const Robot& robot);  // copies what it needs
  int joints() const;
  const std::vector<JointLimits>& limits() const;
  const JointVector& home() const;

  Transform base_from_tip(const JointVector& q) const;
  Transform world_from_tip(const JointVector& q) const;
  // Geometric Jacobian of the tip in world axes: rows 0-2 linear (m/rad), 3-5 angular. Shape: 6 x joints.
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 16> jacobian(const JointVector& q) const;
  // Of what moves: the fastest of all points that are no farther than `around` (m) from a joint or from the tip, if
  // each link were as thick. m/s.
  double greatest_speed(const JointVector& q, const JointVector& velocity, double around) const;
  bool within_limits(const JointVector& q, double margin_rad = 0) const;

  // Damped least squares (Nakamura, Hanafusa, JDSMC 1986, doi:10.1115/1.3143764) with joint limits and random
  // restarts. Result: nothing when no restart converges to 0.1 mm and 1e-3 rad. Repeatable: a pure function of
  // its arguments.
  std::optional<JointVector> solve(const Transform& world_from_tip, const JointVector& start, RandomKey key,
                                   int restarts = 50) const;
  // Distinct solutions (any joint differs by more than 0.1 rad), nearest to `start` first.
  std::vector<JointVector> solutions(const Transform& world_from_tip, const JointVector& start, RandomKey key, int most,
                                     int restarts = 50) const;
  // For people: the least of both, 0.3 m to a radian. Nothing where neither would do. As costly as ten solutions.
  std::optional<Shortfall> shortfall(const Transform& world_from_tip, const JointVector& start, RandomKey key) const;

 private:
  std::optional<Shortfall> beyond_limits(const Transform& world_from_tip, const JointVector& start,
                                         RandomKey key) const;
  std::optional<Shortfall> nearer(const Transform& world_from_tip, const JointVector& start, RandomKey key) const;
  std::optional<JointVector> descend(const Transform& base_from_tip, JointVector q) const;
  Transform world_from_base_;
  std::vector<Transform> parent_from_joint_;  // fixed transforms between driven joints folded in
  std::vector<Vector3> axes_;
  Transform last_from_tip_;
  std::vector<JointLimits> limits_;
  JointVector home_;
};

}  // namespace stampede
