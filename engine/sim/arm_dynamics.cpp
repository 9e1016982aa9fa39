#include "engine/sim/arm_dynamics.h"

#include <algorithm>

namespace stampede {
namespace {

// Mass, first moment and second moment about one origin: what moves together, added up.
struct Composite {
  double mass = 0;
  Vector3 moment = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();

  void add(double added_mass, const Vector3& centre, const Matrix3& inertia_about_centre) {
    mass += added_mass;
    moment += added_mass * centre;
    inertia += inertia_about_centre;
    inertia += added_mass * (centre.squaredNorm() * Matrix3::Identity() - centre * centre.transpose());
  }
};

}  // namespace

ArmDynamics::ArmDynamics(const Robot& robot)
    : moved_(robot.arm.size()),
      arm_(robot.arm),
      tip_part_(robot.tip_part),
      tip_part_from_tip_(robot.tip_part_from_tip) {
  const auto joints = static_cast<Eigen::Index>(arm_.size());
  mass_.setZero(joints, joints);
  gravity_.setZero(joints);
  jacobian_.setZero(6, joints);
  for (const int part : arm_) axes_.push_back(robot.body.parts[static_cast<std::size_t>(part)].joint.axis.normalized());
  for (std::size_t p = 0; p < robot.body.parts.size(); ++p) {
    const Part& part = robot.body.parts[p];
    auto mover = arm_.end();
    for (int at = static_cast<int>(p); at >= 0 && mover == arm_.end();
         at = robot.body.parts[static_cast<std::size_t>(at)].parent)
      mover = std::find(arm_.begin(), arm_.end(), at);
    if (mover == arm_.end() || part.mass <= 0) continue;
    moved_[static_cast<std::size_t>(mover - arm_.begin())].push_back(
        {static_cast<int>(p), part.mass, part.centre_of_mass, part.inertia});
  }
}

void ArmDynamics::update(const std::vector<Transform>& world_from_part, const Vector3& gravity, const Load& load) {
  const std::size_t joints = arm_.size();
  const auto pose = [&](int part) -> const Transform& { return world_from_part[static_cast<std::size_t>(part)]; };
  const Vector3 origin = pose(arm_[0]).translation();
  world_from_tip_ = pose(tip_part_) * tip_part_from_tip_;
  std::array<Vector3, 16> turning, linear;  // of each joint at unit speed; linear at the origin
  for (std::size_t j = 0; j < joints; ++j) {
    const Transform& joint = pose(arm_[j]);
    turning[j] = joint.linear() * axes_[j];
    linear[j] = (joint.translation() - origin).cross(turning[j]);
    const auto column = static_cast<Eigen::Index>(j);
    jacobian_.col(column).head<3>() = turning[j].cross(world_from_tip_.translation() - joint.translation());
    jacobian_.col(column).tail<3>() = turning[j];
  }
  Composite composite;
  if (load.mass > 0) composite.add(load.mass, load.centre - origin, load.inertia);
  for (std::size_t j = joints; j-- > 0;) {
    for (const Link& link : moved_[j]) {
      const Transform& part = pose(link.part);
      composite.add(link.mass, part * link.centre - origin, part.linear() * link.inertia * part.linear().transpose());
    }
    const auto row = static_cast<Eigen::Index>(j);
    const Vector3 momentum = composite.mass * linear[j] + turning[j].cross(composite.moment);
    const Vector3 spin = composite.inertia * turning[j] + composite.moment.cross(linear[j]);
    for (std::size_t i = 0; i <= j; ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      mass_(row, column) = mass_(column, row) = turning[i].dot(spin) + linear[i].dot(momentum);
    }
    gravity_[row] = -(turning[j].dot(composite.moment.cross(gravity)) + composite.mass * linear[j].dot(gravity));
  }
}

}  // namespace stampede
