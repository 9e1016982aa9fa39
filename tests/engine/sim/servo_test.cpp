// What an agent asks of the arm, within the arm's limits.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;
using operation::Servo;

namespace {

JointVector constant(double value) { return JointVector::Constant(7, value); }

}  // namespace

TEST_CASE("a servo's reference keeps the limits of speed, acceleration and range, whatever is asked", "[sim]") {
  World world(shared(table_scene(0)));
  const auto& limits = world.arm().limits();
  Random random(RandomKey("servo"));
  JointState before = world.reference();
  for (int i = 0; i < 100; ++i) {
    JointVector value(7);
    const bool position = i % 2 == 0;
    for (double& one : value) one = random.between(-4, 4);
    world.apply(Servo{position ? Servo::Of::position : Servo::Of::velocity, value});
    CHECK(world.steered());
    for (int k = 0; k < 12; ++k) {
      world.step();
      const JointState now = world.reference();
      for (Eigen::Index j = 0; j < 7; ++j) {
        const JointLimits& own = limits[static_cast<std::size_t>(j)];
        CHECK(now.position[j] >= own.lower);
        CHECK(now.position[j] <= own.upper);
        CHECK(std::abs(now.velocity[j]) <= own.velocity + 1e-12);
        CHECK(std::abs(now.velocity[j] - before.velocity[j]) <= own.acceleration * world.dt() + 1e-9);
      }
      before = now;
    }
  }
}

TEST_CASE("the tool keeps its speed limit while the arm turns, however long it is asked to go fast", "[sim]") {
  World world(shared(table_scene(0)));
  Random random(RandomKey("tool speed"));
  const auto kind = GENERATE(Servo::Of::position, Servo::Of::velocity);
  double fastest = 0;
  for (int i = 0; i < 60; ++i) {
    JointVector value(7);
    for (Eigen::Index j = 0; j < 7; ++j) {
      const JointLimits& own = world.arm().limits()[static_cast<std::size_t>(j)];
      value[j] = kind == Servo::Of::position ? random.between(own.lower, own.upper)
                                             : random.between(-own.velocity, own.velocity);
    }
    world.apply(Servo{kind, value});
    const std::int64_t held = 12 * random.below(20);
    for (int k = 0; k < held; ++k) {
      if (k % 12 == 0) world.apply(Servo{kind, value});
      world.step();
      const JointState now = world.reference();
      fastest = std::max(fastest, (world.arm().jacobian(now.position).topRows<3>() * now.velocity).norm());
    }
  }
  CHECK(fastest > 1.5);
  CHECK(fastest < 1.65);  // 1.6 m/s, and what a step adds
}

TEST_CASE("a position is reached without passing it, and a velocity of nothing is rest", "[sim]") {
  World world(shared(table_scene(0)));
  const JointVector goal = world.arm().home() + constant(0.2);
  world.apply(Servo{Servo::Of::position, goal});
  double passed = 0;
  for (int i = 0; i < 240; ++i) {
    world.step();
    passed = std::max(passed, (world.reference().position - goal).maxCoeff());
  }
  CHECK(passed < 1e-9);
  CHECK((world.arm_position() - goal).cwiseAbs().maxCoeff() < 1e-3);
  world.apply(Servo{Servo::Of::velocity, constant(0.3)});
  run(world, 0.3);
  CHECK((world.arm_velocity() - constant(0.3)).cwiseAbs().maxCoeff() < 0.01);
  world.apply(Servo{Servo::Of::velocity, constant(0)});
  run(world, 0.5);
  CHECK(world.arm_velocity().cwiseAbs().maxCoeff() < 1e-3);
}

TEST_CASE("positions that come as an arm may move are passed in time, and one that stays is stopped at", "[sim]") {
  World world(shared(table_scene(0)));
  const JointVector home = world.arm().home();
  const double frame = 1.0 / 20;
  const auto way = [&](double t, double seconds) {  // from rest to rest, 1.2 rad of the last joint
    const double s = std::min(1.0, t / seconds);
    return JointVector(home + constant(1.2 * s * s * s * (10 - 15 * s + 6 * s * s))
                                  .cwiseProduct((JointVector(7) << 0.5, -0.5, 0.5, 0.5, 0.5, -0.5, 1).finished()));
  };
  double passed = 0;
  const auto late = [&](double seconds, Servo::Of of) {
    double most = 0;
    move_to(world, home, 2);
    for (int i = 1; i <= seconds / frame + 20; ++i) {
      world.apply(Servo{of, way(i * frame, seconds)});
      for (int k = 0; k < 12; ++k) {
        world.step();
        passed = std::max(passed, world.reference().position[6] - home[6] - 1.2);
      }
      most = std::max(most, (world.reference().position - way(i * frame, seconds)).cwiseAbs().maxCoeff());
    }
    return most;
  };
  CHECK(late(8, Servo::Of::position) < 1e-3);  // stopping at each, it would be 0.02 rad late
  CHECK(late(2, Servo::Of::position) < 0.1);   // fast, it is late by what it takes to stop
  CHECK(late(2, Servo::Of::passage) < 2e-3);
  CHECK(passed < 1e-3);
  // One that ends at once is hardly passed.
  const JointVector last = way(1, 4);
  move_to(world, home, 2);
  for (int i = 1; i <= 40; ++i) {
    world.apply(Servo{Servo::Of::position, way(std::min(1.0, i * frame), 4)});
    for (int k = 0; k < 12; ++k) {
      world.step();
      passed = std::max(passed, world.reference().position[6] - last[6]);
    }
  }
  CHECK(passed < 0.008);
  CHECK((world.reference().position - last).cwiseAbs().maxCoeff() < 1e-3);
  // A jump is no way: it is gone to and stopped at.
  const JointVector there = last - constant(0.3);
  passed = 0;
  world.apply(Servo{Servo::Of::position, there});
  for (int k = 0; k < 240; ++k) {
    world.step();
    passed = std::max(passed, (there - world.reference().position).maxCoeff());
  }
  CHECK(passed < 1e-9);
}

TEST_CASE("an arm that has to be slow keeps to its way", "[sim]") {
  World world(shared(table_scene(0)));
  grip(world, 0);
  move_to(world, solve(world, tip_down(0.5, 0, 0.004), world.arm().home()), 2);
  const JointVector from = world.arm_position(), to = solve(world, tip_down(0.5, 0, -0.02), from);
  double aside = 0;
  for (int i = 0; i < 8; ++i) {
    world.apply(Servo{Servo::Of::position, to});
    run(world, 0.05);
    const JointVector gone = world.reference().position - from, whole = to - from;
    aside = std::max(aside, (gone - whole * (gone.dot(whole) / whole.squaredNorm())).norm());
  }
  CHECK_THAT(world.limited(), Catch::Matchers::VectorContains(std::string("approach")));
  CHECK(aside < 0.1 * (to - from).norm());
}

TEST_CASE("an arm that brakes for what is ahead stays on the way that it is on", "[sim]") {
  World world(shared(table_scene(0)));
  grip(world, 0);
  const JointVector fast = (JointVector(7) << 0.6, 1.2, 0, 0, 0, 0, 1.5).finished();  // each can brake its own way
  JointVector from;
  double aside = 0;
  bool slowed = false;
  for (int i = 0; i < 240; ++i) {
    world.apply(Servo{Servo::Of::velocity, fast});
    run(world, 0.05);
    const JointState now = world.reference();
    slowed = slowed || now.velocity.norm() < 0.9 * fast.norm();
    if (from.size() == 0 && now.velocity == fast) from = now.position, slowed = false;
    if (from.size() == 0 || !slowed) continue;
    if (now.velocity.norm() < 0.1 * fast.norm()) break;  // what comes then is contact
    const JointVector gone = now.position - from;
    aside = std::max(aside, (gone - fast * (gone.dot(fast) / fast.squaredNorm())).norm());
  }
  CAPTURE(world.world_from_tip().translation().z());
  CHECK(slowed);
  CHECK(from.size() == 7);
  CHECK(aside < 1e-3);
}

TEST_CASE("no torque is weightlessness, any torque keeps joints between their stops, and the arm goes on from there",
          "[sim]") {
  World world(shared(table_scene(0)));
  world.apply(Servo{Servo::Of::torque, constant(0)});
  run(world, 1);
  CHECK((world.arm_position() - world.arm().home()).cwiseAbs().maxCoeff() < 1e-3);
  Random random(RandomKey("torque"));
  for (int i = 0; i < 60; ++i) {
    JointVector torque(7);
    for (Eigen::Index j = 0; j < 7; ++j) {
      const double most = world.arm().limits()[static_cast<std::size_t>(j)].effort;
      torque[j] = random.between(-most, most);
    }
    world.apply(Servo{Servo::Of::torque, torque});
    for (int k = 0; k < 24; ++k) {
      world.step();
      CHECK(world.arm().within_limits(world.arm_position(), -1.1e-3));
      CHECK(world.arm_velocity().allFinite());
    }
  }
  CHECK(world.reference().position == world.arm_position());  // no jump when positions are asked for again
  const JointVector here = world.arm_position();
  world.apply(Servo{Servo::Of::velocity, constant(0)});
  world.step();
  CHECK((world.arm_position() - here).cwiseAbs().maxCoeff() < 0.02);
}

TEST_CASE("a world that is steered returns to a snapshot bit for bit", "[sim]") {
  for (const Servo::Of of : {Servo::Of::position, Servo::Of::velocity, Servo::Of::torque}) {
    World world(shared(table_scene(1)));
    world.apply(Servo{of, constant(0.4)});
    run(world, 0.1);
    world.apply(operation::Boundary{});
    const Snapshot here = world.snapshot();
    run(world, 0.3);
    const std::string after = world.state_hash();
    world.restore(here);
    run(world, 0.3);
    CHECK(world.state_hash() == after);
  }
}

TEST_CASE("a servo needs a finite number a joint", "[sim]") {
  World world(shared(table_scene(0)));
  const std::string before = world.state_hash();
  CHECK_THROWS_AS(world.apply(Servo{Servo::Of::position, JointVector::Zero(6)}), Error);
  CHECK_THROWS_AS(world.apply(Servo{Servo::Of::torque, constant(std::nan(""))}), Error);
  CHECK_FALSE(world.steered());
  CHECK(world.state_hash() == before);
}
