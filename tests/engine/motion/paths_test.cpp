#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "engine/base/error.h"
#include "tests/engine/motion/cluttered.h"

using namespace stampede;

namespace {

bool same(const Trajectory& a, const Trajectory& b) {
  if (a.knots.size() != b.knots.size()) return false;
  for (std::size_t i = 0; i < a.knots.size(); ++i)
    if (a.knots[i].step != b.knots[i].step || a.knots[i].position != b.knots[i].position ||
        a.knots[i].velocity != b.knots[i].velocity || a.knots[i].acceleration != b.knots[i].acceleration)
      return false;
  return true;
}

struct Query {
  JointVector start, goal;
};

Query query(const CollisionState& state, std::int64_t number) {
  Random random(RandomKey("query").with(number));
  const JointVector start = random_free(state, random);
  return {start, random_free(state, random)};
}

PlannedMotion ask(const CollisionState& state, std::int64_t number) {
  const Query q = query(state, number);
  return plan_joints({state, q.start, {}, RandomKey("test").with(number)}, q.goal);
}

}  // namespace

TEST_CASE("every planned motion is free of contact at four times the certified density") {
  const World world(cluttered_scene());
  const CollisionState state = world.collision_state();
  int solved = 0;
  for (int k = 0; k < 40; ++k) {
    const Query q = query(state, k);
    const PlannedMotion motion = ask(state, k);
    if (motion.reason != Reason::none) {
      CHECK_FALSE(motion.detail.empty());
      CHECK(motion.trajectory.knots.empty());
      continue;
    }
    ++solved;
    CHECK(motion.trajectory.knots.front().position == q.start);
    CHECK(motion.trajectory.knots.back().position == q.goal);
    CHECK(touches(state, motion.trajectory, world.scene().physics_hz, 0.0025) == 0);
  }
  CHECK(solved >= 38);
}

TEST_CASE("paths are certified, keep the ends, and stay within the joint limits") {
  const World world(cluttered_scene());
  const CollisionState state = world.collision_state();
  for (int k = 100; k < 110; ++k) {
    const Query q = query(state, k);
    const JointPath path = plan_path({state, q.start, {}, RandomKey("test").with(k)}, q.goal);
    if (path.reason != Reason::none) {
      CHECK(path.waypoints.empty());
      continue;
    }
    CHECK(path.waypoints.front() == q.start);
    CHECK(path.waypoints.back() == q.goal);
    for (const JointVector& waypoint : path.waypoints) CHECK(state.arm().within_limits(waypoint));
    for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
      const JointVector step = path.waypoints[i] - path.waypoints[i - 1];
      const int count = 1 + static_cast<int>(step.cwiseAbs().maxCoeff() / 0.0025);
      for (int s = 0; s <= count; ++s)
        REQUIRE(state.free(path.waypoints[i - 1] + (static_cast<double>(s) / count) * step));
    }
  }
}

TEST_CASE("a query has one answer: alone, after others, beside a busy thread") {
  const World world(cluttered_scene());
  const CollisionState state = world.collision_state();
  const PlannedMotion alone = ask(state, 7);
  REQUIRE(alone.reason == Reason::none);
  REQUIRE(alone.trajectory.knots.size() > 2);

  MotionLimits quick;
  quick.iterations = 20;  // a thousand queries that draw from everything there is to draw from
  quick.rounds = 0;
  for (int k = 0; k < 1000; ++k) {
    const Query q = query(state, 1000 + k % 10);
    plan_path({state, q.start, quick, RandomKey("other").with(k)}, q.goal);
  }
  CHECK(same(alone.trajectory, ask(state, 7).trajectory));

  std::atomic<bool> stop{false};
  std::thread busy([&stop] {
    const World other(cluttered_scene());
    const CollisionState other_state = other.collision_state();
    for (int k = 0; !stop; ++k) ask(other_state, 20 + k % 5);
  });
  CHECK(same(alone.trajectory, ask(state, 7).trajectory));
  CHECK(same(alone.trajectory, ask(state, 7).trajectory));
  stop = true;
  busy.join();
  const auto fresh = World(cluttered_scene()).collision_state();
  CHECK(same(alone.trajectory, ask(fresh, 7).trajectory));
}

TEST_CASE("no path is a result that says why") {
  const World world(cluttered_scene());
  const CollisionState state = world.collision_state();
  const JointVector home = state.arm().home();
  JointVector into_table = home;
  into_table[1] = 1.2;  // the arm leans far forward, its hand below the table's top
  into_table[3] = -1.0;
  REQUIRE_FALSE(state.free(into_table));

  const PlannedMotion from = plan_joints({state, into_table, {}, RandomKey("a")}, home);
  CHECK(from.reason == Reason::start_in_collision);
  CHECK(from.detail.find(" touches ") != std::string::npos);
  CHECK(from.trajectory.knots.empty());

  const PlannedMotion to = plan_joints({state, home, {}, RandomKey("a")}, into_table);
  CHECK(to.reason == Reason::no_path);
  CHECK(to.detail.find(" touches ") != std::string::npos);

  MotionLimits none;
  none.iterations = 1;
  int unsolved = 0;
  for (int k = 0; k < 20; ++k) {
    const Query q = query(state, k);
    const JointPath path = plan_path({state, q.start, none, RandomKey("b").with(k)}, q.goal);
    if (path.reason == Reason::none) continue;
    CHECK(path.reason == Reason::no_path);
    CHECK(path.detail.find("1 tree") != std::string::npos);
    ++unsolved;
  }
  CHECK(unsolved > 0);
}

TEST_CASE("planning leaves no padding behind") {
  const World world(cluttered_scene());
  const CollisionState state = world.collision_state();
  const auto fresh = world.collision_state();
  ask(state, 3);
  Random random(RandomKey("padding"));
  for (int k = 0; k < 2000; ++k) {
    JointVector q(7);
    for (Eigen::Index i = 0; i < 7; ++i) {
      const JointLimits& limit = state.arm().limits()[static_cast<std::size_t>(i)];
      q[i] = random.between(limit.lower, limit.upper);
    }
    REQUIRE(state.free(q) == fresh.free(q));
  }
}

TEST_CASE("joints that are not numbers are refused") {
  const World world(cluttered_scene());
  const CollisionState state = world.collision_state();
  JointVector bad = state.arm().home();
  bad[2] = std::nan("");
  CHECK_THROWS_AS(plan_joints({state, state.arm().home(), {}, RandomKey("a")}, bad), Error);
  CHECK_THROWS_AS(plan_path({state, JointVector::Zero(3), {}, RandomKey("a")}, bad), Error);
}

TEST_CASE("an arm that a line left folded into itself is turned clear first, and then goes its way") {
  const World world(cluttered_scene());
  const CollisionState state = world.collision_state();
  Random random(RandomKey("folded"));
  int folded = 0, solved = 0;
  for (int k = 0; folded < 12 && k < 4000; ++k) {
    const JointVector from = random_free(state, random), to = random_free(state, random);
    JointVector q = from;
    for (double way = 0; state.free(q) && way < 1; way += 0.005) q = from + way * (to - from);
    const auto contacts = state.contacts(q);
    const bool itself = std::all_of(contacts.begin(), contacts.end(), [](const CollisionPair& pair) {
      return pair.robot_part.body < 0 && pair.other.body < 0;
    });
    if (contacts.empty() || !itself) continue;
    ++folded;
    const PlannedMotion motion = plan_joints({state, q, {}, RandomKey("out").with(k)}, from);
    if (motion.reason != Reason::none) continue;
    ++solved;
    CHECK(motion.trajectory.knots.front().position == q);
    CHECK(motion.trajectory.knots.back().position == from);
    bool out = false;  // once clear it stays so
    for (std::int64_t step = 0; step <= motion.trajectory.steps(); ++step) {
      const bool free = state.free(evaluate(motion.trajectory, static_cast<double>(step), kHz).position);
      REQUIRE((free || !out));
      out = out || free;
    }
  }
  CHECK(folded == 12);
  CHECK(solved >= 11);
}
