// Whoever drives the arm: it keeps its limits, meets things slowly, and presses no harder than a hand.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/random.h"
#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;
using operation::Servo;

namespace {

constexpr double kMostForce = 100;  // N, of a stiff arm that is steered, as demonstrations are
constexpr double kStruck = 300;     // N, of one that is driven at random, and of one whose reference jumps
constexpr double kLeaning = 85;     // N, of one that leans on something: mean over a frame
constexpr double kToolSpeed = 1.7;  // m/s

double tool_speed(const World& world) {
  return (world.arm().jacobian(world.arm_position()).topRows<3>() * world.arm_velocity()).norm();
}

// Steps, and the worst of each kind.
struct Watch {
  World& world;
  double force = 0, mean = 0, joint = 0, tool = 0, ahead = 0;
  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      world.step();
      for (Eigen::Index j = 0; j < 7; ++j)
        joint = std::max(
            joint, std::abs(world.arm_velocity()[j]) / world.arm().limits()[static_cast<std::size_t>(j)].velocity);
      tool = std::max(tool, tool_speed(world));
      ahead = std::max(ahead, (world.reference().position - world.arm_position()).cwiseAbs().maxCoeff());
      if (world.step_count() % 12 != 0) continue;
      world.close_window();
      for (const Contact& contact : world.contacts())
        if (contact.a.body == -1) {
          force = std::max(force, contact.peak_force);
          mean = std::max(mean, contact.mean_force);
        }
    }
  }
};

}  // namespace

TEST_CASE("an arm that is sent through the table meets it slowly, presses no harder than a hand, and waits", "[sim]") {
  const auto kind =
      GENERATE(ControllerKind::joint_position, ControllerKind::joint_impedance, ControllerKind::cartesian_impedance);
  CAPTURE(to_string(kind));
  World world(shared(table_scene(0)));
  grip(world, 0);
  move_to(world, solve(world, tip_down(0.5, 0, 0.4), world.arm().home()), 2);
  world.apply(operation::Controller{kind, 0});
  const JointVector through = solve(world, tip_down(0.5, 0, -0.1), world.arm_position());
  Watch watch{world};
  for (int i = 0; i < 60; ++i) {
    world.apply(Servo{Servo::Of::position, through});
    watch.run(12);
  }
  CHECK(watch.force > 3);  // it came there
  if (kind == ControllerKind::joint_position) CHECK(watch.force < kMostForce);
  CHECK(watch.joint < 1.1);
  CHECK(watch.tool > 0.3);  // through the air it was not slow
  CHECK(watch.tool < kToolSpeed);
  CHECK(watch.ahead < 0.11);
  // And back up.
  const double low = world.world_from_tip().translation().z();
  for (int i = 0; i < 60; ++i) {
    world.apply(Servo{Servo::Of::position, solve(world, tip_down(0.5, 0, 0.2), world.arm_position())});
    watch.run(12);
  }
  CHECK(world.world_from_tip().translation().z() > low + 0.05);
  CHECK(watch.joint < 1.1);
}

TEST_CASE("random positions, velocities and torques never whip the arm", "[sim]") {
  const auto of = GENERATE(Servo::Of::position, Servo::Of::velocity, Servo::Of::torque);
  const int seed = GENERATE(range(0, 3));
  CAPTURE(static_cast<int>(of), seed);
  Scene scene = table_scene(2);
  add_body(scene, box_body("pillar", {0.1, 0.1, 0.5}, {0.55, 0.3, 0.25}, 0));
  World world(shared(std::move(scene)));
  Random random(RandomKey("whip").with(static_cast<std::int64_t>(of)).with(seed));
  Watch watch{world};
  for (int i = 0; i < 300; ++i) {
    if (i % 5 == 0) {
      JointVector value(7);
      for (Eigen::Index j = 0; j < 7; ++j) {
        const JointLimits& own = world.arm().limits()[static_cast<std::size_t>(j)];
        value[j] = of == Servo::Of::position   ? random.between(own.lower, own.upper)
                   : of == Servo::Of::velocity ? random.between(-own.velocity, own.velocity)
                                               : random.between(-own.effort, own.effort);
      }
      world.apply(Servo{of, value});
    } else {
      world.apply(Servo{of, std::get<Servo>(world.log().back().operation).value});
    }
    watch.run(12);
  }
  CAPTURE(watch.force, watch.joint, watch.tool, watch.ahead);
  const bool torque = of == Servo::Of::torque;  // which says nothing of where the arm will be
  CHECK(watch.force < (torque ? kStruck : kMostForce));
  CHECK(watch.joint < (torque ? 1.15 : 1.001));  // flung by contact, harder than a wrist's motor holds
  CHECK(watch.tool < kToolSpeed);
  if (of != Servo::Of::torque) CHECK(watch.ahead < 0.11);
}

TEST_CASE("an arm that leans on the table for seconds does not press harder and harder", "[sim]") {
  World world(shared(table_scene(0)));
  Random random(RandomKey("lean"));
  Watch watch{world};
  for (int i = 0; i < 40; ++i) {
    JointVector value(7);
    for (Eigen::Index j = 0; j < 7; ++j) {
      const JointLimits& own = world.arm().limits()[static_cast<std::size_t>(j)];
      value[j] = random.between(own.lower, own.upper);
    }
    value[1] = 1.7;  // towards the table
    for (int k = 0; k < 25; ++k) {
      world.apply(Servo{Servo::Of::position, value});
      watch.run(12);
    }
  }
  CAPTURE(watch.force, watch.mean);
  CHECK(watch.mean > 20);
  CHECK(watch.mean < kLeaning);
  CHECK(watch.force < 1.2 * kMostForce);
}

TEST_CASE("a stiff arm whose reference is set behind a wall presses no harder than a hand, and comes free quietly",
          "[sim]") {
  World world(shared(table_scene(0)));
  grip(world, 0);
  move_to(world, solve(world, tip_down(0.5, 0, 0.03), world.arm().home()), 2);
  const JointVector below = solve(world, tip_down(0.5, 0, -0.15), world.arm_position());
  move_line(world, tip_down(0.5, 0, 0.001), 2);
  world.apply(operation::Setpoint{below, JointVector::Zero(7)});
  Watch watch{world};
  watch.run(240);
  CHECK(watch.force > 20);
  CHECK(watch.force < kStruck);
  world.apply(operation::Setpoint{solve(world, tip_down(0.5, 0, 0.3), world.arm_position()), JointVector::Zero(7)});
  watch.run(480);
  CHECK(watch.joint < 1.01);
  CHECK((world.world_from_tip().translation() - Vector3(0.5, 0, 0.3)).norm() < 1e-3);
  CHECK(world.arm_velocity().cwiseAbs().maxCoeff() < 1e-3);
}

TEST_CASE("an arm that was slowed down by what lies ahead returns to a snapshot bit for bit", "[sim]") {
  World world(shared(table_scene(0)));
  const JointVector through = solve(world, tip_down(0.5, 0, -0.1), world.arm().home());
  world.apply(Servo{Servo::Of::position, through});
  run(world, 0.55);
  world.apply(operation::Boundary{});
  const Snapshot here = world.snapshot();
  run(world, 1);
  const std::string after = world.state_hash();
  world.restore(here);
  run(world, 1);
  CHECK(world.state_hash() == after);
}
