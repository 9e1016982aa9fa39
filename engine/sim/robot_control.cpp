#include "engine/sim/robot_control.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace stampede {
namespace {

constexpr double kFingerErp = 0.2;
constexpr double kGearErp = 0.04, kGearForce = 50;  // N
constexpr double kAskew = 3e-4;                     // m between two coupled fingers
constexpr double kOverStop_rad = 1e-3;

}  // namespace

RobotControl::RobotControl(const Bodies& bodies, const ContactWindow& contacts, Movers& movers, const StepClock& clock)
    : bodies_(bodies),
      contacts_(contacts),
      movers_(movers),
      clock_(clock),
      robot_(bodies.scene().robot),
      dt_(clock.dt),
      arm_(robot_) {}

void RobotControl::build() {
  const auto motor_of = [&](int part_index) {
    const PartSlot& driven = bodies_.slot({kRobot, part_index});
    if (driven.dof < 0)
      throw Error(robot_.name, "part '" + bodies_.part({kRobot, part_index}).name + "' has no joint to drive",
                  "name moving links");
    return &movers_.add_motor(tree(), driven.dof);
  };
  const auto joints = static_cast<Eigen::Index>(robot_.arm.size());
  JointVector start(joints);
  for (std::size_t j = 0; j < robot_.arm.size(); ++j) {
    start[static_cast<Eigen::Index>(j)] = bodies_.part({kRobot, robot_.arm[j]}).joint.initial;
    arm_motors_.push_back(motor_of(robot_.arm[j]));
  }
  for (const int finger : robot_.fingers) {
    finger_motors_.push_back(motor_of(finger));
    finger_motors_.back()->erp = kFingerErp;
  }
  if (robot_.fingers.size() == 2) {
    // Two force-limited motors alone let the pair wander along the closing axis: the gear couples them.
    movers_.add_gear(tree(), {finger_motors_[0]->dof, finger_motors_[1]->dof, kGearErp, kGearForce, 1, 0});
  }
  hand.opening = 0;
  for (const int finger : robot_.fingers) hand.opening += bodies_.part({kRobot, finger}).joint.initial;
  hand.force = robot_.grip_force;
  reference.setpoint = {start, JointVector::Zero(joints), JointVector::Zero(joints)};
  reference_now = reference.setpoint;
  arm_torque = JointVector::Zero(joints);
  arm_dynamics_ = ArmDynamics(robot_);
}

JointVector RobotControl::position() const {
  JointVector q(static_cast<Eigen::Index>(arm_motors_.size()));
  for (std::size_t j = 0; j < arm_motors_.size(); ++j)
    q[static_cast<Eigen::Index>(j)] = tree().position[static_cast<std::size_t>(arm_motors_[j]->dof)];
  return q;
}

JointVector RobotControl::velocity() const {
  JointVector v(static_cast<Eigen::Index>(arm_motors_.size()));
  for (std::size_t j = 0; j < arm_motors_.size(); ++j)
    v[static_cast<Eigen::Index>(j)] = tree().velocity[static_cast<std::size_t>(arm_motors_[j]->dof)];
  return v;
}

JointState RobotControl::reference_at(std::int64_t step) const {
  if (!reference.trajectory) return reference.setpoint;
  return evaluate(*reference.trajectory, static_cast<double>(step - reference.start_step), bodies_.scene().physics_hz);
}

void RobotControl::serve(const operation::Servo& servo) {
  using Of = operation::Servo::Of;
  const bool led = reference.servo && leads(*reference.servo);
  operation::Servo next = servo;
  // Rest, while a way is followed: the arm cannot stop at once, but comes back to where it was sent last.
  if (led && reference.stream.passes() && servo.of == Of::velocity && servo.value.isZero()) next = *reference.servo;
  Stream stream = reference.stream;
  if (led && leads(next))
    stream.follow(reference.servo->value, next.value, dt_ * static_cast<double>(clock_.steps - reference.start_step),
                  robot_.limits);
  else
    stream.end();
  reference = {nullptr, clock_.steps, reference_now, next, stream};
}

JointState RobotControl::served(const JointState& now, std::int64_t step, const Guard& guard, Limits& noted) const {
  const double since = dt_ * static_cast<double>(step - reference.start_step);
  return Governor(arm_, dt_, guard, noted).guided(now, {*reference.servo, reference.stream, since});
}

void RobotControl::after_step() {
  if (under_torque()) reference_now = {position(), velocity(), JointVector::Zero(arm_.joints())};
}

void RobotControl::keep_within_stops() {
  Articulation& robot = tree();
  bool moved = false;
  for (std::size_t j = 0; j < arm_motors_.size(); ++j) {
    const JointLimits& limits = robot_.limits[j];
    const auto dof = static_cast<std::size_t>(arm_motors_[j]->dof);
    const double q = robot.position[dof];
    if (!(limits.lower < limits.upper) || (q >= limits.lower - kOverStop_rad && q <= limits.upper + kOverStop_rad))
      continue;
    robot.position[dof] = std::clamp(q, limits.lower, limits.upper);
    robot.velocity[dof] = 0;
    moved = true;
  }
  if (moved) robot.place();
}

void RobotControl::read_efforts(std::vector<double>& efforts) const {
  for (std::size_t j = 0; j < arm_motors_.size(); ++j)
    efforts[static_cast<std::size_t>(robot_.arm[j])] = arm_motors_[j]->force + arm_torque[static_cast<Eigen::Index>(j)];
  for (std::size_t f = 0; f < finger_motors_.size(); ++f)
    efforts[static_cast<std::size_t>(robot_.fingers[f])] = finger_motors_[f]->force;
}

std::optional<PartRef> RobotControl::carried() const {
  const std::optional<PartRef> held = grasped();
  return held && bodies_.body(held->body).free ? held : std::nullopt;
}

bool RobotControl::strained() const {
  const std::vector<int>& fingers = robot_.fingers;
  const bool askew = fingers.size() == 2 &&
                     std::abs(bodies_.position({kRobot, fingers[0]}) - bodies_.position({kRobot, fingers[1]})) > kAskew;
  const std::optional<PartRef> held = grasped();
  const bool bonded = held && held->body >= 0 && bodies_.joined({held->body, 0});
  return askew || bonded || std::any_of(fingers.begin(), fingers.end(), [&](int finger) {
           return bodies_.strains({kRobot, finger});
         });
}

}  // namespace stampede
