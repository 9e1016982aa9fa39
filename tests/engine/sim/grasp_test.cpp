// Objects are held by friction between pads and object, through lift, shake and hold.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

namespace {

constexpr double kPi = std::numbers::pi;

// Takes cube1 of table_scene from above.
void pick(World& world, double height) {
  const Vector3 cube = world.world_from_part({body_index(world, "cube1"), 0}).translation();
  move_to(world, solve(world, tip_down(cube.x(), cube.y(), cube.z() + 0.1), world.arm().home()), 2);
  move_line(world, tip_down(cube.x(), cube.y(), cube.z()), 1);
  grip(world, 0);
  move_line(world, tip_down(cube.x(), cube.y(), cube.z() + height), 1);
}

// 3 cm at 3 Hz along each axis, and a twist of the wrist.
void shake(World& world, double seconds) {
  const Transform start = world.arm().world_from_tip(world.reference().position);
  JointVector q = world.reference().position, last = q;
  const auto steps = static_cast<int>(seconds / world.dt());
  for (int i = 1; i <= steps; ++i) {
    const double t = i * world.dt(), fade = std::min({1.0, t / 0.3, (seconds - t) / 0.3});
    const double swing = 0.015 * fade * std::sin(2 * kPi * 3 * t);
    const Vector3 offset(swing, 0.015 * fade * std::sin(2 * kPi * 3 * t + 1) - 0.015 * fade * std::sin(1.0), swing);
    Transform target = start * rotation_rpy(0, 0, 0.2 * fade * std::sin(2 * kPi * t));
    target.translation() += offset;
    q = solve(world, target, q);
    world.apply(operation::Setpoint{q, (q - last) / world.dt()});
    last = q;
    world.step();
    if (world.step_count() % 12 == 0) world.close_window();
  }
  world.apply(operation::Setpoint{q, JointVector::Zero(q.size())});
}

}  // namespace

TEST_CASE("a held cube survives lift, shake and a 10 s hold with less than 2 mm of slip", "[sim]") {
  const auto kind =
      GENERATE(ControllerKind::joint_position, ControllerKind::joint_impedance, ControllerKind::cartesian_impedance);
  CAPTURE(to_string(kind));
  World world(shared(table_scene(1)));
  world.apply(operation::Controller{kind, 0});
  const int cube = body_index(world, "cube1");
  pick(world, 0.2);
  REQUIRE(world.grasped() == PartRef{cube, 0});
  CHECK(world.opening() == Approx(0.04).margin(0.001));
  const auto in_hand = [&] { return Transform(world.world_from_tip().inverse() * world.world_from_part({cube, 0})); };
  const Transform before = in_hand();
  shake(world, 2);
  run(world, 10);
  const Transform after = in_hand();
  REQUIRE(world.grasped() == PartRef{cube, 0});
  const double slip = (after.translation() - before.translation()).norm();
  const double turn = Eigen::AngleAxisd(before.linear().transpose() * after.linear()).angle();
  CAPTURE(slip * 1000, turn);
  CHECK(slip < 0.002);
  CHECK(turn < 0.05);
  CHECK(world.world_from_part({cube, 0}).translation().z() > 0.2);

  // At rest the pads together carry the weight, and each presses with the commanded force.
  Vector3 force = Vector3::Zero();
  for (const Contact& contact : world.contacts())
    if (contact.b == PartRef{cube, 0}) {
      force -= contact.force;
      CHECK(contact.mean_force == Approx(20).epsilon(0.1));
    }
  CHECK(force.z() == Approx(0.981).epsilon(0.03));
  CHECK(force.head<2>().norm() < 0.1);
}

TEST_CASE("light things stay in the middle of the hand where contact has to be found anew", "[sim]") {
  Scene scene = table_scene(1);
  for (Body& body : scene.bodies)
    if (body.name == "cube1") set_uniform_mass(body.parts[0], 0.012);
  World world(shared(std::move(scene)));
  const int cube = body_index(world, "cube1");
  const Vector3 at = world.world_from_part({cube, 0}).translation();
  move_to(world, solve(world, tip_down(at.x(), at.y(), at.z() + 0.1), world.arm().home()), 2);
  move_line(world, tip_down(at.x(), at.y(), at.z()), 1);
  grip(world, 0, 10);
  move_line(world, tip_down(at.x(), at.y(), at.z() + 0.2, 0.5), 1);
  const std::vector<int>& fingers = world.scene().robot.fingers;
  for (int boundary = 0; boundary < 4; ++boundary) {
    world.apply(operation::Boundary{});
    move_line(world, tip_down(at.x(), at.y() + 0.05 * boundary, at.z() + 0.2, 0.5 + 0.3 * boundary), 0.6);
    REQUIRE(world.grasped() == PartRef{cube, 0});
    CHECK(std::abs(world.joint_position({-1, fingers[0]}) - world.joint_position({-1, fingers[1]})) < 4e-4);
    CHECK(world.opening() == Approx(0.04).margin(2e-4));
  }
}

TEST_CASE("what the hand holds stays as it is where contact has to be found anew", "[sim]") {
  Scene scene = table_scene(0);
  Body stick = box_body("stick", {0.045, 0.02, 0.012}, {0.4, 0.1, 0.006}, 0.02);
  Shape plug = box_shape({0.014, 0.0125, 0.0048}, {0.0295, 0, 0});  // two pieces, as the pads' links have
  stick.parts[0].shapes.push_back(plug);
  set_uniform_mass(stick.parts[0], 0.02);
  add_body(scene, stick);
  World world(shared(std::move(scene)));
  const PartRef held{body_index(world, "stick"), 0};
  const Vector3 at = world.world_from_part(held).translation() + Vector3(-0.01, 0, 0.005);
  move_to(world, solve(world, tip_down(at.x(), at.y(), at.z() + 0.1), world.arm().home()), 2);
  move_line(world, tip_down(at.x(), at.y(), at.z()), 1);
  grip(world, 0, 12);
  move_line(world, tip_down(at.x(), at.y(), at.z() + 0.2), 1);
  run(world, 0.5);
  REQUIRE(world.grasped() == held);
  const auto in_hand = [&] { return Transform(world.world_from_tip().inverse() * world.world_from_part(held)); };
  const Transform before = in_hand();
  for (int boundary = 0; boundary < 4; ++boundary) {
    world.apply(operation::Boundary{});
    if (boundary == 3) {
      world.apply(operation::Boundary{});  // twice in one step
      world.restore(world.snapshot());
    }
    run(world, 0.05);
    const Transform after = in_hand();
    CAPTURE(boundary);
    CHECK((after.translation() - before.translation()).norm() < 2e-5);
    CHECK(Eigen::AngleAxisd(before.linear().transpose() * after.linear()).angle() < 2e-4);
  }
}

TEST_CASE("a turning hand presses along its own closing axis, and lets go when it opens", "[sim]") {
  World world(shared(table_scene(1)));
  const int cube = body_index(world, "cube1");
  pick(world, 0.25);
  const Vector3 above = world.world_from_part({cube, 0}).translation();
  const Vector3 closing_before = world.world_from_tip().linear().col(1);
  move_line(world, tip_down(above.x(), above.y(), above.z(), 1.0) * rotation_rpy(0, 0.4, 0), 1.5);
  run(world, 0.2);
  const Vector3 closing = world.world_from_tip().linear().col(1);
  REQUIRE(closing.dot(closing_before) < 0.7);
  REQUIRE(world.grasped() == PartRef{cube, 0});
  for (const Contact& contact : world.contacts())
    if (contact.b == PartRef{cube, 0}) CHECK(std::abs(contact.normal.dot(closing)) > 0.999);

  const auto falling = [&] { return -world.linear_velocity({cube, 0}).z(); };
  world.apply(operation::Hand{0.08, 20});
  run(world, 0.05);  // in which the pads let go
  CHECK_FALSE(world.grasped());
  const double before = falling();
  run(world, 0.15);
  CHECK(falling() - before == Approx(9.81 * 0.15).epsilon(0.01));  // nothing holds it back
}

TEST_CASE("a hand that closes on nothing holds nothing", "[sim]") {
  World world(shared(table_scene(0)));
  grip(world, 0);
  CHECK_FALSE(world.grasped());
  CHECK(world.opening() == Approx(0).margin(1e-4));
  grip(world, 0.08, 20, 1);
  CHECK(world.opening() == Approx(0.08).margin(1e-3));
}

TEST_CASE("a drawer pulled by its handle opens, and pushed it closes", "[sim]") {
  Scene scene = table_scene(0);
  add_body(scene, chest({0.72, 0, 0.4}));
  add_body(scene, box_body("toy", Vector3::Constant(0.04), {0.72, 0, 0.4 + 0.07 - 0.04 + 0.0205}, 0.1));
  World world(shared(scene));
  const PartRef drawer{body_index(world, "chest"), 1};
  const PartRef toy{body_index(world, "toy"), 0};
  const Vector3 handle(0.72 - 0.155, 0, 0.47);
  // Forward and 30 degrees down; the bar lies along y, so the hand closes across it.
  const Transform grasp = translation(handle) * rotation_rpy(0, kPi / 2 + kPi / 6, 0) * rotation_rpy(0, 0, kPi / 2);
  const Transform before = grasp * translation(0, 0, -0.08);
  move_to(world, solve(world, before, world.arm().home()), 2);
  move_line(world, grasp, 1);
  grip(world, 0);
  REQUIRE(world.grasped() == drawer);
  const Vector3 toy_in_drawer = world.world_from_part(toy).translation() - world.world_from_part(drawer).translation();
  move_line(world, translation(-0.15, 0, 0) * grasp, 3);
  CHECK(world.joint_position(drawer) == Approx(0.15).margin(0.003));
  CHECK(
      (world.world_from_part(toy).translation() - world.world_from_part(drawer).translation() - toy_in_drawer).norm() <
      0.005);
  move_line(world, grasp, 3);
  CHECK(world.joint_position(drawer) == Approx(0).margin(0.003));
}
