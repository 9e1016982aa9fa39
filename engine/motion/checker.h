// Is a configuration, an edge, a trajectory free of contact? Room-internal.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/model/trajectory.h"
#include "engine/sim/configuration_checker.h"

namespace stampede {

// Greatest difference of any joint, rad.
double joint_gap(const JointVector& a, const JointVector& b);

// Asks a CollisionState with obstacles grown by a padding. An end that is free only without padding (a hand beside
// the thing it just let go) excuses its neighbourhood: there the padding is not asked for.
// Lifetime: borrows the state, which must not change meanwhile. Holds working memory: for one thread.
class Checker {
 public:
  Checker(const CollisionState& state, double padding_m, const std::vector<JointVector>& ends);

  bool free(const JointVector& q) const;
  std::string contact(const JointVector& q) const;  // what describe_contact says, padding included
  // Index of the first configuration that touches something; configurations.size() when none does.
  std::size_t first_touching(std::span<const JointVector> configurations);
  // a is known to be free; checks up to b at most `step_rad` apart, all along at once: contacts are found early.
  bool edge_free(const JointVector& a, const JointVector& b, double step_rad);

 private:
  double padding_at(const JointVector& q) const;
  const CollisionState& state_;
  double padding_m_;
  std::vector<JointVector> excused_;
  ConfigurationChecker many_;
  std::vector<double> paddings_;  // of the configurations asked about
};

// First configuration of the polyline, sampled at most `step_rad` apart, that touches something.
std::optional<JointVector> first_touch(Checker& checker, const std::vector<JointVector>& waypoints, double step_rad);
// The same along a trajectory, from step `from` to step `to`.
std::optional<JointVector> first_touch(Checker& checker, const Trajectory& trajectory, std::int64_t from,
                                       std::int64_t to, int physics_hz, double step_rad);

// `hand.left_finger touches table`: what touches what there, for people. Empty: nothing.
std::string describe_contact(const CollisionState& state, const JointVector& q);

}  // namespace stampede
