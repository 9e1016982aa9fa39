// How an arm's reference follows what an agent asks for. Private to engine/sim.
#pragma once

#include <bitset>
#include <string>
#include <utility>
#include <vector>

#include "engine/sim/world.h"

namespace stampede {

// What kept an arm from doing what an agent asked for; named in World::limited.
enum class Limit {
  speed,         // of a joint
  acceleration,  // of a joint
  jerk,          // of a joint
  torque,        // of a joint
  tool_speed,    // of the tip
  reference,     // it waits for an arm that does not get on
  approach,      // something is ahead, and is met slowly
  contact,       // the arm presses no harder
};
constexpr int kLimits = 8;

class Limits {  // that acted
 public:
  void note(Limit limit) { acted_.set(static_cast<std::size_t>(limit)); }
  std::vector<std::string> names() const;

 private:
  std::bitset<kLimits> acted_;
};

// The reference waits for an arm that is held up: it slows down from half this distance on, and never gets further
// ahead than twice of it. Where the arm gives way, it takes more to have it press.
constexpr double kLead_rad = 0.05, kYieldingLead_rad = 0.1;

// What pushes the arm from outside must not take it over its stops: speeds and torques do not lead nearer than this.
constexpr double kMargin_rad = 0.05;

// What a reference must mind beside the limits of the joints.
struct Guard {
  double pace = 1;       // the share of the tool's speed that the arm's points may have
  JointVector position;  // of the arm itself; empty: it is on its reference
  double lead = kLead_rad;
};

bool leads(const operation::Servo& servo);  // to positions

// Whether no point of the arm is faster than this share of the speed that its tool may have.
bool as_slow_as(double pace, const Arm& arm, const JointState& now);

// Positions that come one after the other as an arm may move are a way: each is passed when the next is due, not
// stopped at: a passage at any speed, other positions no faster than the arm can stop soon after. Found anew with each
// position.
class Stream {
 public:
  // `seconds` after the position before.
  void follow(const JointVector& from, const JointVector& to, double seconds, const std::vector<JointLimits>& limits);
  void end() { *this = {}; }
  bool passes() const { return due_s_ > 0 && !passing_.isZero(); }
  double due_s() const { return due_s_; }  // after the position was given; 0: it is stopped at
  double passing(Eigen::Index joint) const { return passing_[joint]; }  // rad/s; 0: this joint stops there

 private:
  JointVector mean_, passing_;
  double due_s_ = 0;
};

// What a reference goes after: what an agent asked for so long ago, and the way that its positions are.
struct Aim {
  const operation::Servo& servo;
  const Stream& stream;
  double since_s = 0;
};

// Keeps what an agent asks for within the limits of an arm, and notes which of them acted. Lives for a step.
class Governor {
 public:
  Governor(const Arm& arm, double dt, Guard guard, Limits& acted)
      : arm_(arm), dt_(dt), guard_(std::move(guard)), acted_(acted) {}

  // The reference one physics step later. It goes towards a position, or takes on a velocity, as fast as the limits of
  // the tool's speed and of each joint's speed, acceleration and jerk allow, and never beyond its stops: near its goal,
  // and near a stop, it slows down by the square root of the way that is left, and in the end linearly (a filter of
  // third order, after Kroeger, Wahl 2010, doi:10.1109/TRO.2009.2035744). Not for torques. Repeatable.
  JointState guided(const JointState& now, const Aim& aim) const;

  // The acceleration closest to the one asked for that breaks no limit of speed and acceleration and can still stop
  // `margin` short of the stops. Shapes: one entry a joint. rad/s^2.
  JointVector safe_acceleration(const JointVector& asked, const JointVector& position, const JointVector& velocity,
                                double margin) const;

 private:
  const JointLimits& limits(Eigen::Index joint) const;
  double tool_speed(const JointVector& q, const JointVector& velocity) const;
  JointVector slowed(const JointVector& q, const JointVector& velocity, double pace) const;
  double speed_asked(const JointState& now, const Aim& aim, Eigen::Index joint) const;
  double ahead(const JointState& now, double wanted, Eigen::Index joint) const;
  JointVector speeds_wanted(const JointState& now, const Aim& aim) const;
  JointVector together(const JointState& now, const JointVector& wanted, double margin) const;
  double acceleration(const JointState& now, double velocity, Eigen::Index joint) const;

  const Arm& arm_;
  double dt_;
  Guard guard_;
  Limits& acted_;
};

// The speed at which a motor may take away an error of position, so that it can still stop there. rad, rad/s.
double catching_up(double error, double acceleration);
double acceleration_of(const JointLimits& limits);
double speed_of(const JointLimits& limits);

}  // namespace stampede
