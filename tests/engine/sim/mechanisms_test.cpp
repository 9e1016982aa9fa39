// Joints of furniture: springs, friction, damping, detents, latches, limits.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

// A slider along x that gravity, tilted by the test, pulls along its axis.
Body sled(double friction, double damping) {
  Body body = box_body("sled", {0.1, 0.1, 0.1}, {0.8, 0, 1}, 0);
  Part part;
  part.name = "slide";
  part.parent = 0;
  part.joint.name = "slide";
  part.joint.kind = JointKind::slider;
  part.joint.axis = {1, 0, 0};
  part.joint.lower = -1;
  part.joint.upper = 5;
  part.joint.friction = friction;
  part.joint.damping = damping;
  part.shapes.push_back(box_shape({0.1, 0.1, 0.1}));
  set_uniform_mass(part, 2.0);
  body.parts.push_back(part);
  return body;
}

}  // namespace

// Made stable by dividing by 1 + dt d / m, which lets a very strongly damped joint run faster by that factor.
TEST_CASE("damping: a pulled sled reaches the speed force over damping, and never swings", "[sim]") {
  for (const double damping : {5.0, 5000.0}) {  // an explicit torque would diverge with the second
    Scene scene = table_scene(0);
    add_body(scene, sled(0, damping));
    scene.gravity = {2.5, 0, 0};  // 5 N on 2 kg
    World world(shared(scene));
    const PartRef part{body_index(world, "sled"), 1};
    const double time = 0.8;
    run(world, time);
    const double final_speed = 5 / damping * (1 + world.dt() * damping / 2);
    CHECK(world.joint_velocity(part) == Approx(final_speed * (1 - std::exp(-damping / 2 * time))).epsilon(0.01));
  }
}

TEST_CASE("friction holds below its limit and leaves the rest above it", "[sim]") {
  for (const double friction : {6.0, 3.0}) {
    Scene scene = table_scene(0);
    add_body(scene, sled(friction, 0));
    scene.gravity = {2.5, 0, 0};
    World world(shared(scene));
    const PartRef part{body_index(world, "sled"), 1};
    run(world, 0.5);
    const double expected = friction > 5 ? 0 : (5 - friction) / 2 * 0.5;
    CHECK(world.joint_velocity(part) == Approx(expected).margin(1e-3));
    CHECK(world.joint_effort(part) == Approx(-std::min(friction, 5.0)).epsilon(0.01));
  }
}

TEST_CASE("a pressed button sinks, counts and returns", "[sim]") {
  Scene scene = table_scene(0);
  add_body(scene, button({0.5, 0, 0.01}));
  World world(shared(scene));
  const PartRef cap{body_index(world, "button"), 1};
  grip(world, 0);
  run(world, 0.5);
  CHECK(world.joint_position(cap) == Approx(0).margin(1e-4));
  move_to(world, solve(world, tip_down(0.5, 0, 0.08), world.arm().home()), 1);
  for (int press = 0; press < 2; ++press) {
    move_line(world, tip_down(0.5, 0, 0.05), 0.5);
    const double tip_above_fingers = 0.0104;  // the finger boxes end 9 mm below the tool point
    move_line(world, tip_down(0.5, 0, 0.04 - 0.004 + tip_above_fingers - 0.001), 0.5);
    CHECK(world.joint_position(cap) > 0.0035);
    move_line(world, tip_down(0.5, 0, 0.08), 0.5);
    CHECK(world.joint_position(cap) == Approx(0).margin(1e-4));
    CHECK(std::abs(world.joint_velocity(cap)) < 1e-3);
  }
}

TEST_CASE("a button pressed against its stop by a yielding arm stays there", "[sim]") {
  Scene scene = table_scene(0);
  add_body(scene, button({0.5, 0, 0.01}));
  World world(shared(scene));
  const PartRef cap{body_index(world, "button"), 1};
  const double stop = world.scene().bodies[static_cast<std::size_t>(cap.body)].parts[1].joint.upper;
  grip(world, 0);
  move_to(world, solve(world, tip_down(0.5, 0, 0.08), world.arm().home()), 1);
  world.apply(operation::Controller{ControllerKind::cartesian_impedance, 1500});
  move_line(world, tip_down(0.5, 0, 0.04 - stop - 0.010 + 0.0104), 0.5);  // 1 cm too far: 15 N
  for (int step = 0; step < 240; ++step) {
    world.step();
    REQUIRE(world.joint_position(cap) < stop + 0.0005);
  }
  CHECK(world.joint_position(cap) > stop - 0.0005);
}

TEST_CASE("a latch holds until its lever is pressed, and catches again", "[sim]") {
  // The lever and the leaf are moved by gravity, which the scene turns: no hand is needed.
  Scene scene = table_scene(0);
  add_body(scene, latched_door({0.9, -0.5, 0.5}));
  scene.bodies[1].parts[2].joint.spring_force = 0.001;
  scene.gravity = {4, 0, 0};  // pulls the leaf open with 1.5 kg * 4 m/s^2 * 0.16 m = 0.96 N m, leaves the lever
  {
    World world(shared(scene));
    const PartRef leaf{body_index(world, "door"), 1};
    REQUIRE(world.latched(leaf));
    run(world, 1);
    CHECK(world.latched(leaf));
    CHECK(std::abs(world.joint_position(leaf)) < 0.01 * kDegree);
  }
  scene.gravity = {4, 0, -9.81};  // the lever, hinged about x with its bar along +y, falls
  World world(shared(scene));
  const PartRef leaf{body_index(world, "door"), 1}, lever{body_index(world, "door"), 2};
  run(world, 2);
  CHECK(world.joint_position(lever) < -30 * kDegree);
  CHECK_FALSE(world.latched(leaf));
  CHECK(std::abs(world.joint_position(leaf)) > 10 * kDegree);
}

TEST_CASE("a latch catches when the door is shut and the lever is back", "[sim]") {
  Scene scene = table_scene(0);
  add_body(scene, latched_door({0.9, -0.5, 0.5}));
  scene.bodies[1].parts[1].joint.initial = 0.6;
  scene.gravity = {-4, 0, 0};  // pushes the leaf shut; the lever's spring holds it up
  World world(shared(scene));
  const PartRef leaf{body_index(world, "door"), 1};
  CHECK_FALSE(world.latched(leaf));
  run(world, 3);
  CHECK(world.latched(leaf));
  CHECK(world.joint_position(leaf) == Approx(0).margin(0.1 * kDegree));
}

TEST_CASE("a rocker rests at the limit it is nearer to", "[sim]") {
  for (const double initial : {-0.05, 0.05}) {
    Scene scene = table_scene(0);
    Body rocker = box_body("rocker", {0.05, 0.05, 0.02}, {0.5, 0.3, 0.01}, 0);
    Part part;
    part.name = "plate";
    part.parent = 0;
    part.joint.kind = JointKind::hinge;
    part.joint.axis = {0, 1, 0};
    part.joint.parent_from_joint = translation(0, 0, 0.02);
    part.joint.lower = -15 * kDegree;
    part.joint.upper = 15 * kDegree;
    part.joint.initial = initial;
    part.joint.detent = 0.1;
    part.shapes.push_back(box_shape({0.04, 0.03, 0.008}));
    set_uniform_mass(part, 0.02);
    rocker.parts.push_back(part);
    add_body(scene, rocker);
    World world(shared(scene));
    const PartRef plate{body_index(world, "rocker"), 1};
    run(world, 1);
    CHECK(world.joint_position(plate) == Approx(std::copysign(15 * kDegree, initial)).margin(0.05 * kDegree));
    CHECK(std::abs(world.joint_velocity(plate)) < 1e-3);
  }
}

TEST_CASE("parts that are rigidly fixed to each other move as one", "[sim]") {
  Scene scene = table_scene(0);
  Body body = sled(0, 0);
  Part plate;  // a lump of mass without shape, and beyond it a part with one
  plate.name = "plate";
  plate.parent = 1;
  plate.joint.parent_from_joint = translation(0, 0.2, 0) * rotation_rpy(0.3, 0.2, 0.1);
  plate.mass = 1;
  plate.inertia = 0.01 * Matrix3::Identity();
  plate.centre_of_mass = {0.1, 0, 0};
  Part flag;
  flag.name = "flag";
  flag.parent = 2;
  flag.joint.parent_from_joint = translation(0, 0, 0.2);
  flag.shapes.push_back(box_shape({0.02, 0.02, 0.02}));
  set_uniform_mass(flag, 1);
  body.parts.push_back(plate);
  body.parts.push_back(flag);
  add_body(scene, body);
  scene.gravity = {2.5, 0, 0};
  World world(shared(scene));
  const int sled_body = body_index(world, "sled");
  run(world, 0.5);
  std::vector<Transform> expected;
  forward_kinematics(world.scene().bodies[static_cast<std::size_t>(sled_body)], translation(0.8, 0, 1),
                     std::vector<double>{0, world.joint_position({sled_body, 1}), 0, 0}, expected);
  CHECK(world.joint_velocity({sled_body, 1}) == Approx(2.5 * 0.5).epsilon(1e-6));
  for (int part = 0; part < 4; ++part)
    CHECK((world.world_from_part({sled_body, part}).matrix() - expected[static_cast<std::size_t>(part)].matrix())
              .cwiseAbs()
              .maxCoeff() < 1e-12);
  CHECK(world.linear_velocity({sled_body, 3}).x() == Approx(1.25).epsilon(1e-6));
}

TEST_CASE("a coupled needle follows a tray on a spring, and both snapshot exactly", "[sim]") {
  Scene scene = table_scene(0);
  Body scales = box_body("scales", {0.2, 0.2, 0.04}, {0.9, 0.3, 0.02}, 0);
  Part tray = moving_part("tray", JointKind::slider, {0, 0, -1}, {0, 0, 0.05}, 0, 0.02);
  tray.shapes.push_back(box_shape({0.16, 0.16, 0.01}));
  set_uniform_mass(tray, 0.1);
  tray.joint.friction = 0;
  tray.joint.damping = 4;
  tray.joint.stiffness = 500;
  Part needle = moving_part("needle", JointKind::hinge, {1, 0, 0}, {-0.11, 0, 0.02}, 0, 2.5);
  needle.shapes.push_back(box_shape({0.002, 0.04, 0.002}, {0, 0.02, 0}));
  set_uniform_mass(needle, 0.001);
  needle.joint.friction = needle.joint.damping = 0;
  needle.joint.follows = "tray";
  needle.joint.follow_ratio = 120;
  scales.parts.push_back(tray);
  scales.parts.push_back(needle);
  add_body(scene, std::move(scales));
  Body load = box_body("load", {0.05, 0.05, 0.05}, {0.9, 0.3, 0.10}, 0.3);
  add_body(scene, std::move(load));
  World world(shared(scene));
  const int body = body_index(world, "scales");
  run(world, 2);
  const double sunk = (0.1 + 0.3) * 9.81 / 500;
  CHECK(world.joint_position({body, 1}) == Approx(sunk).epsilon(0.03));
  CHECK(world.joint_position({body, 2}) == Approx(120 * world.joint_position({body, 1})).margin(0.02));

  world.apply(operation::Boundary{});
  const Snapshot snapshot = world.snapshot();
  world.apply(operation::Place{body_index(world, "load"), translation({0.5, 0.3, 0.2})});
  run(world, 1);
  const std::string end = world.state_hash();
  CHECK(world.joint_position({body, 2}) < 0.4);
  world.restore(snapshot);
  world.apply(operation::Place{body_index(world, "load"), translation({0.5, 0.3, 0.2})});
  run(world, 1);
  CHECK(world.state_hash() == end);
}

TEST_CASE("a rack comes out with its door, and a rack that is held back holds the door", "[sim]") {
  for (const bool blocked : {false, true}) {
    Scene scene = table_scene(0);
    Body oven = box_body("oven", {0.02, 0.3, 0.2}, {0.9, 0.3, 0.4}, 0);
    Part door = moving_part("door", JointKind::hinge, {0, -1, 0}, {-0.02, 0, -0.1}, 0, 1.5);
    door.shapes.push_back(box_shape({0.02, 0.3, 0.2}, {0, 0, 0.1}));
    set_uniform_mass(door, 1);
    door.joint.initial = 0.2;  // it falls open from here
    door.joint.damping = 0.3;
    Part rack = moving_part("rack", JointKind::slider, {-1, 0, 0}, {0.25, 0, 0.15}, 0, 0.2);
    rack.shapes.push_back(box_shape({0.1, 0.1, 0.01}));
    set_uniform_mass(rack, 0.3);
    rack.joint.initial = 0.02;
    rack.joint.follows = "door";
    rack.joint.follow_ratio = 0.1;
    oven.parts.push_back(door);
    oven.parts.push_back(rack);
    add_body(scene, std::move(oven));
    if (blocked) add_body(scene, box_body("post", {0.02, 0.1, 0.1}, {1.02, 0.3, 0.55}, 0));
    World world(shared(scene));
    const int body = body_index(world, "oven");
    run(world, 3);
    const double opened = world.joint_position({body, 1});
    CHECK(world.joint_position({body, 2}) == Approx(0.1 * opened).margin(2e-3));
    if (blocked)
      CHECK(opened < 0.9);
    else
      CHECK(opened == Approx(1.5).margin(0.01));
  }
}

TEST_CASE("a coupling or latch that names no other joint, and a spring too stiff for its part, are refused", "[sim]") {
  const auto complaint = [](auto&& change) {
    Scene scene = table_scene(0);
    Body body = latched_door({0.9, -0.5, 0.5});
    change(body.parts[1].joint);
    add_body(scene, std::move(body));
    try {
      World world(shared(scene));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK_THAT(
      complaint([](Joint& joint) { joint.follows = "leaf"; }),
      Catch::Equals(
          "door: the coupling of 'leaf' names no joint 'leaf'\n    name another moving joint of the same object"));
  for (const char* key : {"leaf", "knob"})
    CHECK_THAT(complaint([&](Joint& joint) { joint.latch_key = key; }),
               Catch::Equals("door: the latch of 'leaf' names no joint '" + std::string(key) +
                             "'\n    name another moving joint of the same object"));
  CHECK_THAT(complaint([](Joint& joint) { joint.stiffness = 1e7; }),
             Catch::Contains("stiffness of 'leaf' is too great"));
  CHECK(complaint([](Joint& joint) { joint.follows = "lever"; }).empty());
}
