// Is a configuration, an edge, a trajectory free of contact? Room-internal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/sim/collision_space.h"

namespace stampede {

// Greatest difference of any joint, rad.
double joint_gap(const JointVector& a, const JointVector& b);

// Asks a CollisionSpace with obstacles grown by a padding. An end that is free only without padding (a hand beside
// the thing it just let go) excuses its neighbourhood: there the padding is not asked for.
// Lifetime: borrows the space; leaves its padding at 0.
class Checker {
 public:
  Checker(CollisionSpace& space, double padding_m, const std::vector<JointVector>& ends);
  ~Checker();
  Checker(const Checker&) = delete;
  Checker& operator=(const Checker&) = delete;

  bool free(const JointVector& q);
  std::string contact(const JointVector& q);  // what describe_contact says, padding included
  // a is known to be free; checks up to b at most `step_rad` apart, coarse before fine: contacts are found early.
  bool edge_free(const JointVector& a, const JointVector& b, double step_rad);

 private:
  void pad(double padding_m);
  void pad_for(const JointVector& q);
  CollisionSpace& space_;
  double padding_m_;
  double applied_m_ = 0;
  std::vector<JointVector> excused_;
};

// First configuration of the polyline, sampled at most `step_rad` apart, that touches something.
std::optional<JointVector> first_touch(Checker& checker, const std::vector<JointVector>& waypoints, double step_rad);
// The same along a trajectory.
std::optional<JointVector> first_touch(Checker& checker, const Trajectory& trajectory, int physics_hz, double step_rad);

// `hand.left_finger touches table`: what touches what there, for people. Empty: nothing.
std::string describe_contact(CollisionSpace& space, const JointVector& q);

}  // namespace stampede
