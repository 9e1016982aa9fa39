#include "engine/motion/planner.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/motion/checker.h"
#include "engine/motion/ompl_planners.h"
#include "engine/motion/route.h"
#include "engine/motion/rrt.h"

namespace stampede {
namespace {

constexpr double kShortestBlend = 1e-3;  // rad
constexpr std::string_view kOmpl = "ompl:";

void check_input(const CollisionState& state, const JointVector& q, std::string_view which) {
  if (q.size() == state.arm().joints() && q.allFinite()) return;
  throw Error("motion planning", std::string(which) + " must be finite, with one value for each joint of the arm");
}

void check_limits(const MotionLimits& limits) {
  if (!(limits.resolution_rad > 0)) throw Error("motion limits", "resolution_rad must be positive");
}

// The corner whose blend holds q, 0 when q lies on a straight line.
std::size_t blend_at(const std::vector<JointVector>& waypoints, const std::vector<double>& blends,
                     const JointVector& q) {
  std::size_t best = 0;
  double nearest = 1e9;
  for (std::size_t i = 1; i + 1 < waypoints.size(); ++i) {
    const double distance = (waypoints[i] - q).norm();
    if (distance > blends[i] + 1e-6 || distance >= nearest || blends[i] < kShortestBlend) continue;
    nearest = distance;
    best = i;
  }
  return best;
}

}  // namespace

std::vector<std::string> motion_planner_names() {
  std::vector<std::string> names;
  for (const std::string& name : ompl_planner_names()) names.push_back(std::string(kOmpl) + name);
  return names;
}

void check_motion_planner(const std::string& name, const std::string& place) {
  if (name.empty()) return;
  const std::vector<std::string> names = motion_planner_names();
  if (std::binary_search(names.begin(), names.end(), name)) return;
  const std::string reason = name.starts_with(kOmpl) ? why_not_offered(name.substr(kOmpl.size())) : "";
  if (!reason.empty())
    throw Error(place, "'" + name + "' is not offered: " + reason, "ompl:RRTConnect, or leave it out");
  const std::string meant = name.starts_with(kOmpl) ? name : std::string(kOmpl) + name;
  throw Error(place, "there is no motion planner '" + name + "'", did_you_mean(meant, names));
}

double certified_step(const MotionLimits& limits) { return 0.25 * limits.resolution_rad; }

double clearance_m(const MotionLimits& limits, int care) {
  constexpr double kClearance = 0.002;
  return care < kMostCare ? std::min(limits.padding_m, kClearance) : 0.0;
}

JointPath check_ends(const CollisionState& state, const JointVector& start, const JointVector& goal) {
  check_input(state, start, "the start");
  check_input(state, goal, "the goal");
  JointPath path;
  if (const std::string contact = describe_contact(state, start); !contact.empty()) {
    path.reason = Reason::start_in_collision;
    path.detail = "at the start " + contact;
  } else if (const std::string at_goal = describe_contact(state, goal); !at_goal.empty()) {
    path.reason = Reason::no_path;
    path.detail = "at the goal " + at_goal;
  } else if (!state.arm().within_limits(goal, -1e-9)) {
    path.reason = Reason::unreachable;
    path.detail = "the goal is outside the joint limits";
  }
  return path;
}

JointPath search_path(const MotionProblem& problem, const JointVector& goal, int care) {
  const MotionLimits& limits = problem.limits;
  check_motion_planner(limits.planner, "MotionLimits::planner");
  static constexpr std::array<double, kMostCare + 1> kSpacing{5.0, 2.0, 1.0};
  const double step_rad = kSpacing[static_cast<std::size_t>(care)] * limits.resolution_rad;
  TreeOptions options;
  options.step_rad = step_rad;
  options.iterations = std::max(1, limits.iterations / 2);
  options.rounds = limits.rounds;
  JointPath path;
  for (const double padding :
       {limits.padding_m, clearance_m(limits, care)}) {  // what is too narrow with may do without
    Checker checker(problem.state, padding, {problem.start, goal});
    if (checker.edge_free(problem.start, goal, step_rad)) {
      path.waypoints = {problem.start, goal};
      return path;
    }
    const PathQuery query{checker, problem.state.arm().limits(), problem.start, goal};
    const RandomKey trees = problem.key.with(care).with("trees");
    path.waypoints = limits.planner.empty()
                         ? grow_trees(query, options, trees)
                         : plan_with_ompl(limits.planner.substr(kOmpl.size()), query, options, trees);
    if (path.waypoints.empty()) continue;
    path.waypoints = distinct(shorten(checker, path.waypoints, options));
    return path;
  }
  path.reason = Reason::no_path;
  path.detail = "no path in " + std::to_string(limits.iterations) + " tree extensions";
  return path;
}

JointPath plan_path(const MotionProblem& problem, const JointVector& goal) {
  check_limits(problem.limits);
  JointPath path = check_ends(problem.state, problem.start, goal);
  for (int care = 0; care <= kMostCare && path.reason == Reason::none; ++care) {
    path = search_path(problem, goal, care);
    if (path.reason != Reason::none) break;
    Checker checker(problem.state, clearance_m(problem.limits, care), {problem.start, goal});
    const std::optional<JointVector> touch = first_touch(checker, path.waypoints, certified_step(problem.limits));
    if (!touch) return path;
    if (care < kMostCare) continue;
    path.reason = Reason::no_path;
    path.detail = "the path found touches: " + checker.contact(*touch);
  }
  path.waypoints.clear();
  return path;
}

PlannedMotion certify(const CollisionState& state, const std::vector<JointVector>& waypoints,
                      const MotionLimits& limits, double clearance, const PathSpeedLimit& speed_limit,
                      const WayIn* way_in) {
  constexpr int kRounds = 24;
  const int physics_hz = state.scene().physics_hz;
  PlannedMotion motion;
  const std::vector<JointVector> kept = distinct(waypoints);
  if (kept.size() < 2) {
    motion.trajectory = time_path(state.arm(), {waypoints.back()}, limits, physics_hz);
    return motion;
  }
  const double padding = std::max(0.0, clearance);
  Checker checker(state, padding, {kept.front(), kept.back()});
  std::optional<Checker> checker_in;
  if (way_in != nullptr) checker_in.emplace(way_in->state, padding, std::vector{kept.front(), way_in->to});
  const auto touched = [&](const Trajectory& trajectory) -> std::optional<JointVector> {
    const double step_rad = certified_step(limits);
    const std::int64_t in = way_in != nullptr ? nearest_step(trajectory, way_in->to, physics_hz) : 0;
    if (in > 0)
      if (auto touch = first_touch(*checker_in, trajectory, 0, in, physics_hz, step_rad)) return touch;
    return first_touch(checker, trajectory, in, trajectory.steps(), physics_hz, step_rad);
  };
  const Arm& arm = state.arm();
  const PathSpeedLimit of_arm = tool_limit(arm, limits);
  const PathSpeedLimit limit = [&](const PathPoint& point) {
    return speed_limit ? std::min(of_arm(point), speed_limit(point)) : of_arm(point);
  };
  std::vector<double> blends = default_blends(kept, kLongestBlend);
  for (int round = 0; round < kRounds; ++round) {
    motion.trajectory = time_blended(BlendedPath(kept, blends), arm.limits(), limits, physics_hz, limit);
    const std::optional<JointVector> touch = clearance >= 0 ? touched(motion.trajectory) : std::nullopt;
    if (!touch) return motion;
    const std::string contact = checker.contact(*touch);
    motion.detail =
        "the path found touches: " + (contact.empty() && checker_in ? checker_in->contact(*touch) : contact);
    const std::size_t corner = blend_at(kept, blends, *touch);
    if (corner == 0) break;
    blends[corner] *= 0.4;
  }
  motion.reason = Reason::no_path;
  motion.trajectory.knots.clear();
  return motion;
}

namespace {

bool touches_only_itself(const CollisionState& state, const JointVector& q) {
  const auto all = state.contacts(q);
  return std::ranges::all_of(all,
                             [](const CollisionPair& pair) { return pair.robot_part.body < 0 && pair.other.body < 0; });
}

// The shortest turn of one joint after which an arm that is folded into itself, by a line that was followed so far, is
// clear; nothing: it is clear, or touches something else too, or no turn helps.
std::optional<JointVector> way_out_of_itself(const CollisionState& state, const JointVector& start) {
  constexpr double kStep = 0.01, kFarthest = 0.3, kClear = 0.02;  // rad
  if (state.free(start) || !touches_only_itself(state, start)) return std::nullopt;
  const Arm& arm = state.arm();
  std::vector<JointVector> ways;
  for (int joint = 0; joint < arm.joints(); ++joint)
    for (const double sign : {1.0, -1.0}) ways.push_back(sign * JointVector::Unit(arm.joints(), joint));
  for (double far = kStep; far < kFarthest && !ways.empty(); far += kStep) {
    std::erase_if(ways, [&](const JointVector& way) {
      const JointVector q = start + far * way;
      return !arm.within_limits(q, 0) || !touches_only_itself(state, q);
    });
    for (const JointVector& way : ways) {
      const JointVector clear = start + (far + kClear) * way;
      if (state.free(start + far * way) && state.free(clear) && arm.within_limits(clear, 0)) return clear;
    }
  }
  return std::nullopt;
}

PlannedMotion plan_from(const MotionProblem& problem, const JointVector& goal) {
  PlannedMotion motion;
  const JointPath ends = check_ends(problem.state, problem.start, goal);
  motion.reason = ends.reason;
  motion.detail = ends.detail;
  if (ends.reason != Reason::none) return motion;
  for (int care = 0; care <= kMostCare; ++care) {
    const JointPath path = search_path(problem, goal, care);
    motion.reason = path.reason;
    motion.detail = path.detail;
    if (path.reason != Reason::none) return motion;
    motion = certify(problem.state, path.waypoints, problem.limits, clearance_m(problem.limits, care));
    if (motion.reason == Reason::none) return motion;
  }
  return motion;
}

}  // namespace

PlannedMotion plan_after_way_out(const MotionProblem& problem,
                                 const std::function<PlannedMotion(const MotionProblem& from)>& plan) {
  const CollisionState& state = problem.state;
  const std::optional<JointVector> out = way_out_of_itself(state, problem.start);
  if (!out) return plan(problem);
  PlannedMotion motion = plan(problem.from(*out));
  if (motion.reason != Reason::none) return motion;
  Trajectory first = time_path(state.arm(), {problem.start, *out}, problem.limits, state.scene().physics_hz);
  const std::int64_t later = first.steps();
  for (std::size_t i = 0; i < motion.trajectory.knots.size(); ++i) {
    Trajectory::Knot& knot = motion.trajectory.knots[i];
    knot.step += later;
    if (i > 0) first.knots.push_back(std::move(knot));
  }
  motion.trajectory = std::move(first);
  for (PlannedVia& via : motion.vias) via.step += later;
  for (PlannedHand& hand : motion.hands) hand.step += later;
  return motion;
}

PlannedMotion plan_joints(const MotionProblem& problem, const JointVector& goal) {
  check_limits(problem.limits);
  return plan_after_way_out(problem, [&](const MotionProblem& from) { return plan_from(from, goal); });
}

std::int64_t nearest_step(const Trajectory& trajectory, const JointVector& q, int physics_hz) {
  std::int64_t best = 0;
  double nearest = 1e300;
  for (std::int64_t step = 0; step <= trajectory.steps(); ++step) {
    const double distance = (evaluate(trajectory, static_cast<double>(step), physics_hz).position - q).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    best = step;
  }
  return best;
}

}  // namespace stampede
