#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"
#include "engine/motion/checker.h"
#include "engine/motion/passable.h"
#include "engine/motion/pieces.h"
#include "engine/motion/route.h"

namespace stampede {
namespace {

constexpr double kMostJump = 0.3;    // rad between samples
constexpr double kLineError = 2e-3;  // rad, of decimated approach lines
constexpr int kSolutions = 6;        // joint solutions tried for the first target
constexpr int kMoreSolutions = 24;   // and after these

void check_pose(const Transform& pose) {
  if (!pose.matrix().allFinite()) throw Error("motion planning", "a tool target must be finite");
}

JointVector guide_at(const std::vector<JointVector>& all, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(all.size() - 1);
  const std::size_t i = std::min(all.size() - 1, static_cast<std::size_t>(place));
  const JointVector& next = all[std::min(all.size() - 1, i + 1)];
  return all[i] + (place - static_cast<double>(i)) * (next - all[i]);
}

std::string percent(double share) { return std::to_string(static_cast<int>(std::lround(100 * share))) + " %"; }

double distance_to_segment(const JointVector& q, const JointVector& a, const JointVector& b) {
  const JointVector along = b - a;
  const double square = along.squaredNorm();
  const double share = square > 0 ? std::clamp((q - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (a + share * along - q).norm();
}

void keep_between(const std::vector<JointVector>& all, std::size_t first, std::size_t last, double tolerance_rad,
                  std::vector<JointVector>& kept) {
  std::size_t worst = first;
  double error = tolerance_rad;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double distance = distance_to_segment(all[i], all[first], all[last]);
    if (distance <= error) continue;
    error = distance;
    worst = i;
  }
  if (worst == first) {
    kept.push_back(all[last]);
    return;
  }
  keep_between(all, first, worst, tolerance_rad, kept);
  keep_between(all, worst, last, tolerance_rad, kept);
}

// The straight lines from the first target on, starting in one of its joint solutions.
struct Tail {
  Reason reason = Reason::none;
  std::string detail;
  std::vector<JointVector> waypoints;  // the first: at targets[0]
  std::vector<JointVector> at_target;
};

// What must not be touched on the lines ahead: what an empty hand has taken by then comes along, and a fist pushes a
// part.
CollisionState obstacles_ahead(const CollisionState& state, const PartWay* pushed) {
  CollisionState then = state;
  if (state.held()) return then;
  if (state.opening() < kShut_m && pushed != nullptr)
    for (const PartRef part : with_mounted(state.scene(), pushed->part)) then.allow(part);
  for (const PartRef part : state.allowed())
    if (part.body >= 0 && state.scene().body_at(part.body).free) then.remove(part);
  return then;
}

// A way of the tool on which nothing is touched, its joints close together.
struct Line {
  Reason reason = Reason::none;
  std::string detail;
  std::vector<JointVector> dense;  // the first: where it begins
};

Line free_line(const MotionProblem& problem, const TipWay& way) {
  const ToolPath path = follow_tool(problem.state.arm(), problem.start, way, problem.key);
  if (path.reason != Reason::none) return {path.reason, path.detail, {}};
  Line line{Reason::none, {}, {problem.start}};
  line.dense.insert(line.dense.end(), path.waypoints.begin(), path.waypoints.end());
  Checker checker(problem.state, 0, {});
  if (const auto touch = first_touch(checker, line.dense, certified_step(problem.limits)))
    return {Reason::no_path, checker.contact(*touch), {}};
  return line;
}

Line straight_line(const MotionProblem& problem, const ToolTarget& from, const ToolTarget& to) {
  const Transform here = from.world_from_tip, there = to.world_from_tip;
  return free_line(problem, {[&](double s) { return between(here, there, s); }, samples_between(here, there)});
}

// `at_first`: with the arm at the first target.
Tail make_tail(const MotionProblem& at_first, const std::vector<ToolTarget>& targets, const ThenDo& then) {
  const CollisionState& state = at_first.state;
  Tail tail;
  tail.waypoints = {at_first.start};
  tail.at_target = {at_first.start};
  const auto refuse = [&](Reason reason, std::string detail) {
    tail.reason = reason;
    tail.detail = std::move(detail);
    return tail;
  };
  if (const std::string contact = describe_contact(state, at_first.start); !contact.empty())
    return refuse(Reason::no_path, "at " + targets[0].name + " " + contact);
  const auto line_to = [&](std::size_t i, const CollisionState& free, const JointVector& from) {
    const RandomKey key = at_first.key.with(static_cast<std::int64_t>(i));
    return straight_line({free, from, at_first.limits, key}, targets[i - 1], targets[i]);
  };
  std::size_t i = 1;
  for (; i < targets.size() && !targets[i].ahead; ++i) {
    const Line line = line_to(i, state, tail.waypoints.back());
    if (line.reason != Reason::none)
      return refuse(line.reason, "on the way to " + targets[i].name + ": " + line.detail);
    const std::vector<JointVector> sparse = decimate(line.dense, kLineError);
    tail.waypoints.insert(tail.waypoints.end(), sparse.begin() + 1, sparse.end());
    tail.at_target.push_back(tail.waypoints.back());
  }
  JointVector from = tail.waypoints.back();
  std::optional<CollisionState> then_free;
  for (; i < targets.size(); ++i) {
    if (!then_free) then_free = obstacles_ahead(state, then.part);
    const Line line = line_to(i, *then_free, from);
    if (line.reason != Reason::none) return refuse(line.reason, "on from " + targets[i - 1].name + ": " + line.detail);
    from = line.dense.back();
  }
  if (then.part != nullptr && !can_go_with_part(state, from, *then.part, at_first.key.with("then")))
    return refuse(Reason::unreachable, "from " + targets.back().name + " the arm cannot go with what it takes hold of");
  for (std::size_t k = 0; then.pieces != nullptr && k < then.pieces->size(); ++k) {
    const ToolPiece& piece = (*then.pieces)[k];
    const PieceLength length = length_of(piece);
    const int samples = std::max(1, static_cast<int>(std::ceil(std::max(length.way / 0.005, length.turn / 0.02))));
    if (!then_free) then_free = obstacles_ahead(state, nullptr);
    const RandomKey key = at_first.key.with("then").with(static_cast<std::int64_t>(k));
    const Line line = free_line({*then_free, from, at_first.limits, key}, {piece.world_from_tip, samples});
    if (line.reason != Reason::none)
      return refuse(line.reason, "then, on piece " + std::to_string(k + 1) + ": " + line.detail);
    from = line.dense.back();
  }
  return tail;
}

// What counts on the free way to the first target. Nothing may be touched there: what is to be grasped, and what that
// which is held is brought to, is still an obstacle; unless an end of a way that no lines follow touches it.
CollisionState obstacles_before(const MotionProblem& problem, const Tail& tail) {
  CollisionState untouched = problem.state;
  untouched.clear_allowed();
  if (tail.waypoints.size() > 1) return untouched;
  const bool free = untouched.free(problem.start) && untouched.free(tail.waypoints.front());
  return free ? untouched : problem.state;
}

// Free motion to the tail's start, then the tail.
PlannedMotion plan_to_tail(const MotionProblem& problem, const Tail& tail, const std::vector<ToolTarget>& targets) {
  PlannedMotion motion;
  const CollisionState before = obstacles_before(problem, tail);
  const WayIn way_in{before, tail.waypoints.front()};
  const bool lines = tail.waypoints.size() > 1;
  for (int care = 0; care <= kMostCare; ++care) {
    JointPath path = search_path({before, problem.start, problem.limits, problem.key}, tail.waypoints.front(), care);
    motion.reason = path.reason;
    motion.detail = path.detail;
    if (path.reason != Reason::none) return motion;
    path.waypoints.insert(path.waypoints.end(), tail.waypoints.begin() + 1, tail.waypoints.end());
    const double clearance = clearance_m(problem.limits, care);
    motion = lines ? certify(problem.state, path.waypoints, problem.limits, clearance, {}, &way_in)
                   : certify(before, path.waypoints, problem.limits, clearance);
    if (motion.reason == Reason::none) break;
  }
  if (motion.reason != Reason::none) return motion;
  for (std::size_t i = 0; i + 1 < tail.at_target.size(); ++i)
    motion.vias.push_back({targets[i].name, targets[i].world_from_tip,
                           nearest_step(motion.trajectory, tail.at_target[i], problem.state.scene().physics_hz)});
  return motion;
}

PlannedMotion plan_through_from(const MotionProblem& problem, const std::vector<ToolTarget>& targets,
                                const ThenDo& then) {
  const auto& [state, start, limits, key] = problem;
  PlannedMotion motion;
  const JointPath ends = check_ends(state, start, start);
  motion.reason = ends.reason;
  motion.detail = ends.detail;
  if (motion.reason == Reason::start_in_collision) return motion;
  std::vector<JointVector> solutions =
      state.arm().solutions(targets[0].world_from_tip, start, key.with("ik"), kSolutions);
  // Who has to go on with a part or along a way needs the right one: then more are looked for.
  bool searched = then.part == nullptr && then.pieces == nullptr;
  motion.reason = Reason::unreachable;
  motion.detail = "no joint configuration reaches " + targets[0].name;
  for (std::size_t i = 0;; ++i) {
    if (i == solutions.size() && !std::exchange(searched, true)) {
      const auto more = state.arm().solutions(targets[0].world_from_tip, start, key.with("more"), kMoreSolutions, 200);
      solutions.insert(solutions.end(), more.begin(), more.end());
    }
    if (i >= solutions.size()) break;
    const RandomKey query = key.with("solution").with(static_cast<std::int64_t>(i));
    const Tail tail = make_tail({state, solutions[i], limits, query.with("tail")}, targets, then);
    if (tail.reason != Reason::none) {
      motion.reason = tail.reason;
      motion.detail = tail.detail;
      continue;
    }
    motion = plan_to_tail({state, start, limits, query}, tail, targets);
    if (motion.reason == Reason::none) return motion;
  }
  return motion;
}

}  // namespace

std::vector<JointVector> decimate(const std::vector<JointVector>& waypoints, double tolerance_rad) {
  if (waypoints.size() < 3) return waypoints;
  std::vector<JointVector> kept{waypoints.front()};
  keep_between(waypoints, 0, waypoints.size() - 1, tolerance_rad, kept);
  return kept;
}

double tool_limit(const Arm& arm, const PathPoint& point, double speed, double turn_speed) {
  const Eigen::Matrix<double, 6, 1> twist = arm.jacobian(point.position) * point.tangent;
  const double linear = std::max(1e-9, twist.head<3>().norm()), angular = std::max(1e-9, twist.tail<3>().norm());
  return std::min(speed / linear, turn_speed / angular);
}

int samples_between(const Transform& from, const Transform& to) {
  const double turn = angle_between(Quaternion(from.linear()), Quaternion(to.linear()));
  const double way = (to.translation() - from.translation()).norm();
  return std::max(1, static_cast<int>(std::ceil(std::max(way / 0.005, turn / 0.02))));
}

ToolPath follow_tool(const Arm& arm, const JointVector& start, const TipWay& way, RandomKey key) {
  ToolPath path;
  JointVector last = start;
  for (int i = 1; i <= way.samples; ++i) {
    const double share = static_cast<double>(i) / way.samples;
    const Transform target = way.world_from_tip(share);
    check_pose(target);
    const JointVector guess = way.near.empty() ? last : guide_at(way.near, share);
    const std::optional<JointVector> q = arm.solve(target, guess, key.with(i), 0);
    if (!q || joint_gap(*q, last) > kMostJump) {
      path.reason = Reason::unreachable;
      path.detail =
          "the arm cannot follow beyond " + percent(static_cast<double>(i - 1) / way.samples) + " of the line";
      return path;
    }
    path.waypoints.push_back(*q);
    last = *q;
  }
  return path;
}

bool passable(const MotionProblem& problem, const std::vector<ToolTarget>& targets, const ThenDo& then) {
  const auto& [state, start, limits, key] = problem;
  const auto solutions = state.arm().solutions(targets.at(0).world_from_tip, start, key.with("ik"), kSolutions);
  return std::ranges::any_of(solutions, [&](const JointVector& q) {
    return make_tail({state, q, limits, key.with("tail")}, targets, then).reason == Reason::none;
  });
}

PlannedMotion plan_through(const MotionProblem& problem, const std::vector<ToolTarget>& targets, const ThenDo& then) {
  if (targets.empty() || targets[0].ahead) throw Error("motion planning", "a motion needs at least one target");
  for (const ToolTarget& target : targets) check_pose(target.world_from_tip);
  return plan_after_way_out(problem, [&](const MotionProblem& from) { return plan_through_from(from, targets, then); });
}

}  // namespace stampede
