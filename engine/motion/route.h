// Steps shared by the planners. Room-internal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/motion/blended_path.h"
#include "engine/motion/planner.h"

namespace stampede {

// A path that keeps the padding, checked coarsely only. `care` 0, 1, 2: at ever denser spacing.
JointPath search_path(const MotionProblem& problem, const JointVector& goal, int care);
constexpr int kMostCare = 2;

// Nothing wrong with both ends: reason none.
JointPath check_ends(const CollisionState& state, const JointVector& start, const JointVector& goal);

// A motion that `plan` makes from where an arm that starts folded into itself has first been turned clear; from the
// start where it need not be, or cannot.
PlannedMotion plan_after_way_out(const MotionProblem& problem,
                                 const std::function<PlannedMotion(const MotionProblem& from)>& plan);

// A way of the tip, at a share 0 … 1 of it, and at how many samples it is followed. `near`: as of LineOptions.
struct TipWay {
  std::function<Transform(double)> world_from_tip;
  int samples = 1;
  std::vector<JointVector> near = {};
};

// Configurations from `start` (left out of the result) along a way of the tip.
struct ToolPath {
  Reason reason = Reason::none;
  std::string detail;
  std::vector<JointVector> waypoints;
};
ToolPath follow_tool(const Arm& arm, const JointVector& start, const TipWay& way, RandomKey key);

// What counts on a way of the tool: everything, or of one whose hand may meet things the arm alone.
CollisionState space_of_line(const CollisionState& state, bool keep_clear);
// Where the polyline, sampled at most `step_rad` apart, touches something, but for where an arm that touches already
// comes away.
std::optional<JointVector> first_touch_of_line(const CollisionState& space, const std::vector<JointVector>& waypoints,
                                               double step_rad);

// The path speed at a point at which the tool goes no faster than `speed` (m/s) and turns no faster than `turn_speed`
// (rad/s).
double tool_limit(const Arm& arm, const PathPoint& point, double speed, double turn_speed);

// How many samples the straight way between two poses of the tip needs.
int samples_between(const Transform& from, const Transform& to);

// Leaves out waypoints from which the polyline differs by less than `tolerance_rad` (Douglas, Peucker 1973,
// doi:10.3138/FM57-6770-U75U-7727).
std::vector<JointVector> decimate(const std::vector<JointVector>& waypoints, double tolerance_rad);

// Spacing of the samples that certify: a quarter of the resolution that is promised, because no padding bridges the
// gaps between samples where links graze each other.
double certified_step(const MotionLimits& limits);

// What a path keeps clear of obstacles when it is certified: contact between two samples is then unlikely too.
// The last, most careful search is content without.
double clearance_m(const MotionLimits& limits, int care);

// Rounds, times and certifies (`clearance_m` below 0: does not). Blends that touch something shrink.
// `way_in`: until it passes the waypoint `to`, its state counts instead. Result: no_path when the polyline itself does.
struct WayIn {
  const CollisionState& state;
  const JointVector& to;
};
PlannedMotion certify(const CollisionState& state, const std::vector<JointVector>& waypoints,
                      const MotionLimits& limits, double clearance_m, const PathSpeedLimit& speed_limit = {},
                      const WayIn* way_in = nullptr);

// Step at which the trajectory passes nearest to a configuration.
std::int64_t nearest_step(const Trajectory& trajectory, const JointVector& q, int physics_hz);

}  // namespace stampede
