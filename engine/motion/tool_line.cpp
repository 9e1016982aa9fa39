// Lines and paths of the tool, on which the arm keeps clear of itself and of what stands about, whatever the hand is to
// meet.
#include "engine/motion/tool_line.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"
#include "engine/motion/checker.h"
#include "engine/motion/route.h"
#include "engine/sim/overlap.h"

namespace stampede {
namespace {

constexpr double kToolError = 3e-4;   // rad, of decimated tool paths
constexpr int kOtherEnds = 12;        // configurations at the end, towards which the arm is turned where a way touches
constexpr double kFarthestEnd = 1.6;  // rad of any joint from where the arm is

// The path speed at which the tool keeps its own limits.
PathSpeedLimit line_limit(const Arm& arm, const LineOptions& line) {
  return [&arm, line](const PathPoint& point) { return tool_limit(arm, point, line.tool_speed, line.tool_turn); };
}

// Configurations along a path of the tool: from where the arm is to the path's begin, and on.
struct Way {
  std::vector<JointVector> waypoints;  // the first: the start
  std::vector<double> shares;          // of the path, of each
};

Way way_along(const JointVector& start, const JointVector& from, const ToolPath& path, int samples) {
  Way way{{start}, {0}};
  if (joint_gap(from, start) > 1e-4) way.waypoints.push_back(from), way.shares.push_back(0);
  for (std::size_t i = 0; i < path.waypoints.size(); ++i) {
    way.waypoints.push_back(path.waypoints[i]);
    way.shares.push_back(static_cast<double>(i + 1) / samples);
  }
  return way;
}

// What a way of the tool is asked: where does it touch what it must not?
class Guard {
 public:
  Guard(const CollisionState& state, const LineOptions& line, const GoesAlong& goes_along, const MotionLimits& limits)
      : space_(space_of_line(state, line.keep_clear)), moved_(goes_along), step_(certified_step(limits)) {}

  const CollisionState& space() const { return space_; }
  bool part_moves() const { return moved_ != nullptr; }

  // Index of the first waypoint on the way to which, or at which, something is touched; their number: nowhere.
  std::size_t first_touching(const Way& way, std::string& contact) const {
    if (part_moves()) return first_with_part(way, contact);
    const std::optional<JointVector> touch = first_touch_of_line(space_, way.waypoints, step_);
    if (!touch) return way.waypoints.size();
    contact = describe_contact(space_, *touch);
    for (std::size_t i = 1; i < way.waypoints.size(); ++i)
      if (first_touch_of_line(space_, {way.waypoints[i - 1], way.waypoints[i]}, step_)) return i;
    return way.waypoints.size() - 1;
  }

 private:
  // What moves with the hand is where it is by then.
  std::size_t first_with_part(const Way& way, std::string& contact) const {
    for (std::size_t i = 1; i < way.waypoints.size(); ++i)
      for (const double between : {0.5, 1.0}) {
        CollisionState there = space_;
        moved_(there, way.shares[i - 1] + between * (way.shares[i] - way.shares[i - 1]));
        const JointVector q = way.waypoints[i - 1] + between * (way.waypoints[i] - way.waypoints[i - 1]);
        if (there.free(q)) continue;
        contact = describe_contact(there, q);
        return i;
      }
    return way.waypoints.size();
  }

  CollisionState space_;
  GoesAlong moved_;
  double step_;
};

PlannedMotion failed(Reason reason, std::string detail) {
  PlannedMotion motion;
  motion.reason = reason;
  motion.detail = std::move(detail);
  return motion;
}

PlannedMotion timed(const Guard& guard, const Way& way, const LineOptions& line, const MotionLimits& limits) {
  const bool asked = !guard.part_moves() && guard.space().free(way.waypoints.front());
  return certify(guard.space(), decimate(way.waypoints, kToolError), limits, asked ? 0.0 : -1.0,
                 line_limit(guard.space().arm(), line));
}

// The same path of the tool, the arm turned on the way towards another configuration at its end: an elbow has a choice.
std::optional<PlannedMotion> plan_other_way(const Guard& guard, const JointVector& start, const JointVector& from,
                                            const std::function<Transform(double)>& world_from_tip, int samples,
                                            const LineOptions& line, const MotionLimits& limits, RandomKey key) {
  const Arm& arm = guard.space().arm();
  for (const JointVector& end : arm.solutions(world_from_tip(1), from, key.with("ends"), kOtherEnds)) {
    if (joint_gap(end, from) > kFarthestEnd) continue;
    const ToolPath path = follow_tool(arm, from, world_from_tip, samples, key.with("path"), {from, end});
    if (path.reason != Reason::none) continue;
    const Way way = way_along(start, from, path, samples);
    std::string contact;
    if (guard.first_touching(way, contact) < way.waypoints.size()) continue;
    PlannedMotion motion = timed(guard, way, line, limits);
    if (motion.reason == Reason::none) return motion;
  }
  return std::nullopt;
}

int samples_along(const std::function<Transform(double)>& world_from_tip) {
  constexpr int kChords = 32;  // the path may bend: its length is measured along a few chords
  int samples = 0;
  for (int i = 0; i < kChords; ++i) {
    const Transform from = world_from_tip(static_cast<double>(i) / kChords);
    samples += samples_between(from, world_from_tip(static_cast<double>(i + 1) / kChords));
  }
  return samples;
}

}  // namespace

CollisionState space_of_line(const CollisionState& state, bool keep_clear) {
  CollisionState space = state;
  if (!keep_clear) count_arm_alone(space);
  return space;
}

// A start that touches already, where contact has brought the arm, is left: never deeper, and free from then on.
std::optional<JointVector> first_touch_of_line(const CollisionState& space, const std::vector<JointVector>& waypoints,
                                               double step_rad) {
  constexpr double kDeeper = 0.0005, kGrazing = 0.001;  // m
  std::size_t begin = 0;
  if (!space.free(waypoints.front())) {
    const std::optional<Overlap> first = deepest_overlap(space, waypoints.front());
    for (; begin < waypoints.size() && !space.free(waypoints[begin]); ++begin)
      if (const auto here = deepest_overlap(space, waypoints[begin]); here && here->depth > first->depth + kDeeper)
        return waypoints[begin];
    if (begin == waypoints.size()) return first->depth < kGrazing ? std::nullopt : std::optional(waypoints.front());
  }
  Checker checker(space, 0, {});
  return first_touch(checker, {waypoints.begin() + static_cast<long>(begin), waypoints.end()}, step_rad);
}

PlannedMotion plan_tool_path(const CollisionState& state, const JointVector& start,
                             const std::function<Transform(double)>& world_from_tip, const LineOptions& line,
                             const MotionLimits& limits, RandomKey key) {
  return plan_tool_path_with(state, start, world_from_tip, line, {}, limits, key);
}

PlannedMotion plan_tool_path_with(const CollisionState& state, const JointVector& start,
                                  const std::function<Transform(double)>& world_from_tip, const LineOptions& line,
                                  const GoesAlong& goes_along, const MotionLimits& limits, RandomKey key) {
  if (!(line.tool_speed > 0) || !(line.tool_turn > 0))
    throw Error("motion planning", "the tool's speed limits must be positive");
  const int samples = line.samples > 0 ? line.samples : samples_along(world_from_tip);
  const Guard guard(state, line, goes_along, limits);
  if (line.keep_clear)
    if (const std::string contact = describe_contact(state, start); !contact.empty())
      return failed(Reason::start_in_collision, "at the start " + contact);
  // Where the tip is may differ a little from the path's start.
  const ToolPath first = follow_tool(
      state.arm(), start, [&](double) { return world_from_tip(0); }, 1, key.with("first"));
  if (first.reason != Reason::none) return failed(first.reason, "the path's start is out of reach");
  const JointVector from = first.waypoints.back();
  ToolPath path = follow_tool(state.arm(), from, world_from_tip, samples, key.with("path"), line.near);
  const auto enough = [&](std::size_t count) {
    return count > 0 && static_cast<double>(count) >= line.least_share * samples;
  };
  if (path.reason != Reason::none && !enough(path.waypoints.size())) return failed(path.reason, path.detail);
  Way way = way_along(start, from, path, samples);
  std::string contact;
  const std::size_t touching = guard.first_touching(way, contact);
  if (touching == way.waypoints.size()) {
    PlannedMotion motion = timed(guard, way, line, limits);
    if (motion.reason == Reason::none) return motion;
    contact = motion.detail;
  }
  if (auto motion = plan_other_way(guard, start, from, world_from_tip, samples, line, limits, key.with("other")))
    return *std::move(motion);
  const std::size_t before = way.waypoints.size() - path.waypoints.size();  // that are not of the path
  if (line.least_share < 1 && touching > before && enough(touching - before)) {
    way.waypoints.resize(touching);
    way.shares.resize(touching);
    PlannedMotion motion = timed(guard, way, line, limits);
    if (motion.reason == Reason::none) return motion;
  }
  return failed(Reason::no_path, "on its way " + contact);
}

PlannedMotion plan_line(const CollisionState& state, const JointVector& start, const Transform& world_from_tip,
                        const LineOptions& line, const MotionLimits& limits, RandomKey key) {
  if (!world_from_tip.matrix().allFinite()) throw Error("motion planning", "a tool target must be finite");
  const Transform from = state.arm().world_from_tip(start);
  LineOptions options = line;
  if (options.samples <= 0) options.samples = samples_between(from, world_from_tip);
  return plan_tool_path(
      state, start, [&](double s) { return between(from, world_from_tip, s); }, options, limits, key);
}

}  // namespace stampede
