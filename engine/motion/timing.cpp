#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/error.h"
#include "engine/motion/blended_path.h"

namespace stampede {
namespace {

constexpr std::int64_t kKnotSteps = 6;
constexpr double kSmoothing_s = 0.05;
constexpr double kCurvatureShare = 0.7;  // of the acceleration that a corner may use; the rest can still brake
constexpr int kLocalRounds = 5;

// The limits of one query, shares applied. Shapes: one entry per joint.
struct Bounds {
  Eigen::Array<double, Eigen::Dynamic, 1, 0, 16, 1> velocity, acceleration, jerk;
};

double or_unlimited(double limit) { return limit > 0 ? limit : 1e9; }

Bounds bounds_of(const std::vector<JointLimits>& joints, const MotionLimits& limits) {
  if (!(limits.speed > 0 && limits.speed <= 1) || !(limits.acceleration > 0 && limits.acceleration <= 1))
    throw Error("motion limits", "the shares of speed and acceleration must lie in (0, 1]");
  Bounds bounds;
  const Eigen::Index n = static_cast<Eigen::Index>(joints.size());
  bounds.velocity.resize(n);
  bounds.acceleration.resize(n);
  bounds.jerk.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const JointLimits& joint = joints[static_cast<std::size_t>(i)];
    bounds.velocity[i] = limits.speed * or_unlimited(joint.velocity);
    bounds.acceleration[i] = limits.acceleration * or_unlimited(joint.acceleration);
    bounds.jerk[i] = or_unlimited(joint.jerk);
  }
  return bounds;
}

// The path at one node of the grid, as the sweeps need it.
struct Node {
  double s = 0;
  double most = 0;  // greatest squared path speed
  PathPoint point;
};

// Path acceleration that is possible in both directions at squared path speed x.
double room(const Node& node, double x, const Bounds& bounds) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < node.point.tangent.size(); ++i) {
    const double tangent = std::abs(node.point.tangent[i]);
    if (tangent < 1e-9) continue;
    least = std::min(least, (bounds.acceleration[i] - std::abs(node.point.curvature[i]) * x) / tangent);
  }
  return std::max(0.0, std::min(least, 1e6));
}

double greatest_square(const PathPoint& point, const Bounds& bounds, const PathSpeedLimit& speed_limit) {
  double most = 1e6;
  for (Eigen::Index i = 0; i < point.tangent.size(); ++i) {
    const double tangent = std::abs(point.tangent[i]);
    const double curvature = std::abs(point.curvature[i]);
    if (tangent > 1e-9) most = std::min(most, std::pow(bounds.velocity[i] / tangent, 2));
    if (curvature > 1e-9) most = std::min(most, kCurvatureShare * bounds.acceleration[i] / curvature);
  }
  if (speed_limit) most = std::min(most, std::pow(speed_limit(point), 2));
  return std::max(most, 1e-8);
}

std::vector<Node> make_nodes(const BlendedPath& path, const Bounds& bounds, const PathSpeedLimit& speed_limit) {
  std::vector<Node> nodes;
  for (const double s : path.grid()) {
    Node node{s, 0, path.at(s)};
    node.most = greatest_square(node.point, bounds, speed_limit);
    nodes.push_back(std::move(node));
  }
  return nodes;
}

// Path length over time: constant path acceleration between nodes, then averaged over a window of `smoothing_s`.
class Profile {
 public:
  Profile(const std::vector<Node>& nodes, const Bounds& bounds, double smoothing_s) : smoothing_s_(smoothing_s) {
    const std::size_t n = nodes.size();
    std::vector<double> x(n, 0.0);
    const auto reach = [&](std::size_t from, std::size_t to) {
      const double gap = std::abs(nodes[to].s - nodes[from].s);
      return x[from] + 2 * gap * std::min(room(nodes[from], x[from], bounds), room(nodes[to], x[from], bounds));
    };
    for (std::size_t i = n - 1; i-- > 0;) x[i] = std::min(nodes[i].most, reach(i + 1, i));
    x[0] = 0;
    for (std::size_t i = 1; i < n; ++i) x[i] = std::min(x[i], reach(i - 1, i));
    cells_.push_back({0, nodes[0].s, 0, 0, 0});
    for (std::size_t i = 1; i < n; ++i) append(nodes[i].s, std::sqrt(x[i]));
  }
  double smoothing_s() const { return smoothing_s_; }
  double duration_s() const { return cells_.back().t + smoothing_s_; }

  struct State {
    double s, speed, acceleration;
  };
  State at(double t) const {
    const State now = raw(t), before = raw(t - smoothing_s_);
    return {(area(t) - area(t - smoothing_s_)) / smoothing_s_, (now.s - before.s) / smoothing_s_,
            (now.speed - before.speed) / smoothing_s_};
  }

 private:
  struct Cell {                              // from its time on
    double t, s, speed, acceleration, area;  // area: integral of s over time so far
  };
  void append(double s, double speed) {
    Cell& last = cells_.back();
    const double gap = s - last.s;
    const double dt = 2 * gap / std::max(last.speed + speed, 1e-9);
    last.acceleration = (speed - last.speed) / dt;
    const double swept = last.s * dt + last.speed * dt * dt / 2 + last.acceleration * dt * dt * dt / 6;
    cells_.push_back({last.t + dt, s, speed, 0, last.area + swept});
  }
  const Cell& cell(double t) const {
    const auto after = std::upper_bound(cells_.begin() + 1, cells_.end() - 1, t,
                                        [](double value, const Cell& c) { return value < c.t; });
    return *(after - 1);
  }
  State raw(double t) const {
    if (t <= 0) return {0, 0, 0};
    if (t >= cells_.back().t) return {cells_.back().s, 0, 0};
    const Cell& c = cell(t);
    const double dt = t - c.t;
    return {c.s + dt * (c.speed + 0.5 * dt * c.acceleration), c.speed + dt * c.acceleration, c.acceleration};
  }
  double area(double t) const {
    if (t <= 0) return 0;
    if (t >= cells_.back().t) return cells_.back().area + (t - cells_.back().t) * cells_.back().s;
    const Cell& c = cell(t);
    const double dt = t - c.t;
    return c.area + c.s * dt + c.speed * dt * dt / 2 + c.acceleration * dt * dt * dt / 6;
  }
  double smoothing_s_;
  std::vector<Cell> cells_;
};

// A profile as knots, `scale` times slower than it says.
struct Sampled {
  Trajectory trajectory;
  double scale = 1;
};

// Slowed down by at least `slower`, so that it ends on a knot.
Sampled sample(const BlendedPath& path, const Profile& profile, double slower, int physics_hz) {
  const double steps = profile.duration_s() * slower * physics_hz;
  const std::int64_t knots = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(steps / kKnotSteps - 1e-9)));
  const double scale = static_cast<double>(knots * kKnotSteps) / (profile.duration_s() * physics_hz);
  Trajectory trajectory;
  for (std::int64_t k = 0; k <= knots; ++k) {
    const double t = static_cast<double>(k * kKnotSteps) / physics_hz / scale;
    const Profile::State state = profile.at(t);
    const PathPoint point = path.at(state.s);
    const double speed = state.speed / scale, acceleration = state.acceleration / (scale * scale);
    trajectory.knots.push_back({k * kKnotSteps, point.position, speed * point.tangent,
                                speed * speed * point.curvature + acceleration * point.tangent});
  }
  for (auto* knot : {&trajectory.knots.front(), &trajectory.knots.back()}) {
    knot->velocity.setZero();
    knot->acceleration.setZero();
  }
  // To the last bit, so that the next motion starts where this one ends.
  trajectory.knots.front().position = path.start();
  trajectory.knots.back().position = path.goal();
  return {std::move(trajectory), scale};
}

// Calls visit(step, factor by which the motion is too fast there) at half steps.
template <typename Visit>
void for_usage(const Trajectory& trajectory, const Bounds& bounds, int physics_hz, const Visit& visit) {
  JointState last = evaluate(trajectory, 0, physics_hz);
  for (std::int64_t half = 1; half <= 2 * trajectory.steps(); ++half) {
    const double step = 0.5 * static_cast<double>(half);
    const JointState now = evaluate(trajectory, step, physics_hz);
    const auto jerk = (now.acceleration - last.acceleration).array() * (2.0 * physics_hz);
    const double velocity_use = (now.velocity.array().abs() / bounds.velocity).maxCoeff();
    const double acceleration_use = (now.acceleration.array().abs() / bounds.acceleration).maxCoeff();
    const double jerk_use = (jerk.abs() / bounds.jerk).maxCoeff();
    visit(step, std::max({velocity_use, std::sqrt(acceleration_use), std::cbrt(jerk_use)}));
    last = now;
  }
}

// Lowers the speed around places that were too fast. False: there were none.
bool slow_down(const Sampled& sampled, const Profile& profile, const Bounds& bounds, int physics_hz,
               std::vector<Node>& nodes) {
  std::vector<double> factor(nodes.size(), 1.0);
  bool any = false;
  for_usage(sampled.trajectory, bounds, physics_hz, [&](double step, double use) {
    if (use <= 1.0) return;
    any = true;
    const Profile::State state = profile.at(step / physics_hz / sampled.scale);
    const double reach = 0.5 * state.speed * profile.smoothing_s() + 1e-4;
    auto node =
        std::lower_bound(nodes.begin(), nodes.end(), state.s - reach, [](const Node& a, double s) { return a.s < s; });
    for (; node != nodes.end() && node->s <= state.s + reach; ++node) {
      double& f = factor[static_cast<std::size_t>(node - nodes.begin())];
      f = std::min(f, 1.0 / std::pow(1.0 + 1.1 * (use - 1.0), 2));
    }
  });
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].most *= factor[i];
  return any;
}

}  // namespace

double limit_usage(const Trajectory& trajectory, const std::vector<JointLimits>& joint_limits,
                   const MotionLimits& limits, int physics_hz) {
  double most = 0;
  for_usage(trajectory, bounds_of(joint_limits, limits), physics_hz,
            [&](double, double use) { most = std::max(most, use); });
  return most;
}

Trajectory time_blended(const BlendedPath& path, const std::vector<JointLimits>& joint_limits,
                        const MotionLimits& limits, int physics_hz, const PathSpeedLimit& speed_limit) {
  const Bounds bounds = bounds_of(joint_limits, limits);
  const double window_s = std::max(kSmoothing_s, (2 * bounds.acceleration / bounds.jerk).maxCoeff());
  std::vector<Node> nodes = make_nodes(path, bounds, speed_limit);
  for (int round = 0; round < kLocalRounds; ++round) {
    const Profile profile(nodes, bounds, window_s);
    Sampled sampled = sample(path, profile, 1.0, physics_hz);
    if (!slow_down(sampled, profile, bounds, physics_hz, nodes)) return std::move(sampled.trajectory);
  }
  // What local slowing has not cured (a limit touched while speeding up), the whole motion pays for.
  const Profile profile(nodes, bounds, window_s);
  double slower = 1;
  for (int round = 0; round < 50; ++round) {
    Sampled sampled = sample(path, profile, slower, physics_hz);
    const double use = limit_usage(sampled.trajectory, joint_limits, limits, physics_hz);
    if (use <= 1.0) return std::move(sampled.trajectory);
    slower = std::max(sampled.scale * use, slower) * 1.001;
  }
  throw Error("timing", "no speed keeps the joint limits", "are the limits of the robot positive?");
}

PathSpeedLimit tool_limit(const Arm& arm, const MotionLimits& limits) {
  if (!(limits.tool_speed > 0)) throw Error("motion limits", "the speed of the tool must be positive");
  return [&arm, speed = limits.tool_speed](const PathPoint& point) {
    const Vector3 along = arm.jacobian(point.position).topRows<3>() * point.tangent;
    return speed / std::max(1e-9, along.norm());
  };
}

Trajectory time_path(const Arm& arm, const std::vector<JointVector>& waypoints, const MotionLimits& limits,
                     int physics_hz) {
  if (waypoints.empty()) throw Error("timing", "a path needs at least one waypoint");
  const std::vector<JointVector> kept = distinct(waypoints);
  const JointVector still = JointVector::Zero(kept.front().size());
  if (kept.size() == 1) return Trajectory{{{0, waypoints.back(), still, still}}};
  return time_blended(BlendedPath(kept, default_blends(kept, kLongestBlend)), arm.limits(), limits, physics_hz,
                      tool_limit(arm, limits));
}

}  // namespace stampede
