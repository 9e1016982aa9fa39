#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/motion/candidates.h"
#include "tests/engine/motion/cluttered.h"

using namespace stampede;

namespace {

// Runs a motion to its end, closing a contact window every frame as a recorder does.
MotionResult run(World& world, Motion& motion, std::int64_t most = 5000) {
  const std::int64_t window = world.scene().physics_hz / world.scene().frame_hz;
  for (std::int64_t k = 0; k < most; ++k) {
    const MotionResult result = motion.step(world);
    if (result.status != MotionStatus::running) return result;
    world.step();
    if (world.step_count() % window == 0) world.close_window();
  }
  return {};
}

std::unique_ptr<Motion> follow(const PlannedMotion& plan, FollowOptions options = {}) {
  REQUIRE(plan.reason == Reason::none);
  return make_follow(plan.trajectory, std::move(options));
}

// Moves the open hand around a cube and closes it.
MotionResult grasp(World& world, const Object& cube) {
  run(world, *make_hand(0.08, 20, std::nullopt));
  CollisionState state = world.collision_state();
  const auto grasps = grasp_candidates({state, world, cube, world.arm_position(), RandomKey("grasp")}, 1);
  REQUIRE_FALSE(grasps.empty());
  state.allow({world.scene().body_index(cube.body), 0});
  const auto plan = plan_through({state, world.arm_position(), {}, RandomKey("reach")},
                                 {{"approach", grasps[0].world_from_approach}, {"grasp", grasps[0].world_from_tip}});
  REQUIRE(run(world, *follow(plan)).status == MotionStatus::done);
  return run(world, *make_hand(0, grasps[0].force, PartRef{world.scene().body_index(cube.body), 0}));
}

MotionResult lift(World& world, double height, FollowOptions options) {
  const CollisionState state = world.collision_state();
  const Transform goal = translation(0, 0, height) * state.arm().world_from_tip(world.arm_position());
  return run(world, *follow(plan_line({state, world.arm_position(), {}, RandomKey("lift")}, goal, {}), options));
}

// The closed fingers just over the table, about to go on to `depth_m` below its top.
std::unique_ptr<Motion> press_down(World& world, double depth_m, FollowOptions options) {
  run(world, *make_hand(0, 20, std::nullopt));
  const CollisionState state = world.collision_state();
  const auto reach =
      plan_through({state, world.arm_position(), {}, RandomKey("over")}, {{"over", above(0.5, 0, 0.05)}});
  REQUIRE(run(world, *follow(reach)).status == MotionStatus::done);
  LineOptions line;
  line.tool_speed = 0.1;
  return follow(plan_line({state, world.arm_position(), {}, RandomKey("press")}, above(0.5, 0, -depth_m), line),
                std::move(options));
}

}  // namespace

TEST_CASE("a cube is grasped and lifted by motions alone") {
  World world(std::make_shared<Scene>(table_scene(3)));
  const Object cube = *world.scene().object("cube1");
  const PartRef part{world.scene().body_index("cube1"), 0};
  REQUIRE(grasp(world, cube).status == MotionStatus::done);
  const double before = world.world_from_part(part).translation().z();
  FollowOptions keep;
  keep.keep = part;
  REQUIRE(lift(world, 0.15, keep).status == MotionStatus::done);
  CHECK(world.world_from_part(part).translation().z() - before == Approx(0.15).margin(0.01));
}

TEST_CASE("a part that is let go on the way is dropped") {
  World world(std::make_shared<Scene>(table_scene(3)));
  REQUIRE(grasp(world, *world.scene().object("cube1")).status == MotionStatus::done);
  FollowOptions keep;
  keep.keep = PartRef{world.scene().body_index("cube1"), 0};
  world.apply(operation::Hand{0.08, 20});
  const MotionResult result = lift(world, 0.15, keep);
  CHECK(result.status == MotionStatus::failed);
  CHECK(result.reason == Reason::dropped);
}

TEST_CASE("a hand that closes on another thing says on what") {
  World world(std::make_shared<Scene>(table_scene(3)));
  const Object& other = *world.scene().object("cube1");
  REQUIRE(grasp(world, other).status == MotionStatus::done);
  run(world, *make_hand(0.08, 20, std::nullopt));
  const MotionResult result = run(world, *make_hand(0, 20, PartRef{world.scene().body_index("cube2"), 0}));
  CHECK(result.reason == Reason::grasp_missed);
  CHECK(result.detail == "the fingers touch cube1, not cube2");
}

TEST_CASE("closing on nothing misses") {
  World world(std::make_shared<Scene>(table_scene(1)));
  const MotionResult result = run(world, *make_hand(0, 20, PartRef{world.scene().body_index("cube1"), 0}));
  CHECK(result.status == MotionStatus::failed);
  CHECK(result.reason == Reason::grasp_missed);
  CHECK(result.detail == "the hand closed on nothing");
}

TEST_CASE("the hand opens to where it is told and a wait takes its steps") {
  World world(std::make_shared<Scene>(table_scene(0)));
  CHECK(run(world, *make_hand(0.03, 20, std::nullopt)).status == MotionStatus::done);
  CHECK(world.opening() == Approx(0.03).margin(0.0015));
  const std::int64_t before = world.step_count();
  CHECK(run(world, *make_wait(17)).status == MotionStatus::done);
  CHECK(world.step_count() - before == 17);
  CHECK(run(world, *make_wait(0)).status == MotionStatus::done);
  CHECK(world.step_count() - before == 17);
}

TEST_CASE("a press ends at the contact, or short of its target where that is allowed, or fails") {
  for (const int mode : {0, 1, 2}) {
    World world(std::make_shared<Scene>(table_scene(0)));
    run(world, *make_hand(0, 20, std::nullopt));
    const CollisionState state = world.collision_state();
    const auto reach =
        plan_through({state, world.arm_position(), {}, RandomKey("over")}, {{"over", above(0.5, 0, 0.1)}});
    REQUIRE(run(world, *follow(reach)).status == MotionStatus::done);
    FollowOptions options;
    options.stop_on_contact = mode == 0;
    options.tolerate_error = mode == 1;
    LineOptions line;
    line.tool_speed = 0.1;
    const auto press = plan_line({state, world.arm_position(), {}, RandomKey("press")}, above(0.5, 0, -0.05), line);
    const MotionResult result = run(world, *follow(press, options));
    if (mode == 2) {
      CHECK(result.status == MotionStatus::failed);
      CHECK(result.reason == Reason::tracking_error);
      continue;
    }
    CHECK(result.status == MotionStatus::done);
    if (mode == 0) CHECK(world.world_from_tip().translation().z() > -0.01);
  }
}

TEST_CASE("an arm that may press with so much and no more stops there, and stays where contact has left it") {
  World world(std::make_shared<Scene>(table_scene(0)));
  FollowOptions options;
  options.most_force = 12;
  CHECK(run(world, *press_down(world, 0.10, options)).status == MotionStatus::done);
  CHECK(world.controller().kind == ControllerKind::joint_position);
  CHECK((world.reference().position - world.arm_position()).norm() < 1e-12);
  double peak = 0;
  for (int frame = 0; frame < 20; ++frame) {
    for (int step = 0; step < 12; ++step) world.step();
    world.close_window();
    for (const Contact& contact : world.contacts())
      if (contact.a.body == -1) peak = std::max(peak, contact.mean_force);
  }
  CHECK(peak > 1);
  CHECK(peak < 60);
  CHECK(world.arm_velocity().norm() < 0.01);
}

TEST_CASE("an arm that gave way and is cut off is as stiff as before, and stays where contact has left it") {
  World world(std::make_shared<Scene>(table_scene(0)));
  FollowOptions options;
  options.most_force = 200;  // more than it comes to: it presses on until it is cut off
  const auto press = press_down(world, 0.02, options);
  for (int step = 0; step < 200 && press->step(world).status == MotionStatus::running; ++step) world.step();
  REQUIRE(world.controller().kind == ControllerKind::cartesian_impedance);
  const double pressed_to = world.world_from_tip().translation().z();
  press->interrupt(world);
  CHECK(world.controller().kind == ControllerKind::joint_position);
  for (int step = 0; step < 60; ++step) world.step();
  CHECK(std::abs(world.world_from_tip().translation().z() - pressed_to) < 0.003);
  CHECK(world.arm_velocity().norm() < 0.01);
}

TEST_CASE("the hand opens as far as what is beside it allows") {
  World world(std::make_shared<Scene>(table_scene(2)));
  const int held = world.scene().body_index("cube1"), other = world.scene().body_index("cube2");
  const JointVector q = world.arm().home();
  CollisionState state = world.collision_state();
  state.move_body(held, world.world_from_tip());
  state.allow({held, 0});
  state.set_opening(0.04);
  CHECK(widest_opening(state, q, 0.08) == 0.08);
  CHECK(widest_opening(state, q, 0.05) == 0.05);
  // A neighbour 8 mm beside the finger that closes on the held cube.
  const Transform beside = world.world_from_tip() * translation(0, 0.02 + 0.0224 + 0.008 + 0.02, 0);
  state.move_body(other, beside);
  const double opening = widest_opening(state, q, 0.08);
  CHECK(opening > 0.044);
  CHECK(opening < 0.06);
  state.set_opening(opening);
  CHECK(state.free(q));
  // One that a finger all but leans against: the hand opens as little as lets go.
  state.set_opening(0.04);
  state.move_body(other, world.world_from_tip() * translation(0, 0.02 + 0.0224 + 0.0003 + 0.02, 0));
  CHECK(widest_opening(state, q, 0.08) < 0.045);
  CHECK(widest_opening(state, q, 0.08) > 0.04);
  CHECK(widest_opening(state, q, 0.08, false) == 0.04);  // nothing is let go: it need not open at all
}

TEST_CASE("the tool keeps its own speed limit, whatever the joints could do") {
  World world(std::make_shared<Scene>(table_scene(0)));
  const CollisionState state = world.collision_state();
  JointVector left = world.arm().home(), right = left;
  left[0] = -1.2;
  right[0] = 1.2;
  left[1] = right[1] = 0.9;  // a stretched arm is fast: 1.67 m/s without the limit
  left[3] = right[3] = -0.5;
  left[5] = right[5] = 1.5;
  MotionLimits limits;
  limits.tool_speed = 1.2;
  const auto sweep = plan_joints({state, left, limits, RandomKey("sweep")}, right);
  REQUIRE(sweep.reason == Reason::none);
  double most = 0;
  for (std::int64_t step = 0; step <= sweep.trajectory.steps(); ++step) {
    const JointState at = evaluate(sweep.trajectory, static_cast<double>(step), world.scene().physics_hz);
    most = std::max(most, (world.arm().jacobian(at.position).topRows<3>() * at.velocity).norm());
  }
  CHECK(most < 1.25);
  CHECK(most > 1.0);
}

TEST_CASE("motions without sense are refused") {
  CHECK_THROWS_AS(make_follow({}, {}), Error);
  CHECK_THROWS_AS(make_hand(-0.01, 20, std::nullopt), Error);
  CHECK_THROWS_AS(make_wait(-1), Error);
}
