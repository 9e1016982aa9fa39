// Random trees between two configurations. Room-internal; rrt.cpp alone knows OMPL.
#pragma once

#include <vector>

#include "engine/base/random.h"
#include "engine/motion/checker.h"

namespace stampede {

struct TreeOptions {
  double range_rad = 0.7;  // greatest length of an extension (Euclidean over the joints)
  double step_rad = 0.05;  // spacing of the checks along an extension
  int iterations = 4000;   // samples drawn
  int rounds = 5;          // of shortening, at most
};

// A path looked for between two configurations, within the joint limits.
struct PathQuery {
  Checker& checker;
  const std::vector<JointLimits>& limits;
  const JointVector &start, &goal;
};

// RRT-Connect (Kuffner, LaValle, ICRA 2000, doi:10.1109/ROBOT.2000.844730); the smaller tree grows.
// Result: waypoints from start to goal, empty when the iterations are used up.
// Repeatable: a pure function of its arguments.
std::vector<JointVector> grow_trees(const PathQuery& query, const TreeOptions& options, RandomKey key);

// Shortens a path: leaves out corners that are not needed, then pulls those left straight, in turns (after Geraerts,
// Overmars, IJRR 2007, doi:10.1177/0278364907079280).
std::vector<JointVector> shorten(Checker& checker, std::vector<JointVector> path, const TreeOptions& options);

}  // namespace stampede
