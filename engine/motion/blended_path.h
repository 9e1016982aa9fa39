// A joint path whose corners are rounded, and its timing. Room-internal.
#pragma once

#include <functional>
#include <vector>

#include "engine/motion/planner.h"

namespace stampede {

// A joint path by a length parameter and its first two derivatives.
struct PathPoint {
  JointVector position, tangent, curvature;  // q, dq/ds, d2q/ds2
  double s = 0;                              // rad; a corner that is rounded counts as the lines that it replaces
};

// Straight lines joined by blends. From `blend` before a corner to `blend` after it the tangent turns from one
// direction u to the next v as u + w (v - u), w = 3 x^2 - 2 x^3: curvature is continuous, the blend leaves the
// corner by 0.19 blend |v - u| at most, and even a reversal is smooth.
// Units: rad. Shapes: blends has one entry per waypoint, the first and last unused; neighbours may use up a segment
// between them, not more.
class BlendedPath {
 public:
  BlendedPath(std::vector<JointVector> waypoints, const std::vector<double>& blends);
  double length() const { return starts_.back(); }
  const JointVector& start() const { return start_; }
  const JointVector& goal() const { return goal_; }
  PathPoint at(double s) const;
  // Parameters that resolve every piece, ascending from 0 to length().
  std::vector<double> grid() const;

 private:
  struct Piece {
    double length = 0;
    JointVector origin, from, to;  // start, and tangents at both ends
    bool blend = false;
  };
  void add(const Piece& piece);
  JointVector start_, goal_;
  std::vector<Piece> pieces_;
  std::vector<double> starts_{0};  // one more than pieces
};

// Waypoints without repetitions (closer than 1e-6 rad).
std::vector<JointVector> distinct(const std::vector<JointVector>& waypoints);

// The longest blends allowed at each waypoint, at most `most_rad`: half of the shorter neighbour segment.
std::vector<double> default_blends(const std::vector<JointVector>& waypoints, double most_rad);

// Further limits on the path speed ds/dt at a point (tool speed); infinity: none.
using PathSpeedLimit = std::function<double(const PathPoint&)>;

// The path speed at which the tip keeps MotionLimits::tool_speed. Lifetime: borrows the arm.
PathSpeedLimit tool_limit(const Arm& arm, const MotionLimits& limits);

// Passes the path as fast as the limits' shares allow: forward and backward sweeps over the path speed (Kunz,
// Stilman, RSS 2012, doi:10.15607/RSS.2012.VIII.027; Pham, Pham, T-RO 2018, doi:10.1109/TRO.2018.2819195), then the
// speed is averaged over a window, which bounds the jerk. The result is tested on dense samples and slowed down
// where, and as long as, a limit is passed. Result: at rest at both ends.
Trajectory time_blended(const BlendedPath& path, const std::vector<JointLimits>& joint_limits,
                        const MotionLimits& limits, int physics_hz, const PathSpeedLimit& speed_limit = {});

// Greatest share of the velocity, acceleration (its root) and jerk limits (its cube root) that a trajectory uses at
// samples half a step apart: slowing it down by this factor makes it exactly valid.
double limit_usage(const Trajectory& trajectory, const std::vector<JointLimits>& joint_limits,
                   const MotionLimits& limits, int physics_hz);

constexpr double kLongestBlend = 0.25;  // rad

}  // namespace stampede
