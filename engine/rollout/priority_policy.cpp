#include "engine/rollout/priority_policy.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace stampede {
namespace {

constexpr double kPolicyDamping = 0.02;
constexpr double kToolGain = 4, kPostureGain = 1.5;  // 1/s
constexpr double kMostRate = 0.5;                    // rad/s
constexpr double kThere_rad = 0.01, kStuck_rad_s = 0.004;

Transform tool_of(const EnvironmentObservation& now) {
  const std::vector<double>& v = now["gripper_pose"].reals();
  return to_transform({{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}});
}

Eigen::MatrixXd jacobian_of(const EnvironmentObservation& now) {
  const std::vector<double>& values = now["tool_jacobian"].reals();
  const auto joints = static_cast<Eigen::Index>(values.size() / 6);
  using RowMajor = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), 6, joints);
}

// The tool stays at a pose.
Controller keep_tool(const Transform& wanted) {
  return [wanted](const EnvironmentObservation& now) {
    const Transform tool = tool_of(now);
    Quaternion turn(Matrix3(wanted.linear() * tool.linear().transpose()));
    if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
    Objective objective{jacobian_of(now), Eigen::VectorXd(6)};
    objective.rate << kToolGain * (wanted.translation() - tool.translation()), 2 * kToolGain * turn.vec();
    return objective;
  };
}

// One joint goes to a position, no faster than is pleasant.
Controller turn_joint(Eigen::Index joint, double wanted) {
  return [joint, wanted](const EnvironmentObservation& now) {
    const std::vector<double>& q = now["joint_positions"].reals();
    Objective objective{Eigen::MatrixXd::Zero(1, static_cast<Eigen::Index>(q.size())), Eigen::VectorXd(1)};
    objective.jacobian(0, joint) = 1;
    objective.rate[0] = std::clamp(kPostureGain * (wanted - q[static_cast<std::size_t>(joint)]), -kMostRate, kMostRate);
    return objective;
  };
}

class KeepTool final : public Policy {
 public:
  void begin(const PolicyCall& call) override {
    const auto given = call.parameters.find("elbow");
    if (given != call.parameters.end() && !given->second.empty()) turn_ = given->second.front();
  }

  std::optional<AgentAction> act(const EnvironmentObservation& now) override {
    const std::vector<double>& q = now["joint_positions"].reals();
    if (controllers_.empty()) {
      wanted_ = q[0] + turn_;
      controllers_ = {keep_tool(tool_of(now)), turn_joint(0, wanted_)};
    }
    if (std::abs(wanted_ - q[0]) < kThere_rad) return std::nullopt;
    std::vector<Objective> objectives;
    for (const Controller& one : controllers_) objectives.push_back(one(now));
    const Eigen::VectorXd rate = by_priority(objectives, static_cast<Eigen::Index>(q.size()));
    if (frames_++ > 10 && std::abs(rate[0]) < kStuck_rad_s) return std::nullopt;
    return AgentAction{.space = "joint_velocity", .values = {rate.data(), rate.data() + rate.size()}};
  }

 private:
  double turn_ = 0.4, wanted_ = 0;
  int frames_ = 0;
  std::vector<Controller> controllers_;
};

}  // namespace

Eigen::VectorXd by_priority(const std::vector<Objective>& objectives, Eigen::Index joints) {
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(joints);
  Eigen::MatrixXd free = Eigen::MatrixXd::Identity(joints, joints);  // projector on what is left
  for (const Objective& one : objectives) {
    const Eigen::MatrixXd own = one.jacobian * free;
    Eigen::MatrixXd squared = own * own.transpose();
    squared.diagonal().array() += kPolicyDamping * kPolicyDamping;
    const Eigen::MatrixXd inverse =
        own.transpose() * squared.ldlt().solve(Eigen::MatrixXd::Identity(own.rows(), own.rows()));
    rate += inverse * (one.rate - one.jacobian * rate);
    // Without damping: what is damped away would leak into the objectives before.
    const Eigen::MatrixXd exact = own.completeOrthogonalDecomposition().pseudoInverse();
    free -= exact * own;
  }
  return rate;
}

PolicyEntry keep_tool_policy() {
  PolicyEntry entry;
  entry.make = [] { return std::make_unique<KeepTool>(); };
  entry.channels = {"joint_positions", "gripper_pose", "tool_jacobian"};
  entry.version = "1";
  return entry;
}

}  // namespace stampede
