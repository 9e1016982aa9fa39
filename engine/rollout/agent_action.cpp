#include "engine/rollout/agent_action.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/base/nearest.h"
#include "engine/rollout/call_motion.h"
#include "engine/start/call_settings.h"

namespace stampede {
namespace {

constexpr double kDamping = 0.01;  // of the pseudo-inverse, m or rad per rad

Vector3 three(const std::vector<double>& values, std::size_t from) {
  return {values[from], values[from + 1], values[from + 2]};
}

Transform pose_of(const std::vector<double>& values) {
  Transform pose = Transform::Identity();
  pose.translation() = three(values, 0);
  pose.linear() = Quaternion(values[6], values[3], values[4], values[5]).normalized().toRotationMatrix();
  return pose;
}

Matrix3 turned(const Vector3& rotation) {
  const double angle = rotation.norm();
  if (angle < 1e-12) return Matrix3::Identity();
  return Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
}

JointVector vector_of(const std::vector<double>& values, std::size_t count) {
  JointVector result(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) result[static_cast<Eigen::Index>(i)] = values[i];
  return result;
}

// Damped least squares along a twist that stays the same for one frame, in small steps (Nakamura, Hanafusa, JDSMC
// 1986, doi:10.1115/1.3143764).
JointVector along(const Arm& arm, JointVector q, const Eigen::Matrix<double, 6, 1>& twist, double seconds) {
  constexpr int kParts = 12;
  using Square = Eigen::Matrix<double, 6, 6>;
  for (int i = 0; i < kParts; ++i) {
    const auto jacobian = arm.jacobian(q);
    const Square squared = jacobian * jacobian.transpose() + kDamping * kDamping * Square::Identity();
    q += jacobian.transpose() * squared.ldlt().solve(twist) * (seconds / kParts);
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      const JointLimits& limits = arm.limits()[static_cast<std::size_t>(k)];
      if (limits.lower < limits.upper) q[k] = std::clamp(q[k], limits.lower, limits.upper);
    }
  }
  return q;
}

ControllerKind controller_of(const AgentAction& action) {
  if (action.space == "tool_impedance") return ControllerKind::cartesian_impedance;
  return controller_from(action.controller).value_or(ControllerKind::joint_position);
}

// A controller that is stiffer than the one before begins where contact has left the arm: it must not jump.
void set_controller(const AgentAction& action, const World& world, std::vector<Operation>& operations) {
  operation::Controller wanted{controller_of(action), action.space == "tool_impedance" ? action.values[7] : 0};
  const operation::Controller& now = world.controller();
  if (wanted.kind == now.kind && wanted.stiffness == now.stiffness) return;
  if (wanted.kind == ControllerKind::joint_position)
    operations.push_back(operation::Setpoint{world.arm_position(), world.arm_velocity()});
  operations.push_back(wanted);
}

void set_hand(double opening, const World& world, std::vector<Operation>& operations) {
  if (opening != world.commanded_opening())
    operations.push_back(operation::Hand{opening, world.scene().robot.grip_force});
}

// Told again, a hand that holds nothing any more stays beside what its fingers would meet.
double opening_of_release(Rollout& rollout) {
  const World& world = rollout.world();
  const auto held = world.grasped();
  return opening_beside(world.arm_position(), *planning_space(rollout, {}), held, world.scene().robot.opening_max,
                        held.has_value());
}

}  // namespace

Operation rest(const World& world) {
  return operation::Servo{operation::Servo::Of::velocity, JointVector::Zero(world.arm().joints())};
}

CallSettings settings_of(const AgentAction& action) {
  CallSettings set;
  for (const SkillParameter& one : action.parameters) set.values.push_back({one.name, 0, one.values});
  set.controller = controller_from(action.controller);
  return set;
}

Transform tool_target(const AgentAction& action, const World& world) {
  const Transform now = world.arm().world_from_tip(world.reference().position);
  const bool own = action.frame == "tool";
  if (action.space != "tool_delta" && action.space != "tool_path_delta")
    return own ? now * pose_of(action.values) : pose_of(action.values);
  const Vector3 way = three(action.values, 0), turn = three(action.values, 3);
  Transform target = now;
  target.translation() += own ? Vector3(now.linear() * way) : way;
  target.linear() = own ? Matrix3(now.linear() * turned(turn)) : Matrix3(turned(turn) * now.linear());
  return target;
}

std::variant<std::vector<Operation>, ActionRefusal> operations_for(const AgentAction& action, Rollout& rollout) {
  using operation::Servo;
  const World& world = rollout.world();
  std::vector<Operation> operations;
  const Arm& arm = world.arm();
  const auto joints = static_cast<std::size_t>(arm.joints());
  const std::string& space = action.space;
  if (space == "gripper" || space == "release") {
    if (world.steered()) operations.push_back(rest(world));
    set_hand(space == "gripper" ? action.values[0] : opening_of_release(rollout), world, operations);
    return operations;
  }
  if (action.gripper) set_hand(*action.gripper, world, operations);
  if (space == "joint_torque") {
    operations.push_back(Servo{Servo::Of::torque, vector_of(action.values, joints)});
    return operations;
  }
  set_controller(action, world, operations);
  const JointVector from = world.reference().position;
  if (space == "joint_velocity") {
    operations.push_back(Servo{Servo::Of::velocity, vector_of(action.values, joints)});
    return operations;
  }
  JointVector target;
  if (space == "joint_position") {
    target = vector_of(action.values, joints);
  } else if (space == "joint_delta") {
    target = from + vector_of(action.values, joints);
  } else if (space == "tool_velocity") {
    const Matrix3 axes =
        action.frame == "tool" ? Matrix3(arm.world_from_tip(from).linear()) : Matrix3(Matrix3::Identity());
    Eigen::Matrix<double, 6, 1> twist;
    twist << axes * three(action.values, 0), axes * three(action.values, 3);
    target = along(arm, from, twist, 1.0 / world.scene().frame_hz);
  } else {
    const auto found = arm.solve(tool_target(action, world), from, RandomKey("tool"), 0);
    if (!found)
      return ActionRefusal{"no joint positions near the present ones reach that pose", "a nearer pose, or tool_path"};
    target = *found;
  }
  // Joint positions one after the other are a way, as of a recorded arm, and so are those of a speed that is kept; a
  // delta and a pose are places to be at.
  const bool way = space == "joint_position" || space == "tool_velocity";
  const auto of = way ? Servo::Of::passage : Servo::Of::position;
  operations.push_back(Servo{of, std::move(target)});
  return operations;
}

}  // namespace stampede
