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
