// Where the tool is to go.
#pragma once

#include <optional>
#include <string>

#include "engine/geometry/transform.h"

namespace stampede {

struct ToolTarget {
  std::string name;  // of the via-point; the last one is the goal
  Transform world_from_tip;
  bool ahead = false;  // after the goal: not travelled now, but the arm must be able to go on there in a straight line
};

struct GraspCandidate {
  Transform world_from_tip;       // at the grasp
  Transform world_from_approach;  // tip pose before, along the tip's -z
  Transform object_from_tip;
  double width = 0.04;    // expected opening at contact, m
  double opening = 0.08;  // to approach with, m
  double force = 20;      // N
  int index = 0;          // k of the stream
  // How far the part can be taken from here, where that was asked: its joint's position.
  std::optional<double> reach = {};
};

}  // namespace stampede
