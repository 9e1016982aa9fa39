// The robot's controllers, once per physics step, and the motors that carry them out.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/sim/robot_control.h"

namespace stampede {
namespace {

constexpr double kJointStiffness = 600;   // N m/rad of the strongest joint
constexpr double kTipStiffness = 800;     // N/m
constexpr double kTurnOverTip = 0.04;     // (N m/rad) per (N/m)
constexpr double kPostureStiffness = 20;  // N m/rad, in the null space of the tip
constexpr double kSingularity = 1e-4;     // damping of the null-space projector
// A finger just told to move is not blocked. Nor is one whose contact has just been dropped: asked for so much speed,
// it would be deep in what it holds before contact is found again.
constexpr std::int64_t kStartSteps = 3;
constexpr double kBlockedLag = 0.001;   // m
constexpr double kBlockedSpeed = 0.25;  // of finger_speed
constexpr double kPressSpeed = 0.35;    // m/s
constexpr double kDefaultEffort = 100;  // N m or N, where a robot states none
// What an arm gives against contact, measured at its tip, and beside it the weight of what it holds; a wrist's short
// lever needs some torque of its own.
constexpr double kPress = 35;         // N
constexpr double kLeastTorque = 6;    // N m
constexpr double kLoadRate = 14;      // m/s^2: gravity and what carrying adds
constexpr double kShortLever = 2;     // N m, however short the lever of a contact
constexpr double kPlannedPress = 50;  // N on a contact, of an arm that follows a plan: one that an agent steers, kPress
constexpr double kRubbing = 0.15;     // N along a surface, per N on it
constexpr double kCatchUp = 0.3;      // share of a joint's acceleration for getting back to its reference
constexpr double kCatchUpTouching = 0.05;  // likewise, while something bears on an arm that an agent steers
constexpr double kBrakedToolSpeed = 1.65;  // m/s: faster than it is led (kToolSpeed)
constexpr double kSlip = 0.25;             // share of a joint's speed
constexpr double kMostPull = 60;           // N at the tip, of an arm that gives way

// Rotation vector of `to` seen from `from`, in world axes.
Vector3 turn_between(const Matrix3& from, const Matrix3& to) {
  Quaternion turn(Matrix3(to * from.transpose()));
  if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
  const double sine = turn.vec().norm();
  if (sine < 1e-12) return 2 * turn.vec();
  return turn.vec() * (2 * std::atan2(sine, turn.w()) / sine);
}

double effort_of(const JointLimits& limits) { return limits.effort > 0 ? limits.effort : kDefaultEffort; }

}  // namespace

void RobotControl::step() {
  look_ahead();
  movers_.set_brakes(tree(), {});
  if (under_torque()) {
    control_torque(reference.servo->value);
    control_hand();
    return;
  }
  const double lead = controller.kind == ControllerKind::joint_position ? kLead_rad : kYieldingLead_rad;
  const JointState next = reference.servo
                              ? served(reference_now, clock_.steps, {reference.pace, position(), lead}, acted_)
                              : reference_at(clock_.steps + 1);
  switch (controller.kind) {
    case ControllerKind::joint_position:
      control_position(reference_now, next);
      break;
    case ControllerKind::joint_impedance:
      control_joint_impedance(next);
      break;
    case ControllerKind::cartesian_impedance:
      control_cartesian_impedance(next);
      break;
  }
  reference_now = next;
  control_hand();
}

double RobotControl::load_mass() const {
  double mass = 0;
  if (const auto held = carried())
    for (const Part& one : bodies_.body(held->body).parts) mass += one.mass;
  return mass;
}

// How a joint of the arm at 1 rad/s, or 1 m/s, moves a point that goes with it, m/s.
Vector3 RobotControl::lever(std::size_t joint, const Vector3& point) const {
  const PartRef moved{kRobot, robot_.arm[joint]};
  const Transform& pose = bodies_.world_from_part(moved);
  const Joint& own = bodies_.part(moved).joint;
  const Vector3 axis = pose.linear() * own.axis.normalized();
  return own.kind == JointKind::slider ? axis : axis.cross(point - pose.translation());
}

bool RobotControl::moves(std::size_t joint, PartRef link) const {
  if (link.body != kRobot) return true;  // the hand holds it
  int at = link.part;
  while (at > robot_.arm[joint]) at = bodies_.part({kRobot, at}).parent;
  return at == robot_.arm[joint];
}

Vector3 RobotControl::motion_of(PartRef link, const Vector3& point, const JointVector& change) const {
  Vector3 motion = Vector3::Zero();
  for (std::size_t j = 0; j < robot_.arm.size(); ++j)
    if (moves(j, link)) motion += change[static_cast<Eigen::Index>(j)] * lever(j, point);
  return motion;
}

// What a joint of the arm has to give for a newton of each contact of the links that it moves: of the contact for which
// that is least. At the tip it is much, where a link lies on an edge or on another link it is little, and a joint that
// moves its link along a surface hardly presses on it. m. Empty: nothing is touched.
std::vector<double> RobotControl::contact_levers() const {
  std::vector<double> levers;
  const auto held = grasped();
  const auto meet = [&](PartRef link, PartRef other, const Vector3& point, const Vector3& along) {
    if (link.body != kRobot || (held == other && bodies_.body(other.body).free)) return;
    if (levers.empty()) levers.assign(robot_.arm.size(), std::numeric_limits<double>::infinity());
    for (std::size_t j = 0; j < robot_.arm.size(); ++j) {
      if (!moves(j, link)) continue;
      const Vector3 way = lever(j, point);
      const bool pulls =
          held == other && std::find(robot_.pads.begin(), robot_.pads.end(), link.part) != robot_.pads.end();
      levers[j] = std::min(levers[j], pulls ? way.norm() : std::abs(way.dot(along)) + kRubbing * way.norm());
    }
  };
  contacts_.visit([&](PartRef one, PartRef other, const Vector3& point, const Vector3& along) {
    meet(one, other, point, along);
    meet(other, one, point, along);
  });
  return levers;
}

// The motors' velocity rows: where the joint is on its reference now, it is on it after the step too. Off it, by
// contact, it comes back within the joint's limits, and contact never bears more than a hand's push: a stiff arm in its
// way would else press with all it has, and whip forward when it comes free.
void RobotControl::control_position(const JointState& now, const JointState& next) {
  const bool moving = reference.trajectory != nullptr || reference.servo;
  const JointVector q = position(), v = velocity();
  const auto jacobian = arm_.jacobian(q);
  const double load = kLoadRate * load_mass();  // N
  const std::vector<double> levers = contact_levers();
  const double on_contact = reference.servo ? kPress : kPlannedPress;
  const bool careful = reference.servo && !levers.empty();
  for (std::size_t j = 0; j < arm_motors_.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    const JointLimits& limits = robot_.limits[j];
    JointMotor& motor = *arm_motors_[j];
    const double steady = moving ? (next.position[i] - now.position[i]) / dt_ : next.velocity[i];
    const double most = acceleration_of(limits), fastest = std::max(speed_of(limits), std::abs(steady));
    const double error = now.position[i] - q[i];
    // A reference that brakes does not press on.
    const double most_own = std::max({0.0, now.acceleration[i], next.acceleration[i]});
    const double least_own = std::min({0.0, now.acceleration[i], next.acceleration[i]});
    const double back = most * (careful ? kCatchUpTouching : kCatchUp);
    const double wanted = std::clamp(steady + catching_up(error, back), -fastest, fastest);
    motor.velocity = std::clamp(wanted, v[i] + dt_ * (least_own - back), v[i] + dt_ * (most_own + back));
    motor.most_force = effort_of(limits);
    const double reach = jacobian.col(i).head<3>().norm();
    motor.against_contact = std::max(kLeastTorque, (kPress + load) * reach);
    if (!levers.empty())
      motor.against_contact =
          std::min(motor.against_contact, load * reach + std::max(kShortLever, on_contact * levers[j]));
    if (reference.servo && motor.saturated && std::abs(error) > 1e-3)
      acted_.note(std::abs(motor.force) > 0.999 * motor.most_force ? Limit::torque : Limit::contact);
  }
  if (reference.servo) keep_tool_slow(jacobian);
  arm_torque.setZero();
  foreseen.resize(0);
}

// An arm that gets back to its reference is faster than that; its tool must not be.
void RobotControl::keep_tool_slow(const TipJacobian& jacobian) {
  JointVector speeds(jacobian.cols());
  for (Eigen::Index i = 0; i < speeds.size(); ++i) speeds[i] = arm_motors_[static_cast<std::size_t>(i)]->velocity;
  const double speed = (jacobian.topRows<3>() * speeds).norm();
  if (speed <= kBrakedToolSpeed) return;
  acted_.note(Limit::tool_speed);
  for (JointMotor* motor : arm_motors_) motor->velocity *= kBrakedToolSpeed / speed;
}

void RobotControl::update_dynamics() {
  Load load;
  if (const auto held = carried()) {
    const Part& carried = bodies_.part({held->body, 0});  // what moves on it is light
    const Transform& pose = bodies_.world_from_part({held->body, 0});
    for (const Part& one : bodies_.body(held->body).parts) load.mass += one.mass;
    load.centre = pose * carried.centre_of_mass;
    load.inertia = pose.linear() * carried.inertia * pose.linear().transpose();
  }
  arm_dynamics_.update(bodies_.world_from_robot_parts(), bodies_.scene().gravity, load);
}

// The motors are given no force, so that only the torque acts; torques stop at the joints' limits.
void RobotControl::give_torques(JointVector torque) {
  for (std::size_t j = 0; j < arm_motors_.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    const double most = effort_of(robot_.limits[j]);
    if (std::abs(torque[i]) > most) acted_.note(Limit::torque);
    torque[i] = std::clamp(torque[i], -most, most);
    arm_motors_[j]->most_force = 0;
    tree().torque[static_cast<std::size_t>(arm_motors_[j]->dof)] += torque[i];
  }
  arm_torque = torque;
  if (reference.servo) movers_.set_brakes(tree(), speed_brakes());
}

// What is asked for, but for the part of it that would take a joint beyond its limits. Nobody takes off centrifugal and
// Coriolis forces for an agent that gives torques, but what is left of its limits counts with them.
void RobotControl::control_torque(const JointVector& asked) {
  update_dynamics();
  const JointMatrix& mass = arm_dynamics_.mass();
  const std::vector<double>& fictitious = tree().find_coriolis();
  JointVector moving = asked;
  for (std::size_t j = 0; j < arm_motors_.size(); ++j)
    moving[static_cast<Eigen::Index>(j)] -= fictitious[static_cast<std::size_t>(arm_motors_[j]->dof)];
  const JointVector free = mass.ldlt().solve(moving);
  foreseen.resize(0);
  give_torques(arm_dynamics_.gravity() + asked + mass * (kept_safe(free, kMargin_rad) - free));
}

// What pushes an arm that an agent steers, and what turns as it goes, makes it no faster than it may be: in the same
// step each joint holds against that, and all together for the tool.
std::vector<SpeedBrake> RobotControl::speed_brakes() const {
  const TipJacobian& jacobian = arm_dynamics_.jacobian();
  const std::vector<JointLimits>& limits = robot_.limits;
  const auto dofs = static_cast<std::size_t>(tree().dofs());
  const Vector3 ahead = (jacobian.topRows<3>() * velocity()).normalized();
  std::vector<SpeedBrake> brakes(1 + arm_motors_.size());
  SpeedBrake& tool = brakes.front();  // before the joints', which it may make faster
  tool = {std::vector<double>(dofs), kBrakedToolSpeed, std::numeric_limits<double>::infinity()};
  for (std::size_t j = 0; j < arm_motors_.size(); ++j) {
    const auto dof = static_cast<std::size_t>(arm_motors_[j]->dof);
    const double lever = jacobian.col(static_cast<Eigen::Index>(j)).head<3>().dot(ahead);
    tool.jacobian[dof] = lever;
    if (lever != 0) tool.most_force = std::min(tool.most_force, effort_of(limits[j]) / std::abs(lever));
    brakes[1 + j] = {std::vector<double>(dofs), speed_of(limits[j]), effort_of(limits[j])};
    brakes[1 + j].jacobian[dof] = 1;
  }
  return brakes;
}

// The nearest acceleration that an arm may have which an agent steers.
JointVector RobotControl::kept_safe(const JointVector& acceleration, double margin) {
  const Governor governor(arm_, dt_, {reference.pace, {}}, acted_);
  return governor.safe_acceleration(acceleration, position(), velocity(), margin);
}

// What keeps an arm within its limits that an agent steers, beside a controller that would give it this acceleration in
// free air. What contact took from it in the step before, it is taken to bear again: held so, a joint gets more torque
// than its limit of acceleration takes, but no more than a step can turn into `kSlip` of its speed when contact ends.
JointVector RobotControl::held_back(const JointVector& acceleration) {
  if (!reference.servo) {
    foreseen.resize(0);
    return JointVector::Zero(acceleration.size());
  }
  const JointVector v = velocity();
  JointVector expected = acceleration;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const double most = kSlip * speed_of(robot_.limits[static_cast<std::size_t>(i)]) / dt_;
    const double borne = foreseen.size() > 0 ? std::clamp((v[i] - foreseen[i]) / dt_, -most, most) : 0;
    expected[i] += std::clamp(borne, std::min(0.0, -acceleration[i]), std::max(0.0, -acceleration[i]));
  }
  const JointVector given = acceleration + kept_safe(expected, 0) - expected;
  foreseen = v + dt_ * given;
  return arm_dynamics_.mass() * (given - acceleration);
}

// Stable PD (Tan, Liu, Turk, IEEE CG&A 2011, doi:10.1109/MCG.2011.30), with the position at the end of the step
// predicted by the same semi-implicit Euler that Bullet takes: (M + dt D + dt^2 K) a = forces now. The explicit form
// is unstable at 240 Hz with the inertias of a real wrist.
void RobotControl::control_joint_impedance(const JointState& next) {
  update_dynamics();
  const JointMatrix& mass = arm_dynamics_.mass();
  const JointVector q = position(), v = velocity();
  const Eigen::Index joints = q.size();
  double strongest = 0;
  for (const JointLimits& limits : robot_.limits) strongest = std::max(strongest, effort_of(limits));
  JointVector stiffness(joints), damping(joints);
  for (Eigen::Index i = 0; i < joints; ++i) {
    const double share = effort_of(robot_.limits[static_cast<std::size_t>(i)]) / strongest;
    stiffness[i] = (controller.stiffness > 0 ? controller.stiffness : kJointStiffness) * share;
    damping[i] = 2 * std::sqrt(stiffness[i] * mass(i, i));
  }
  const JointVector feed_forward = mass * next.acceleration;
  const JointVector error = next.position - q - dt_ * v;
  JointVector pull = stiffness.cwiseProduct(error);
  for (Eigen::Index i = 0; i < joints; ++i) {
    const double most = std::max(kLeastTorque, kMostPull * arm_dynamics_.jacobian().col(i).head<3>().norm());
    if (std::abs(pull[i]) > most) acted_.note(Limit::contact);
    pull[i] = std::clamp(pull[i], -most, most) + damping[i] * (next.velocity[i] - v[i]);
  }
  JointMatrix implicit = mass;
  implicit.diagonal() += dt_ * damping + dt_ * dt_ * stiffness;
  const JointVector acceleration = implicit.ldlt().solve(feed_forward + pull);
  const JointVector softened =
      pull - dt_ * damping.cwiseProduct(acceleration) - dt_ * dt_ * stiffness.cwiseProduct(acceleration);
  give_torques(arm_dynamics_.gravity() + feed_forward + softened + held_back(acceleration));
}

// As above with the stiffness of the tip mapped to the joints through the Jacobian, and a soft posture spring
// towards the reference in its null space, so that the elbow neither drifts nor disturbs the tip.
void RobotControl::control_cartesian_impedance(const JointState& next) {
  update_dynamics();
  const JointMatrix& mass = arm_dynamics_.mass();
  const TipJacobian& jacobian = arm_dynamics_.jacobian();
  const JointVector q = position(), v = velocity();
  const Eigen::Index joints = q.size();
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Transform target = arm_.world_from_tip(next.position);
  const Vector6 target_velocity = arm_.jacobian(next.position) * next.velocity;
  const Vector6 tip_velocity = jacobian * v;
  Vector6 error;
  error << target.translation() - arm_dynamics_.world_from_tip().translation(),
      turn_between(arm_dynamics_.world_from_tip().linear(), target.linear());

  const double k = controller.stiffness > 0 ? controller.stiffness : kTipStiffness;
  Vector6 stiffness;
  stiffness << k, k, k, Vector3::Constant(k * kTurnOverTip);
  const JointMatrix mass_inverse = mass.ldlt().solve(JointMatrix(JointMatrix::Identity(joints, joints)));
  Matrix6 mobility = jacobian * mass_inverse * jacobian.transpose();
  mobility.diagonal().array() += 1e-6;
  const Matrix6 tip_mass = mobility.inverse();
  Vector6 damping;
  for (int i = 0; i < 6; ++i) damping[i] = 2 * std::sqrt(stiffness[i] * tip_mass(i, i));

  Matrix6 squared = jacobian * jacobian.transpose();
  squared.diagonal().array() += kSingularity;
  const JointMatrix projector =
      JointMatrix::Identity(joints, joints) - jacobian.transpose() * squared.inverse() * jacobian;
  JointVector posture_damping(joints);
  for (Eigen::Index i = 0; i < joints; ++i) posture_damping[i] = 2 * std::sqrt(kPostureStiffness * mass(i, i));

  Vector6 force = stiffness.cwiseProduct(error - dt_ * tip_velocity);
  if (const double pull = force.head<3>().norm(); pull > kMostPull) {
    force.head<3>() *= kMostPull / pull;
    acted_.note(Limit::contact);
  }
  force += damping.cwiseProduct(target_velocity - tip_velocity);
  const JointVector posture = kPostureStiffness * (projector * (next.position - q - dt_ * v)) +
                              posture_damping.cwiseProduct(projector * (next.velocity - v));
  const JointVector pull = jacobian.transpose() * force + projector * posture;
  const JointVector feed_forward = mass * next.acceleration;
  const Vector6 tip_resistance = dt_ * damping + dt_ * dt_ * stiffness;
  const JointVector posture_resistance = dt_ * posture_damping.array() + dt_ * dt_ * kPostureStiffness;
  const JointMatrix resistance = jacobian.transpose() * tip_resistance.asDiagonal() * jacobian +
                                 projector * posture_resistance.asDiagonal() * projector;
  const JointVector acceleration = JointMatrix(mass + resistance).ldlt().solve(feed_forward + pull);
  give_torques(arm_dynamics_.gravity() + feed_forward + pull - resistance * acceleration + held_back(acceleration));
}

// Fingers travel at the hand's speed, but a motor that asks a light finger for so little speed presses with a fraction
// of its force: the solver's iterations end first. A closing finger that stands still short of its target is asked for
// more, which its force limit then cuts off, and the solver starts from all of that; not for so much that it would jump
// by more than a millimetre or two where contact is lost for a step. An opening one is not: nobody grasps with it.
void RobotControl::control_hand() {
  const double each = finger_motors_.empty() ? 0 : hand.opening / static_cast<double>(finger_motors_.size());
  for (std::size_t f = 0; f < finger_motors_.size(); ++f) {
    const double limit = bodies_.part({kRobot, robot_.fingers[f]}).joint.effort;
    const double force = limit > 0 ? std::min(hand.force, limit) : hand.force;
    JointMotor& motor = *finger_motors_[f];
    const auto dof = static_cast<std::size_t>(motor.dof);
    const double lag = each - tree().position[dof];
    const double speed = tree().velocity[dof];
    const bool blocked = clock_.steps >= std::max(hand_step, clock_.boundary_step) + kStartSteps &&
                         lag < -kBlockedLag && std::abs(speed) < kBlockedSpeed * robot_.finger_speed;
    motor.position = each;
    motor.position_gain = blocked ? 0 : 1;
    motor.velocity = blocked ? -kPressSpeed : 0;
    motor.fastest = blocked ? kPressSpeed : robot_.finger_speed;
    motor.most_force = force;
    motor.presses = blocked;
  }
}

}  // namespace stampede
