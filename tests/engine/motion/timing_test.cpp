#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/motion/blended_path.h"
#include "engine/motion/stops.h"
#include "tests/engine/motion/cluttered.h"

using namespace stampede;

namespace {

JointVector joints(std::initializer_list<double> values) {
  JointVector q(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (const double value : values) q[i++] = value;
  return q;
}

std::vector<JointVector> random_waypoints(const Arm& arm, int count, std::int64_t seed) {
  Random random(RandomKey("waypoints").with(seed));
  std::vector<JointVector> waypoints;
  for (int k = 0; k < count; ++k) {
    JointVector q(arm.joints());
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const JointLimits& limit = arm.limits()[static_cast<std::size_t>(i)];
      q[i] = random.between(limit.lower, limit.upper);
    }
    waypoints.push_back(q);
  }
  return waypoints;
}

// Position, velocity, acceleration by evaluate(); jerk by differences a tenth of a step apart.
void require_within_limits(const Trajectory& trajectory, const Arm& arm, const MotionLimits& limits) {
  double velocity = 0, acceleration = 0, jerk = 0;
  constexpr double kStep = 0.1;
  JointState last = evaluate(trajectory, 0, kHz);
  for (double step = kStep; step <= static_cast<double>(trajectory.steps()); step += kStep) {
    const JointState now = evaluate(trajectory, step, kHz);
    for (Eigen::Index i = 0; i < now.position.size(); ++i) {
      const JointLimits& limit = arm.limits()[static_cast<std::size_t>(i)];
      velocity = std::max(velocity, std::abs(now.velocity[i]) / (limits.speed * limit.velocity));
      acceleration = std::max(acceleration, std::abs(now.acceleration[i]) / (limits.acceleration * limit.acceleration));
      jerk = std::max(jerk, std::abs(now.acceleration[i] - last.acceleration[i]) * kHz / kStep / limit.jerk);
    }
    last = now;
  }
  CHECK(velocity <= 1.001);
  CHECK(acceleration <= 1.002);  // between the samples that the planner tested
  CHECK(jerk <= 1.01);
}

}  // namespace

TEST_CASE("random paths keep velocity, acceleration and jerk limits between their samples") {
  const Arm arm(panda_robot());
  for (int seed = 0; seed < 20; ++seed) {
    MotionLimits limits;
    limits.speed = seed % 2 == 0 ? 1.0 : 0.4;
    limits.acceleration = seed % 3 == 0 ? 1.0 : 0.3;
    const auto waypoints = random_waypoints(arm, 2 + seed % 5, seed);
    const Trajectory trajectory = time_path(arm, waypoints, limits, kHz);
    require_within_limits(trajectory, arm, limits);
    REQUIRE(trajectory.knots.front().position == waypoints.front());
    REQUIRE(trajectory.knots.back().position == waypoints.back());
    REQUIRE(trajectory.knots.back().velocity.norm() == 0);
    REQUIRE(trajectory.knots.back().acceleration.norm() == 0);
  }
}

TEST_CASE("a straight move takes little longer than the trapezoid that is its lower bound") {
  const Arm arm(panda_robot());
  const JointVector start = arm.home();
  for (const double way : {0.05, 0.3, 1.0, 2.0}) {
    JointVector goal = start;
    goal[0] += way;
    const MotionLimits limits;
    const double v = 2.175, a = 7.5;
    const double bound = way > v * v / a ? way / v + v / a : 2 * std::sqrt(way / a);
    const double taken = static_cast<double>(time_path(arm, {start, goal}, limits, kHz).steps()) / kHz;
    CHECK(taken >= bound);
    CHECK(taken <= 1.05 * bound + 0.10);  // a smoothing window of 0.05 s and one knot spacing
  }
}

TEST_CASE("half the speed limit makes a long straight move take about twice as long") {
  const Arm arm(panda_robot());
  JointVector start = arm.home(), goal = start;
  start[0] = -2.8;
  goal[0] = 2.8;
  MotionLimits slow, fast;
  slow.speed = 0.25;
  fast.speed = 0.5;
  const auto steps = [&](const MotionLimits& limits) {
    return static_cast<double>(time_path(arm, {start, goal}, limits, kHz).steps());
  };
  CHECK(steps(slow) / steps(fast) == Approx(2).epsilon(0.05));
}

TEST_CASE("a corner is passed without stopping and left by no more than its blend allows") {
  const Arm arm(panda_robot());
  JointVector corner = arm.home(), goal;
  corner[0] += 0.6;
  goal = corner;
  goal[1] += 0.5;
  const Trajectory trajectory = time_path(arm, {arm.home(), corner, goal}, {}, kHz);
  double nearest = 1e9, slowest = 1e9;
  for (std::int64_t step = 0; step <= trajectory.steps(); ++step) {
    const JointState state = evaluate(trajectory, static_cast<double>(step), kHz);
    nearest = std::min(nearest, (state.position - corner).norm());
    const bool inside = step > 40 && step < trajectory.steps() - 40;
    if (inside) slowest = std::min(slowest, state.velocity.norm());
  }
  CHECK(nearest <= 0.1875 * kLongestBlend * std::sqrt(2.0) + 1e-3);
  CHECK(nearest >= 0.01);  // it is rounded
  CHECK(slowest > 0.5);    // rad/s
}

TEST_CASE("the tangent of a blended path is the derivative of its position, curvature that of the tangent") {
  const Arm arm(panda_robot());
  for (int seed = 0; seed < 10; ++seed) {
    const auto waypoints = random_waypoints(arm, 5, 100 + seed);
    const BlendedPath path(waypoints, default_blends(waypoints, 0.2));
    Random random(RandomKey("s").with(seed));
    for (int k = 0; k < 50; ++k) {
      const double h = 1e-5, s = random.between(h, path.length() - h);
      const PathPoint before = path.at(s - h), now = path.at(s), after = path.at(s + h);
      REQUIRE(((after.position - before.position) / (2 * h) - now.tangent).norm() < 1e-3);
      REQUIRE(((after.tangent - before.tangent) / (2 * h) - now.curvature).norm() < 0.05);
      REQUIRE(now.tangent.norm() <= 1 + 1e-12);
    }
  }
}

TEST_CASE("paths that turn back and paths of one point are timed too") {
  const Arm arm(panda_robot());
  JointVector away = arm.home();
  away[3] += 0.4;
  const Trajectory back = time_path(arm, {arm.home(), away, arm.home()}, {}, kHz);
  require_within_limits(back, arm, {});
  CHECK(back.knots.back().position == arm.home());
  CHECK(time_path(arm, {away}, {}, kHz).steps() == 0);
  CHECK(time_path(arm, {away, away}, {}, kHz).knots.size() == 1);
  CHECK_THROWS_AS(time_path(arm, {}, {}, kHz), Error);
  MotionLimits bad;
  bad.speed = 0;
  CHECK_THROWS_AS(time_path(arm, {arm.home(), away}, bad, kHz), Error);
}

TEST_CASE("a robot with low jerk limits is slowed down to them") {
  Robot robot = panda_robot();
  for (JointLimits& limit : robot.limits) limit.jerk = 30;
  const Arm arm(robot);
  JointVector goal = arm.home() + joints({0.5, 0.3, -0.4, 0.3, 0.2, -0.3, 0.9});
  require_within_limits(time_path(arm, {arm.home(), goal}, {}, kHz), arm, {});
}

TEST_CASE("a motion that stops at its via-points goes the same way, stands at each and keeps the limits") {
  const Arm arm(panda_robot());
  JointVector corner = arm.home(), goal;
  corner[0] += 0.6;
  goal = corner;
  goal[1] += 0.5;
  const Trajectory plain = time_path(arm, {arm.home(), corner, goal}, {}, kHz);
  PlannedMotion motion;
  motion.trajectory = plain;
  motion.vias = {{"corner", arm.world_from_tip(corner), plain.steps() / 2}};
  const JointVector passed = evaluate(plain, static_cast<double>(motion.vias[0].step), kHz).position;
  stop_at_vias(arm, {}, kHz, plain.steps(), motion);

  require_within_limits(motion.trajectory, arm, {});
  CHECK(motion.trajectory.knots.front().position == plain.knots.front().position);
  CHECK(motion.trajectory.knots.back().position == plain.knots.back().position);
  CHECK(motion.trajectory.knots.back().velocity.norm() == 0);
  int still = 0;
  for (std::int64_t step = 1; step < motion.trajectory.steps(); ++step) {
    const JointState now = evaluate(motion.trajectory, static_cast<double>(step), kHz);
    if (now.velocity.cwiseAbs().maxCoeff() < 1e-3 && (now.position - passed).norm() < 1e-3) ++still;
    double nearest = 1e9;
    for (std::int64_t old = 0; old <= 10 * plain.steps(); ++old)
      nearest =
          std::min(nearest, (evaluate(plain, 0.1 * static_cast<double>(old), kHz).position - now.position).norm());
    CHECK(nearest < 2e-3);
  }
  CHECK(still >= 0.15 * kHz);
  const JointState there = evaluate(motion.trajectory, static_cast<double>(motion.vias[0].step), kHz);
  CHECK((there.position - passed).norm() < 1e-3);
}

TEST_CASE("a wrist that turns by nearly half a turn stops on its way, one that turns by a quarter does not") {
  const Arm arm(panda_robot());
  for (const double turn : {3.0, 1.5}) {
    CAPTURE(turn);
    JointVector goal = arm.home();
    goal[6] -= turn;
    PlannedMotion motion;
    motion.trajectory = time_path(arm, {arm.home(), goal}, {}, kHz);
    stop_at_vias(arm, {}, kHz, 0, motion);
    std::optional<double> stood;  // where
    for (std::int64_t step = 0; step < motion.trajectory.steps(); ++step) {
      const JointState now = evaluate(motion.trajectory, static_cast<double>(step), kHz);
      const double turned = std::abs(now.position[6] - arm.home()[6]);
      if (now.velocity.norm() < 1e-3 && turned > 0.1 && turned < turn - 0.1) stood = turned;
    }
    CHECK(stood.has_value() == (turn > 2));
    if (stood) CHECK(*stood == Approx(turn / 2).margin(0.3));
  }
}
