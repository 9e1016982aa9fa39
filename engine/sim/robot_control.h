// The robot's controllers: what was asked of arm and hand, and the motors that carry it out, once a step. Private to
// engine/sim.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/sim/arm_dynamics.h"
#include "engine/sim/bodies.h"
#include "engine/sim/contacts.h"
#include "engine/sim/servo.h"

namespace stampede {

struct StepClock {
  double dt = 1.0 / 240;
  std::int64_t steps = 0;
  std::int64_t boundary_step = 0;  // of the last boundary: contact points have to be found again after it
};

// The arm's reference: a trajectory since the step at which it was given, what a servo makes of it, or a set-point.
struct Reference {
  std::shared_ptr<const Trajectory> trajectory;
  std::int64_t start_step = 0;
  JointState setpoint;
  std::optional<operation::Servo> servo = {};
  Stream stream = {};  // of a servo's positions
  double pace = 1;     // of a servo: the share of its speeds that what lies ahead allows
};

// All of it is part of a snapshot.
struct ControlState {
  operation::Controller controller;
  operation::Hand hand;
  std::int64_t hand_step = 0;  // when it was given
  Reference reference;
  JointState reference_now;  // of this step
  JointVector arm_torque;    // given by the controller in the last step
  JointVector foreseen;      // velocity after the last step, had the arm met nothing; may be empty
};

class RobotControl : public ControlState {
 public:
  RobotControl(const Bodies& bodies, const ContactWindow& contacts, Movers& movers, const StepClock& clock);
  void build();  // its motors, once there are bodies

  void serve(const operation::Servo& servo);
  void step();  // drives the motors; then all moves
  // A crash at full speed takes an arm's joint by a hundredth of a radian over its stop before its limit begins to act.
  // The stop is rigid: it is put back, at rest.
  void keep_within_stops();
  void after_step();
  void read_efforts(std::vector<double>& efforts) const;  // of the robot's parts, in the last step
  bool strained() const;  // a finger is pressed against a stop or askew, or the hand holds what is joined to something

  const Bodies& bodies() const { return bodies_; }
  const ContactWindow& contacts() const { return contacts_; }
  const StepClock& clock() const { return clock_; }
  const Arm& arm() const { return arm_; }
  Limits& acted() { return acted_; }  // since they were last forgotten
  JointVector position() const;
  JointVector velocity() const;
  JointState reference_at(std::int64_t step) const;
  // What the servo makes of a reference in the step from `step` on.
  JointState served(const JointState& now, std::int64_t step, const Guard& guard, Limits& noted) const;
  bool under_torque() const { return reference.servo && reference.servo->of == operation::Servo::Of::torque; }
  // Of a point of a link, or of what is held, where the joints change by so little.
  Vector3 motion_of(PartRef link, const Vector3& point, const JointVector& change) const;
  std::optional<PartRef> grasped() const { return contacts_.grasped(robot_.pads); }
  std::optional<PartRef> carried() const;  // what is grasped, where it is free

 private:
  Articulation& tree() const { return *bodies_.body_slot(kRobot).tree; }
  void look_ahead();  // approach.cpp
  void control_torque(const JointVector& asked);
  void control_position(const JointState& now, const JointState& next);
  void keep_tool_slow(const TipJacobian& jacobian);
  void control_joint_impedance(const JointState& next);
  void control_cartesian_impedance(const JointState& next);
  void give_torques(JointVector torque);
  JointVector kept_safe(const JointVector& acceleration, double margin);
  std::vector<SpeedBrake> speed_brakes() const;
  JointVector held_back(const JointVector& acceleration);
  double load_mass() const;
  Vector3 lever(std::size_t joint, const Vector3& point) const;
  bool moves(std::size_t joint, PartRef link) const;
  std::vector<double> contact_levers() const;
  void update_dynamics();
  void control_hand();

  const Bodies& bodies_;
  const ContactWindow& contacts_;
  Movers& movers_;
  const StepClock& clock_;
  const Robot& robot_;
  const double dt_;
  Arm arm_;
  std::vector<JointMotor*> arm_motors_, finger_motors_;  // their dofs are those of the joints
  ArmDynamics arm_dynamics_;
  Limits acted_;
};

}  // namespace stampede
