// The arm follows its reference, obeys stiffness and torque limits, and survives stiff contact.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

namespace {

const auto kKinds = {ControllerKind::joint_position, ControllerKind::joint_impedance,
                     ControllerKind::cartesian_impedance};

double greatest_speed(const World& world) { return world.arm_velocity().cwiseAbs().maxCoeff(); }

}  // namespace

TEST_CASE("a free arm follows a fast path in every controller", "[sim]") {
  for (const ControllerKind kind : kKinds) {
    CAPTURE(to_string(kind));
    World world(shared(table_scene(0)));
    world.apply(operation::Controller{kind, 0});
    JointVector q = world.arm().home();
    q += (JointVector(7) << 0.8, 0.3, -0.4, 0.5, 0.6, -0.5, 0.8).finished();
    const JointVector zero = JointVector::Zero(7);
    world.apply(operation::Follow{{{{0, world.arm().home(), zero, zero}, {240, q, zero, zero}}}});
    CHECK(world.following());
    double worst = 0;
    for (int i = 0; i < 240; ++i) {
      world.step();
      worst = std::max(worst, (world.arm_position() - world.reference().position).cwiseAbs().maxCoeff());
    }
    CHECK_FALSE(world.following());
    CHECK(worst < 0.02);
    run(world, 1);
    CHECK((world.world_from_tip().translation() - world.arm().world_from_tip(q).translation()).norm() < 5e-4);
    CHECK(greatest_speed(world) < 1e-3);
  }
}

TEST_CASE("gravity compensation holds the arm without error, and its torques are the statics", "[sim]") {
  World world(shared(table_scene(0)));
  world.apply(operation::Controller{ControllerKind::joint_impedance, 50});
  run(world, 2);
  CHECK((world.arm_position() - world.arm().home()).cwiseAbs().maxCoeff() < 1e-5);
  // The work of gravity on all moving masses, by finite differences of potential energy.
  const Robot& robot = world.scene().robot;
  const auto energy = [&](const JointVector& q) {
    std::vector<double> positions(robot.body.parts.size(), 0.0);
    for (std::size_t j = 0; j < robot.arm.size(); ++j)
      positions[static_cast<std::size_t>(robot.arm[j])] = q[static_cast<Eigen::Index>(j)];
    for (const int finger : robot.fingers) positions[static_cast<std::size_t>(finger)] = 0.04;
    std::vector<Transform> poses;
    forward_kinematics(robot.body, robot.body.world_from_body, positions, poses);
    double sum = 0;
    for (std::size_t p = 0; p < poses.size(); ++p)
      sum += 9.81 * robot.body.parts[p].mass * (poses[p] * robot.body.parts[p].centre_of_mass).z();
    return sum;
  };
  for (Eigen::Index j = 0; j < 7; ++j) {
    JointVector up = world.arm_position(), down = up;
    up[j] += 1e-4;
    down[j] -= 1e-4;
    const double torque = (energy(up) - energy(down)) / 2e-4;
    CHECK(world.joint_effort({-1, robot.arm[static_cast<std::size_t>(j)]}) == Approx(torque).margin(0.02));
  }
}

TEST_CASE("Cartesian stiffness: a displaced reference against a wall presses with k times the error", "[sim]") {
  Scene scene = table_scene(0);
  World world(shared(scene));
  grip(world, 0);
  move_to(world, solve(world, tip_down(0.5, 0, 0.05), world.arm().home()), 2);
  world.apply(operation::Controller{ControllerKind::cartesian_impedance, 800});
  move_line(world, tip_down(0.5, 0, -0.02), 1);
  run(world, 1);
  const double depth = world.world_from_tip().translation().z() + 0.02;  // what the table denies
  double force = 0;
  for (const Contact& contact : world.contacts())
    if (contact.a.body == -1 && contact.b.body == 0) force += contact.force.z();
  CHECK(depth > 0.008);
  CHECK(force == Approx(800 * depth).epsilon(0.15));  // the posture spring and finger friction take the rest
  CHECK(greatest_speed(world) < 0.01);
}

TEST_CASE("torques never exceed the joints' limits", "[sim]") {
  for (const ControllerKind kind : kKinds) {
    World world(shared(table_scene(0)));
    world.apply(operation::Controller{kind, kind == ControllerKind::joint_position ? 0.0 : 20000.0});
    const JointVector q = world.arm().home() + 1.5 * JointVector::Unit(7, 0);
    world.apply(operation::Setpoint{q, JointVector::Zero(7)});  // a jump
    for (int i = 0; i < 480; ++i) {
      world.step();
      for (std::size_t j = 0; j < 7; ++j)
        REQUIRE(std::abs(world.joint_effort({-1, world.scene().robot.arm[j]})) <=
                world.scene().robot.limits[j].effort * (1 + 1e-9));
    }
    CHECK(greatest_speed(world) < 0.5);
  }
}

TEST_CASE("stiff contact does not blow up: pressing a held peg on the rim of a hole and into it", "[sim]") {
  const double error = GENERATE(0.0, 0.001, 0.008);
  for (const ControllerKind kind : {ControllerKind::joint_impedance, ControllerKind::cartesian_impedance}) {
    CAPTURE(to_string(kind), error);
    Scene scene = table_scene(0);
    add_body(scene, box_body("wall1", {0.1, 0.04, 0.03}, {0.5, 0.231, 0.015}, 0));
    add_body(scene, box_body("wall2", {0.1, 0.04, 0.03}, {0.5, 0.169, 0.015}, 0));
    add_body(scene, box_body("wall3", {0.04, 0.022, 0.03}, {0.531, 0.2, 0.015}, 0));
    add_body(scene, box_body("wall4", {0.04, 0.022, 0.03}, {0.469, 0.2, 0.015}, 0));
    add_body(scene, box_body("peg", {0.02, 0.02, 0.08}, {0.5, -0.2, 0.04}, 0.1));
    World world(shared(scene));
    const PartRef peg{body_index(world, "peg"), 0};
    move_to(world, solve(world, tip_down(0.5, -0.2, 0.15), world.arm().home()), 2);
    move_line(world, tip_down(0.5, -0.2, 0.06), 1);
    grip(world, 0, 40);
    REQUIRE(world.grasped() == peg);
    move_line(world, tip_down(0.5, -0.2, 0.15), 1);
    move_line(world, tip_down(0.5, 0.2 + error, 0.15), 1.5);
    world.apply(operation::Controller{kind, kind == ControllerKind::joint_impedance ? 300.0 : 600.0});
    move_line(world, tip_down(0.5, 0.2 + error, 0.05), 2);  // 10 mm beyond the bottom
    double fastest = 0;
    for (int i = 0; i < 480; ++i) {
      world.step();
      fastest = std::max(fastest, greatest_speed(world));
      if (world.step_count() % 12 == 0) world.close_window();
    }
    CHECK(fastest < 0.25);  // as it slips off the rim
    CHECK(world.grasped() == peg);
    const double bottom = world.world_from_part(peg).translation().z() - 0.04;
    CAPTURE(bottom);
    if (error <= 0.001 && kind == ControllerKind::cartesian_impedance) CHECK(bottom < 0.003);
    if (error > 0.005) CHECK(bottom > 0.02);  // it stands on the rim
  }
}

TEST_CASE("a reference of the wrong length is refused", "[sim]") {
  World world(shared(table_scene(0)));
  CHECK_THROWS_AS(world.apply(operation::Setpoint{JointVector::Zero(6), JointVector::Zero(7)}), Error);
  CHECK_THROWS_AS(world.apply(operation::Follow{}), Error);
  CHECK(world.log().empty());
}
