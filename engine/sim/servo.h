// How an arm's reference follows what an agent asks for. Private to engine/sim.
#pragma once

#include <bitset>
#include <string>
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

// What a reference must mind beside the limits of the joints.
struct Guard {
  double pace = 1;       // the share of joint and tool speeds that it may use
  JointVector position;  // of the arm itself; empty: it is on its reference
};
// The reference waits for an arm that is held up: it slows down from half this distance on, and never gets further
// ahead than twice of it.
constexpr double kLead_rad = 0.05;

// Joint velocities whose tip is no faster than the robot's tool may be, by the pace: the same direction, slower.
JointVector slowed(const Arm& arm, const JointVector& q, JointVector velocity, double pace, Limits& acted);

// The reference one physics step later. It goes towards a position, or takes on a velocity, as fast as the limits of
// the tool's speed and of each joint's speed, acceleration and jerk allow, and never beyond its stops: near its goal,
// and near a stop, it slows down by the square root of the way that is left, and in the end linearly (a filter of third
// order, after Kroeger, Wahl 2010, doi:10.1109/TRO.2009.2035744). Not for torques. Repeatable.
JointState guided(const JointState& now, const operation::Servo& servo, const Arm& arm, double dt, const Guard& guard,
                  Limits& acted);

// The acceleration closest to the one asked for that breaks no limit of speed and acceleration and can still stop short
// of the stops. Shapes: one entry a joint. rad/s^2.
JointVector safe_acceleration(const JointVector& asked, const JointVector& position, const JointVector& velocity,
                              const Arm& arm, double dt, double pace, Limits& acted);

// The speed at which a motor may take away an error of position, so that it can still stop there. rad, rad/s.
double catching_up(double error, double acceleration);
double acceleration_of(const JointLimits& limits);
double speed_of(const JointLimits& limits);

}  // namespace stampede
