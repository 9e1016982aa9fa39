// Lines and paths of the tool, on which the arm keeps clear of itself and of what stands about, whatever the hand is to
// meet.
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

// What a way of the tool is asked: where does it touch what it must not, and how fast can it be travelled?
class Guard {
 public:
  Guard(const MotionProblem& problem, const LineOptions& line, const GoesAlong& goes_along)
      : problem_(problem),
        line_(line),
        space_(space_of_line(problem.state, line.keep_clear)),
        moved_(goes_along),
        step_(certified_step(problem.limits)) {}

  const MotionProblem& problem() const { return problem_; }

  // Index of the first waypoint on the way to which, or at which, something is touched; their number: nowhere.
  std::size_t first_touching(const Way& way, std::string& contact) const {
    if (moved_) return first_with_part(way, contact);
    const std::optional<JointVector> touch = first_touch_of_line(space_, way.waypoints, step_);
    if (!touch) return way.waypoints.size();
    contact = describe_contact(space_, *touch);
    for (std::size_t i = 1; i < way.waypoints.size(); ++i)
      if (first_touch_of_line(space_, {way.waypoints[i - 1], way.waypoints[i]}, step_)) return i;
    return way.waypoints.size() - 1;
  }

  PlannedMotion timed(const Way& way) const {
    const bool asked = !moved_ && space_.free(way.waypoints.front());
    return certify(
        space_, decimate(way.waypoints, kToolError), problem_.limits, asked ? 0.0 : -1.0,
        [this](const PathPoint& point) { return tool_limit(space_.arm(), point, line_.tool_speed, line_.tool_turn); });
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

  const MotionProblem& problem_;
  const LineOptions& line_;
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

// The same path of the tool, the arm turned on the way towards another configuration at its end: an elbow has a choice.
std::optional<PlannedMotion> plan_other_way(const Guard& guard, const JointVector& from, TipWay tip) {
  const Arm& arm = guard.problem().state.arm();
  const RandomKey key = guard.problem().key.with("other");
  for (const JointVector& end : arm.solutions(tip.world_from_tip(1), from, key.with("ends"), kOtherEnds)) {
    if (joint_gap(end, from) > kFarthestEnd) continue;
    tip.near = {from, end};
    const ToolPath path = follow_tool(arm, from, tip, key.with("path"));
    if (path.reason != Reason::none) continue;
    const Way way = way_along(guard.problem().start, from, path, tip.samples);
    std::string contact;
    if (guard.first_touching(way, contact) < way.waypoints.size()) continue;
    PlannedMotion motion = guard.timed(way);
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

PlannedMotion plan_tool_path(const MotionProblem& problem, const std::function<Transform(double)>& world_from_tip,
                             const LineOptions& line, const GoesAlong& goes_along) {
  if (!(line.tool_speed > 0) || !(line.tool_turn > 0))
    throw Error("motion planning", "the tool's speed limits must be positive");
  const Arm& arm = problem.state.arm();
  const TipWay tip{world_from_tip, line.samples > 0 ? line.samples : samples_along(world_from_tip), line.near};
  const Guard guard(problem, line, goes_along);
  if (line.keep_clear)
    if (const std::string contact = describe_contact(problem.state, problem.start); !contact.empty())
      return failed(Reason::start_in_collision, "at the start " + contact);
  // Where the tip is may differ a little from the path's start.
  const ToolPath first =
      follow_tool(arm, problem.start, {[&](double) { return world_from_tip(0); }}, problem.key.with("first"));
  if (first.reason != Reason::none) return failed(first.reason, "the path's start is out of reach");
  const JointVector from = first.waypoints.back();
  const ToolPath path = follow_tool(arm, from, tip, problem.key.with("path"));
  const auto enough = [&](std::size_t count) {
    return count > 0 && static_cast<double>(count) >= line.least_share * tip.samples;
  };
  if (path.reason != Reason::none && !enough(path.waypoints.size())) return failed(path.reason, path.detail);
  Way way = way_along(problem.start, from, path, tip.samples);
  std::string contact;
  const std::size_t touching = guard.first_touching(way, contact);
  if (touching == way.waypoints.size()) {
    PlannedMotion motion = guard.timed(way);
    if (motion.reason == Reason::none) return motion;
    contact = motion.detail;
  }
  if (auto motion = plan_other_way(guard, from, tip)) return *std::move(motion);
  const std::size_t before = way.waypoints.size() - path.waypoints.size();  // that are not of the path
  if (line.least_share < 1 && touching > before && enough(touching - before)) {
    way.waypoints.resize(touching);
    way.shares.resize(touching);
    PlannedMotion motion = guard.timed(way);
    if (motion.reason == Reason::none) return motion;
  }
  return failed(Reason::no_path, "on its way " + contact);
}

PlannedMotion plan_line(const MotionProblem& problem, const Transform& world_from_tip, const LineOptions& line) {
  if (!world_from_tip.matrix().allFinite()) throw Error("motion planning", "a tool target must be finite");
  const Transform from = problem.state.arm().world_from_tip(problem.start);
  LineOptions options = line;
  if (options.samples <= 0) options.samples = samples_between(from, world_from_tip);
  return plan_tool_path(
      problem, [&](double s) { return between(from, world_from_tip, s); }, options);
}

}  // namespace stampede
