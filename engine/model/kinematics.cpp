#include "engine/model/kinematics.h"

#include <algorithm>
#include <numbers>

#include "engine/base/error.h"

namespace stampede {
namespace {

const Part& part_at(const Body& body, int index) { return body.parts[static_cast<std::size_t>(index)]; }

void check(const Robot& robot) {
  const std::string where = robot.name.empty() ? "robot" : robot.name;
  const auto fail = [&](const std::string& what, const std::string& hint) { throw Error(where, what, hint); };
  const int parts = static_cast<int>(robot.body.parts.size());
  if (robot.arm.empty() || robot.arm.size() > 16)
    fail("an arm has 1 to 16 driven joints, not " + std::to_string(robot.arm.size()), "list them from base to tip");
  if (robot.limits.size() != robot.arm.size() || robot.home.size() != robot.arm.size())
    fail("limits and home need one entry for each driven joint", "give as many as the arm has joints");
  if (robot.tip_part < 0 || robot.tip_part >= parts) fail("its tip names no part", "name a link of the robot");
  for (std::size_t i = 0; i < robot.arm.size(); ++i) {
    if (robot.arm[i] < 0 || robot.arm[i] >= parts) fail("its arm names no part", "name links of the robot");
    const Joint& joint = part_at(robot.body, robot.arm[i]).joint;
    if (joint.kind != JointKind::hinge)
      fail("joint '" + joint.name + "' of the arm is not a hinge", "only turning joints can be driven as an arm");
    if (!(robot.limits[i].lower < robot.limits[i].upper))
      fail("joint '" + joint.name + "' has no room between its limits", "give lower < upper");
  }
}

void turn(Transform& frame, const Vector3& axis, double angle) {
  frame.linear() *= Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

}  // namespace

double lead_of(const Joint& joint) { return joint.kind == JointKind::screw ? joint.pitch / (2 * std::numbers::pi) : 0; }

Transform joint_motion(const Joint& joint, double position) {
  const Vector3 axis = joint.axis.normalized();
  switch (joint.kind) {
    case JointKind::hinge:
      return Transform(Eigen::AngleAxisd(position, axis));
    case JointKind::slider:
      return translation(position * axis);
    case JointKind::screw:
      return translation(lead_of(joint) * position * axis) * Transform(Eigen::AngleAxisd(position, axis));
    case JointKind::fixed:
      break;
  }
  return Transform::Identity();
}

void forward_kinematics(const Body& body, const Transform& world_from_base, std::span<const double> part_positions,
                        std::vector<Transform>& world_from_part) {
  if (part_positions.size() != body.parts.size())
    throw Error(body.name, "a body's joint positions need one entry for each of its parts",
                "give 0 for the base and for fixed joints");
  world_from_part.resize(body.parts.size());
  for (std::size_t i = 0; i < body.parts.size(); ++i) {
    const Part& part = body.parts[i];
    if (part.parent < 0) {
      world_from_part[i] = world_from_base;
      continue;
    }
    const Transform& parent = world_from_part[static_cast<std::size_t>(part.parent)];
    Transform& here = world_from_part[i];
    here = product(parent, part.joint.parent_from_joint);
    const Joint& joint = part.joint;
    if (joint.kind == JointKind::slider || joint.kind == JointKind::screw) {
      const double way = part_positions[i] * (joint.kind == JointKind::slider ? 1 : lead_of(joint));
      here.translation() += way * (here.linear() * joint.axis.normalized());
    }
    if (joint.kind == JointKind::hinge || joint.kind == JointKind::screw)
      turn(here, joint.axis.normalized(), part_positions[i]);
  }
}

Arm::Arm(const Robot& robot) : world_from_base_(robot.body.world_from_body), limits_(robot.limits) {
  check(robot);
  std::vector<int> chain;  // base to tip
  for (int part = robot.tip_part; part >= 0; part = part_at(robot.body, part).parent) chain.push_back(part);
  std::reverse(chain.begin(), chain.end());
  Transform pending = Transform::Identity();  // everything fixed since the last driven joint
  std::size_t next = 0;
  for (const int index : chain) {
    const Part& part = part_at(robot.body, index);
    if (part.parent < 0) continue;
    pending = pending * part.joint.parent_from_joint;
    if (next < robot.arm.size() && robot.arm[next] == index) {
      parent_from_joint_.push_back(pending);
      axes_.push_back(part.joint.axis.normalized());
      pending = Transform::Identity();
      ++next;
    } else {
      pending = pending * joint_motion(part.joint, part.joint.initial);
    }
  }
  if (next != robot.arm.size())
    throw Error(robot.name, "the arm's joints do not lie in order between its base and its tip",
                "list the driven joints from base to tip, and a tip behind the last");
  last_from_tip_ = pending * robot.tip_part_from_tip;
  home_ = Eigen::Map<const Eigen::VectorXd>(robot.home.data(), static_cast<Eigen::Index>(robot.home.size()));
}

int Arm::joints() const { return static_cast<int>(axes_.size()); }
const std::vector<JointLimits>& Arm::limits() const { return limits_; }
const JointVector& Arm::home() const { return home_; }

Transform Arm::base_from_tip(const JointVector& q) const {
  Transform base_from_joint = Transform::Identity();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    base_from_joint = product(base_from_joint, parent_from_joint_[i]);
    turn(base_from_joint, axes_[i], q[static_cast<Eigen::Index>(i)]);
  }
  return product(base_from_joint, last_from_tip_);
}

Transform Arm::world_from_tip(const JointVector& q) const { return product(world_from_base_, base_from_tip(q)); }

Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 16> Arm::jacobian(const JointVector& q) const {
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 16> result(6, q.size());
  std::array<Vector3, 16> origins;
  Transform world_from_joint = world_from_base_;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Eigen::Index column = static_cast<Eigen::Index>(i);
    world_from_joint = product(world_from_joint, parent_from_joint_[i]);
    origins[i] = world_from_joint.translation();
    result.col(column).tail<3>() = world_from_joint.linear() * axes_[i];
    turn(world_from_joint, axes_[i], q[column]);
  }
  const Vector3 tip = world_from_joint * last_from_tip_.translation();
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const Vector3 axis = result.col(i).tail<3>();
    result.col(i).head<3>() = axis.cross(tip - origins[static_cast<std::size_t>(i)]);
  }
  return result;
}

double Arm::greatest_speed(const JointVector& q, const JointVector& velocity, double around) const {
  Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
  Transform world_from_joint = world_from_base_;
  double greatest = 0;
  const auto go_to = [&](const Transform& next) {
    const Vector3 way = next.translation() - world_from_joint.translation();
    linear += angular.cross(way);
    world_from_joint = next;
    greatest = std::max(greatest, linear.norm() + around * angular.norm());
  };
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const auto joint = static_cast<Eigen::Index>(i);
    go_to(product(world_from_joint, parent_from_joint_[i]));
    angular += velocity[joint] * (world_from_joint.linear() * axes_[i]);
    turn(world_from_joint, axes_[i], q[joint]);
  }
  go_to(product(world_from_joint, last_from_tip_));
  return greatest;
}

bool Arm::within_limits(const JointVector& q, double margin_rad) const {
  if (q.size() != joints()) return false;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const JointLimits& limit = limits_[static_cast<std::size_t>(i)];
    // Written so that a position that is not a number is outside.
    if (!(q[i] >= limit.lower + margin_rad && q[i] <= limit.upper - margin_rad)) return false;
  }
  return true;
}

}  // namespace stampede
