// Mass matrix, gravity torques and tip Jacobian of the robot's arm, from where its parts are now.
#pragma once

#include <array>
#include <vector>

#include "engine/model/kinematics.h"

namespace stampede {

using JointMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 16, 16>;
using TipJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 16>;  // rows 0-2 linear, 3-5 angular; world axes

// A mass that the tip carries, rigidly.
struct Load {
  double mass = 0;                    // kg
  Vector3 centre = Vector3::Zero();   // of mass, world
  Matrix3 inertia = Matrix3::Zero();  // about it, world axes, kg m^2
};

// Composite rigid body algorithm (Featherstone, Rigid Body Dynamics Algorithms, 2008, section 6.2,
// doi:10.1007/978-1-4899-7560-7) in world axes about the first joint. Fingers count as carried by the last joint.
class ArmDynamics {
 public:
  ArmDynamics() = default;
  explicit ArmDynamics(const Robot& robot);
  void update(const std::vector<Transform>& world_from_part, const Vector3& gravity, const Load& load);

  const JointMatrix& mass() const { return mass_; }        // kg m^2, symmetric, positive definite
  const JointVector& gravity() const { return gravity_; }  // torques that hold the arm still, N m
  const TipJacobian& jacobian() const { return jacobian_; }
  const Transform& world_from_tip() const { return world_from_tip_; }

 private:
  struct Link {
    int part = 0;
    double mass = 0;
    Vector3 centre;
    Matrix3 inertia;
  };
  std::vector<std::vector<Link>> moved_;  // per joint: the parts that it is the last to move
  std::vector<int> arm_;
  std::vector<Vector3> axes_;  // in the part's frame
  int tip_part_ = 0;
  Transform tip_part_from_tip_ = Transform::Identity();

  JointMatrix mass_;
  JointVector gravity_;
  TipJacobian jacobian_;
  Transform world_from_tip_ = Transform::Identity();
};

}  // namespace stampede
