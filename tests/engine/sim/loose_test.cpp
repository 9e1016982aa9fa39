// Free bodies with joints of their own, screws, and joints that let go.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// A box with a button on its top that sinks 3 mm and returns.
Body remote(const Vector3& centre) {
  Body body = box_body("remote", {0.05, 0.16, 0.02}, centre, 0.12);
  Part cap = moving_part("cap", JointKind::slider, {0, 0, -1}, {0, 0, 0.01}, 0, 0.003);
  cap.shapes.push_back(box_shape({0.012, 0.012, 0.008}));
  set_uniform_mass(cap, 0.003);
  cap.joint.spring_force = 1;
  cap.joint.friction = 0.05;
  cap.joint.damping = 0.5;
  body.parts.push_back(cap);
  return body;
}

Joint thread(double pitch) {
  Joint joint;
  joint.name = "thread";
  joint.kind = JointKind::screw;
  joint.axis = {0, 0, -1};
  joint.pitch = pitch;
  joint.lower = 0;
  joint.upper = 5 * kTurn;
  return joint;
}

// A nut that gravity turns down a thread of a steep pitch: on a joint of the post, or a body that is joined to it.
Scene nut_on_post(double pitch, bool joined, double lets_go) {
  Scene scene = table_scene(0);
  Body post = box_body("post", {0.02, 0.02, 0.02}, {0.9, 0.4, 1.4}, 0);
  Part nut;
  nut.name = "nut";
  nut.joint = thread(pitch);
  nut.shapes.push_back(box_shape({0.06, 0.06, 0.02}));
  set_uniform_mass(nut, 0.2);
  if (!joined) {
    nut.parent = 0;
    post.parts.push_back(nut);
    add_body(scene, post);
    return scene;
  }
  Body own;
  own.name = "post.nut";
  own.free = true;
  own.joined_to = "post";
  nut.joint.lets_go = lets_go;
  own.parts.push_back(nut);
  add_body(scene, post);
  add_body(scene, own);
  return scene;
}

PartRef nut_of(const World& world, bool joined) {
  return joined ? PartRef{body_index(world, "post.nut"), 0} : PartRef{body_index(world, "post"), 1};
}

}  // namespace

TEST_CASE("a free body with a button keeps its momentum, whatever the spring does", "[sim]") {
  Scene scene = table_scene(0);
  scene.gravity = Vector3::Zero();
  Body body = remote({0.5, 0, 1.2});
  body.parts[1].joint.initial = 0.003;
  add_body(scene, body);
  World world(shared(scene));
  const int index = body_index(world, "remote");
  const auto centre = [&] {
    return Vector3((0.12 * world.world_from_part({index, 0}).translation() +
                    0.003 * world.world_from_part({index, 1}).translation()) /
                   0.123);
  };
  const Vector3 start = centre();
  run(world, 0.5);
  CHECK(world.joint_position({index, 1}) == Approx(0).margin(1e-4));
  CHECK((centre() - start).norm() < 1e-9);
  CHECK((world.world_from_part({index, 0}).translation() - Vector3(0.5, 0, 1.2)).norm() > 1e-5);  // it did recoil
}

TEST_CASE("a free body with a button falls, comes to rest and sleeps, and its button can be pressed where it lies",
          "[sim]") {
  Scene scene = table_scene(0);
  add_body(scene, remote({0.5, 0, 0.06}));
  World world(shared(scene));
  const int index = body_index(world, "remote");
  grip(world, 0);
  run(world, 1);
  const Transform lying = world.world_from_part({index, 0});
  CHECK(lying.translation().z() == Approx(0.01).margin(5e-4));
  CHECK(world.joint_position({index, 1}) == Approx(0).margin(1e-4));
  const std::string resting = world.state_hash();
  world.step();
  CHECK(world.linear_velocity({index, 0}).norm() < 1e-6);

  move_to(world, solve(world, tip_down(0.5, 0, 0.10), world.arm().home()), 1);
  const double top = 0.01 + 0.01 + 0.004, fingers = 0.0104;  // of the cap; they end so far beyond the tip
  move_line(world, tip_down(0.5, 0, top + fingers + 0.003), 0.5);
  world.apply(operation::Controller{ControllerKind::cartesian_impedance, 1500});
  move_line(world, tip_down(0.5, 0, top + fingers - 0.006), 0.5);
  run(world, 0.2);
  CHECK(world.joint_position({index, 1}) > 0.0028);
  CHECK(world.joint_position({index, 1}) < 0.0035);
  CHECK((world.world_from_part({index, 0}).translation() - lying.translation()).norm() < 1e-3);
  move_line(world, tip_down(0.5, 0, 0.10), 0.5);
  CHECK(world.joint_position({index, 1}) == Approx(0).margin(2e-4));
}

TEST_CASE("a free body with a button is gripped, lifted and carried", "[sim]") {
  Scene scene = table_scene(0);
  add_body(scene, remote({0.5, 0, 0.0101}));
  World world(shared(scene));
  const int index = body_index(world, "remote");
  grip(world, 0.08);
  move_to(world, solve(world, tip_down(0.5, 0, 0.10, std::numbers::pi / 2), world.arm().home()), 1);
  move_line(world, tip_down(0.5, 0, 0.012, std::numbers::pi / 2), 0.5);
  grip(world, 0.03);
  run(world, 0.1);
  REQUIRE(world.grasped() == PartRef{index, 0});
  const Transform tip_from_remote = world.world_from_tip().inverse() * world.world_from_part({index, 0});
  move_line(world, tip_down(0.45, 0.1, 0.25, std::numbers::pi / 2), 1);
  CHECK(world.grasped() == PartRef{index, 0});
  const Transform after = world.world_from_tip().inverse() * world.world_from_part({index, 0});
  CHECK((after.translation() - tip_from_remote.translation()).norm() < 2e-3);
}

TEST_CASE("a free body with joints is placed, snapshots exactly and restores into another world", "[sim]") {
  Scene scene = table_scene(0);
  add_body(scene, remote({0.5, 0, 0.06}));
  add_body(scene, box_body("cube", {0.04, 0.04, 0.04}, {0.5, 0.05, 0.12}, 0.1));
  World world(shared(scene));
  const int index = body_index(world, "remote");
  const Transform thrown = translation(0.5, 0.02, 0.2) * rotation_rpy(0.8, 0.3, 0.2);
  world.apply(operation::Place{index, thrown});
  CHECK((world.world_from_part({index, 0}).matrix() - thrown.matrix()).cwiseAbs().maxCoeff() < 1e-12);
  run(world, 0.1);
  world.apply(operation::Boundary{});
  const Snapshot snapshot = world.snapshot();
  run(world, 0.4);
  const std::string end = world.state_hash();
  world.restore(snapshot);
  run(world, 0.4);
  CHECK(world.state_hash() == end);
  World other(shared(scene));
  other.restore(snapshot);
  run(other, 0.4);
  CHECK(other.state_hash() == end);
}

// m g lead = (I + m lead^2) a: what falls along a thread has to turn for it.
TEST_CASE("a screw turns as it travels: a nut runs down a steep thread as mechanics says", "[sim]") {
  const bool joined = GENERATE(false, true);
  const double pitch = GENERATE(0.5, -0.5);
  INFO("joined " << joined << ", pitch " << pitch);
  const double lead = pitch / kTurn;
  Scene scene = nut_on_post(pitch, joined, pitch > 0 ? 4 * kTurn : 0.001);
  Joint& joint = joined ? scene.bodies.back().parts[0].joint : scene.bodies[1].parts[1].joint;
  if (pitch < 0) joint.initial = 4 * kTurn;
  if (pitch < 0 && joined) joint.lets_go = 0.01;
  World world(shared(scene));
  const PartRef nut = nut_of(world, joined);
  const Part& part = world.scene().bodies[static_cast<std::size_t>(nut.body)].parts[static_cast<std::size_t>(nut.part)];
  const double inertia = part.inertia(2, 2) + 0.2 * lead * lead;
  const double before = world.joint_position(nut), height = world.world_from_part(nut).translation().z();
  const double time = 0.25;
  run(world, time);
  const double turned = world.joint_position(nut) - before;
  CHECK(turned == Approx(0.5 * 0.2 * 9.81 * lead / inertia * time * (time + world.dt())).epsilon(0.01));
  CHECK(height - world.world_from_part(nut).translation().z() == Approx(turned * lead).epsilon(0.01));
  CHECK(world.linear_velocity(nut).head<2>().norm() < 1e-3);
}

TEST_CASE("a joint lets go of its part at its limit, and it falls like any other thing", "[sim]") {
  Scene scene = nut_on_post(0.5, true, 2.0);
  World world(shared(scene));
  const PartRef nut = nut_of(world, true);
  int steps = 0;
  while (world.joined(nut) && steps < 480) {
    world.step();
    ++steps;
  }
  REQUIRE(steps < 480);
  CHECK(world.joint_position(nut) == Approx(2.0).margin(0.1));
  const double speed = world.linear_velocity(nut).z(), turning = world.angular_velocity(nut).z();
  run(world, 0.1);
  CHECK(world.linear_velocity(nut).z() == Approx(speed - 0.981).epsilon(0.01));
  CHECK(world.angular_velocity(nut).z() == Approx(turning).epsilon(0.02));
  CHECK(world.joint_position(nut) == Approx(2.0).margin(0.1));  // as it was when it let go
}

TEST_CASE("what a joint holds stays there by its friction, turns with the hand, and snapshots exactly", "[sim]") {
  Scene scene = table_scene(0);
  Body bottle = box_body("bottle", {0.06, 0.06, 0.10}, {0.5, 0, 0.05}, 0);
  Body cap;
  cap.name = "bottle.cap";
  cap.free = true;
  cap.joined_to = "bottle";
  Part part;
  part.name = "cap";
  part.joint = thread(0.006);
  part.joint.axis = {0, 0, 1};
  part.joint.parent_from_joint = translation(0, 0, 0.05);
  part.joint.friction = 0.05;
  part.joint.lets_go = 1.2;
  part.shapes.push_back(box_shape({0.03, 0.03, 0.03}, {0, 0, 0.016}));
  set_uniform_mass(part, 0.01);
  cap.parts.push_back(part);
  add_body(scene, bottle);
  add_body(scene, cap);
  World world(shared(scene));
  const PartRef ref{body_index(world, "bottle.cap"), 0};
  run(world, 0.5);
  CHECK(world.joint_position(ref) == Approx(0).margin(1e-4));
  CHECK(world.joined(ref));

  grip(world, 0.06);
  move_to(world, solve(world, tip_down(0.5, 0, 0.20), world.arm().home()), 1);
  move_line(world, tip_down(0.5, 0, 0.118), 0.5);
  grip(world, 0, 30);
  REQUIRE(world.grasped() == ref);
  move_line(world, tip_down(0.5, 0, 0.118, -0.4), 0.7);  // screwed shut as far as it goes: it does not turn
  CHECK(world.joint_position(ref) > -0.02);
  grip(world, 0.06);
  move_line(world, tip_down(0.5, 0, 0.118, 0), 0.7);
  grip(world, 0, 30);
  move_line(world, tip_down(0.5, 0, 0.118 + 0.8 / kTurn * 0.006, 0.8), 1);
  CHECK(world.joint_position(ref) == Approx(0.8).margin(0.15));
  CHECK(world.joined(ref));
  world.apply(operation::Boundary{});
  const Snapshot snapshot = world.snapshot();
  const auto unscrew = [&] {
    move_line(world, tip_down(0.5, 0, 0.118 + 1.6 / kTurn * 0.006, 1.6), 1);
    move_line(world, tip_down(0.5, 0, 0.20, 1.6), 1);
    return world.state_hash();
  };
  const std::string end = unscrew();
  CHECK_FALSE(world.joined(ref));
  CHECK(world.world_from_part(ref).translation().z() > 0.15);  // in the hand
  world.restore(snapshot);
  CHECK(world.joined(ref));
  CHECK(unscrew() == end);
}

TEST_CASE("a body that is joined to none before it is refused", "[sim]") {
  Scene scene = nut_on_post(0.5, true, 2.0);
  scene.bodies.back().joined_to = "pillar";
  CHECK_THROWS_WITH(World(shared(scene)), Catch::Contains("joined to 'pillar'"));
}
