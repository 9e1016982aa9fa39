// From tool targets to timed joint paths: collision-free, blended, within the robot's limits.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/random.h"
#include "engine/base/reason.h"
#include "engine/motion/motion.h"
#include "engine/motion/part_way.h"
#include "engine/motion/targets.h"
#include "engine/sim/collision_state.h"

namespace stampede {

struct MotionLimits {
  double speed = 1.0;            // share of the joint velocity limits, (0, 1]
  double acceleration = 0.5;     // share of the joint acceleration limits; jerk limits always hold in full
  double resolution_rad = 0.01;  // spacing that is promised; certification samples four times as densely
  int iterations = 40000;        // tree extensions before no_path: half of them with padding, half with less
  int rounds = 5;                // of shortening, at most
  double tool_speed = 1.65;      // m/s of the tip, a little less than the 1.7 of a Panda: smoothing adds some
  double padding_m = 0.005;      // obstacles grow by this while planning; certification is without
  std::string planner = {};      // of joint paths: empty, our own; else one of motion_planner_names()
};

// `ompl:BITstar` …, sorted: planners of joint paths beside our own.
std::vector<std::string> motion_planner_names();
// Throws Error at `place` for another name, with the nearest; for planners of OMPL that are not offered, why.
void check_motion_planner(const std::string& name, const std::string& place);

// What every motion is planned for: from where, among what, how fast, and with which draws.
// Lifetime: refers to the state.
struct MotionProblem {
  const CollisionState& state;
  JointVector start;
  MotionLimits limits;
  RandomKey key;

  MotionProblem from(const JointVector& there) const { return {state, there, limits, key}; }
};

struct PlannedMotion {
  Reason reason = Reason::none;  // none: trajectory is valid
  std::string detail;            // for people: what touches what, which target has no IK solution
  Trajectory trajectory;
  std::vector<PlannedVia> vias;
  std::vector<PlannedHand> hands;
};

// Joint path between two configurations: our own RRT-Connect (Kuffner, LaValle, ICRA 2000,
// doi:10.1109/ROBOT.2000.844730) on OMPL's base classes, seeded by the problem's key, then shortened, and certified.
// Shapes: waypoints, first = start, last = goal. Result: empty with a reason. Repeatable: a pure function of its
// arguments, whatever ran before or runs beside it.
struct JointPath {
  Reason reason = Reason::none;
  std::string detail;
  std::vector<JointVector> waypoints;
};
JointPath plan_path(const MotionProblem& problem, const JointVector& goal);

// Times a joint path: corners are rounded (blends stay within the certified tube or shrink), the path is passed at
// the highest speed that respects velocity, acceleration and jerk limits.
Trajectory time_path(const Arm& arm, const std::vector<JointVector>& waypoints, const MotionLimits& limits,
                     int physics_hz);

struct ToolPiece;

// What the arm must be able to do from the last target on.
struct ThenDo {
  const PartWay* part = nullptr;                   // to go with this part, the hand `part->opening` wide
  const std::vector<ToolPiece>* pieces = nullptr;  // to travel these
};

// A planned motion through all targets, stopping only at the last. Free motion up to the first target; between
// targets straight tool lines (an approach to a grasp is a straight line). IK solutions are tried nearest first.
// Lines ahead are to be free too, but for what an empty hand has taken by then, and for the part that a fist pushes.
PlannedMotion plan_through(const MotionProblem& problem, const std::vector<ToolTarget>& targets,
                           const ThenDo& then = {});

constexpr double kShut_m = 0.005;         // a hand that is no wider grasps nothing: it pushes
constexpr double kRoomToLetGo_m = 0.007;  // a hand that fits where it is with so much more surely lets go

// How far the hand may open where it is, up to `wanted_m`, before a finger meets what it does not touch yet; where it
// `lets_go`, a little at least, or nothing would fall. `state`: nothing held, what is to be let go allowed. Units: m.
// Repeatable.
double widest_opening(const CollisionState& state, const JointVector& q, double wanted_m, bool lets_go = true);

// A planned free motion to joint positions.
PlannedMotion plan_joints(const MotionProblem& problem, const JointVector& goal);

// The tip follows world_from_tip(s), s in [0, 1], by IK at dense samples with joint continuity (no sample more than
// 0.3 rad from the last). `keep_clear`: refused where it touches what the state does not allow. Speed limits of the
// tool, m/s and rad/s, hold as well.
struct LineOptions {
  double tool_speed = 0.25;  // m/s
  double tool_turn = 1.0;    // rad/s
  bool keep_clear = false;
  // Where the arm cannot follow to the end it goes as far as it can, at least this share of the way; 1: to the end.
  double least_share = 1;
  int samples = 0;                     // 0: one each 5 mm or 0.02 rad
  std::vector<JointVector> near = {};  // at equal shares, whence its configurations are sought; empty: the one before
};
// Puts what goes with the hand where it is at a share of the path.
using GoesAlong = std::function<void(CollisionState& space, double share)>;
PlannedMotion plan_tool_path(const MotionProblem& problem, const std::function<Transform(double)>& world_from_tip,
                             const LineOptions& line, const GoesAlong& goes_along = {});
// Straight line with slerp from where the tip is.
PlannedMotion plan_line(const MotionProblem& problem, const Transform& world_from_tip, const LineOptions& line);

}  // namespace stampede
