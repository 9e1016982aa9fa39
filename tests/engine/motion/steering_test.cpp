// A force held while moving, a search where a straight way is blocked, a hand that opens on the way.
#include "engine/motion/steering.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "engine/base/error.h"
#include "tests/engine/motion/cluttered.h"

using namespace stampede;

namespace {

// After each frame: what the hand presses on the table with, where the tip is.
struct Frame {
  double force = 0;
  Vector3 tip = Vector3::Zero();
  double reference_y = 0;
};

struct Watched {
  MotionResult result;
  std::vector<Frame> frames;
};

Watched watched(World& world, Motion& motion, std::int64_t most = 8000) {
  Watched made;
  const std::int64_t window = world.scene().physics_hz / world.scene().frame_hz;
  for (std::int64_t k = 0; k < most; ++k) {
    made.result = motion.step(world);
    if (made.result.status != MotionStatus::running) break;
    world.step();
    if (world.step_count() % window != 0) continue;
    world.close_window();
    double force = 0;
    for (const Contact& contact : world.contacts())
      if (contact.a.body < 0 && contact.b.body >= 0) force += contact.force.z();
    made.frames.push_back({force, world.world_from_tip().translation(),
                           world.arm().world_from_tip(world.reference().position).translation().y()});
  }
  return made;
}

void go_to(World& world, const Transform& tip) {
  const CollisionState state = world.collision_state();
  const auto reach = plan_through({state, world.arm_position(), {}, RandomKey("over")}, {{"over", tip}});
  REQUIRE(reach.reason == Reason::none);
  REQUIRE(watched(world, *make_follow(reach.trajectory, {})).result.status == MotionStatus::done);
}

Trajectory line_by(World& world, const Vector3& by, double speed) {
  LineOptions line;
  line.tool_speed = speed;
  const JointVector start = world.arm_position();
  const auto plan = plan_line({world.collision_state(), start, {}, RandomKey("line")},
                              translation(by) * world.arm().world_from_tip(start), line);
  REQUIRE(plan.reason == Reason::none);
  return plan.trajectory;
}

constexpr double kFingers = 0.009;  // that they end beyond the tip

// A table with a square hole of 21 mm in a block at (0.5, 0), and a rod of 20 mm that hangs on the hand as a part of
// it.
std::shared_ptr<Scene> peg_scene() {
  auto scene = std::make_shared<Scene>(table_scene(0));
  const auto box = [](const Vector3& size, const Vector3& at) {
    Shape shape;
    shape.size = size;
    shape.part_from_shape = translation(at);
    return shape;
  };
  Body block;
  block.name = "block";
  Part part;
  part.name = "block";
  constexpr double kHole = 0.021, kWall = 0.03, kHeight = 0.06;
  for (const double side : {-1.0, 1.0}) {
    part.shapes.push_back(box({kWall, 2 * kWall + kHole, kHeight}, {side * (kHole + kWall) / 2, 0, kHeight / 2}));
    part.shapes.push_back(box({kHole, kWall, kHeight}, {0, side * (kHole + kWall) / 2, kHeight / 2}));
  }
  block.parts.push_back(part);
  block.world_from_body = translation(0.5, 0, 0);
  scene->bodies.push_back(block);
  std::sort(scene->bodies.begin(), scene->bodies.end(), [](const Body& a, const Body& b) { return a.name < b.name; });
  Robot& robot = scene->robot;
  Shape rod = box({0.02, 0.02, 0.08}, Vector3::Zero());
  rod.part_from_shape = robot.tip_part_from_tip * translation(0, 0, 0.05);
  robot.body.parts[static_cast<std::size_t>(robot.tip_part)].shapes.push_back(rod);
  return scene;
}

constexpr double kRod = 0.09;    // its end, beyond the tip
constexpr double kBlock = 0.06;  // height of the block

// From 5 mm over the block, `off` beside the middle of its hole, 45 mm down.
Watched put_in(World& world, const Vector3& off, FollowOptions options) {
  watched(world, *make_hand(0, 20, std::nullopt));
  go_to(world, translation(off) * above(0.5, 0, kBlock + kRod + 0.005));
  const Trajectory down = line_by(world, {0, 0, -0.045}, 0.05);
  options.tolerance_rad = 0.01;
  const auto motion = make_follow(down, options);
  return watched(world, *motion);
}

}  // namespace

TEST_CASE("a wipe keeps its force where the surface is higher or lower than thought") {
  for (const double wrong : {-0.008, 0.0, 0.005}) {
    World world(std::make_shared<Scene>(table_scene(0)));
    watched(world, *make_hand(0, 20, std::nullopt));
    go_to(world, above(0.5, -0.1, kFingers + 0.006));  // and its way leads up or down by what is wrong
    FollowOptions options;
    options.kind = "follow";
    options.press = 10;
    const auto motion = make_follow(line_by(world, {0, 0.2, wrong}, 0.1), options);
    const Watched wipe = watched(world, *motion);
    INFO("wrong by " << wrong << ": " << wipe.result.detail);
    REQUIRE(wipe.result.status == MotionStatus::done);
    CHECK(world.controller().kind == ControllerKind::joint_position);
    // It presses before it sets out; from then on the force stays.
    int moving = 0;
    double worst = 0, beside = 0;
    for (const Frame& frame : wipe.frames) {
      if (frame.reference_y < -0.09 || frame.reference_y > 0.09) continue;
      ++moving;
      worst = std::max(worst, std::abs(frame.force - 10));
      beside = std::max(beside, std::abs(frame.tip.x() - 0.5));
    }
    CHECK(moving > 30);
    CHECK(worst < 3);
    CHECK(beside < 0.002);
    CHECK(world.world_from_tip().translation().y() == Approx(0.1).margin(0.003));
  }
}

TEST_CASE("pressing where there is nothing is told, and so is a direction of the world") {
  World world(std::make_shared<Scene>(table_scene(0)));
  watched(world, *make_hand(0, 20, std::nullopt));
  go_to(world, above(0.5, 0, 0.3));
  FollowOptions options;
  options.press = 10;
  const auto high = make_follow(line_by(world, {0, 0.05, 0}, 0.1), options);
  const Watched nothing = watched(world, *high);
  CHECK(nothing.result.reason == Reason::tracking_error);
  CHECK_THAT(nothing.result.detail, Catch::Contains("nothing to press on within 30 mm"));
  CHECK(world.controller().kind == ControllerKind::joint_position);
  options.press_along = -Vector3::UnitZ();
  go_to(world, above(0.5, 0, kFingers + 0.01));
  const auto wipe = make_follow(line_by(world, {0, 0.05, 0}, 0.1), options);
  CHECK(watched(world, *wipe).result.status == MotionStatus::done);
}

TEST_CASE("a rod that starts 2 mm beside a hole with 1 mm of play goes in with a search, and without one it does not") {
  for (const Vector3& off : {Vector3(0.002, 0, 0), Vector3(-0.0014, 0.0014, 0), Vector3(0, -0.002, 0)}) {
    for (const bool search : {false, true}) {
      World world(peg_scene());
      FollowOptions options;
      options.most_force = search ? 0 : 20;
      options.search = search ? 0.004 : 0;
      const Watched made = put_in(world, off, options);

      INFO(off.transpose() << ": " << made.result.detail);
      const double depth = kBlock + kRod - world.world_from_tip().translation().z();
      if (search) {
        CHECK(made.result.status == MotionStatus::done);
        CHECK(depth == Approx(0.04).margin(0.003));
        for (const Frame& frame : made.frames) CHECK(frame.force < 25);
      } else {
        CHECK(depth < 0.003);
      }
    }
  }
}

TEST_CASE("a search finds nothing where there is nothing, and says so") {
  World world(peg_scene());
  FollowOptions options;
  options.search = 0.003;
  const Watched made = put_in(world, Vector3(0, 0.025, 0), options);
  CHECK(made.result.status == MotionStatus::failed);
  CHECK(made.result.reason == Reason::stuck);
  CHECK_THAT(made.result.detail, Catch::Contains("blocked 40 mm before the end, with no way on within 3 mm around"));
  CHECK(world.controller().kind == ControllerKind::joint_position);
  FollowOptions both;
  both.search = 0.003;
  both.press = 3;
  CHECK_THROWS_AS(make_follow(line_by(world, {0, 0, 0.05}, 0.1), both), Error);
}

TEST_CASE("the hand opens while the arm moves") {
  World world(std::make_shared<Scene>(table_scene(0)));
  watched(world, *make_hand(0, 20, std::nullopt));
  const Trajectory up = line_by(world, {0, 0, 0.1}, 0.1);
  FollowOptions options;
  options.hands = {{up.steps() / 2, 0.05}};
  const auto motion = make_follow(up, options);
  for (std::int64_t step = 0; step < up.steps() / 2; ++step) {
    REQUIRE(motion->step(world).status == MotionStatus::running);
    CHECK(world.opening() < 0.002);
    world.step();
  }
  const double speed = world.arm_velocity().norm();
  CHECK(speed > 0.05);  // in mid-motion
  CHECK(watched(world, *motion).result.status == MotionStatus::done);
  CHECK(world.opening() == Approx(0.05).margin(0.0015));
  CHECK(world.commanded_opening() == 0.05);
}

TEST_CASE("what presses is replayed from its operations alone, to the last bit") {
  const auto scene = std::make_shared<Scene>(table_scene(0));
  World world(scene);
  watched(world, *make_hand(0, 20, std::nullopt));
  go_to(world, above(0.5, -0.1, kFingers + 0.004));
  FollowOptions options;
  options.press = 8;
  watched(world, *make_follow(line_by(world, {0, 0.1, 0}, 0.1), options));
  World again(scene);
  std::size_t next = 0;
  const std::vector<Command> log = world.log();
  const std::int64_t window = scene->physics_hz / scene->frame_hz;
  while (again.step_count() < world.step_count()) {
    for (; next < log.size() && log[next].step == again.step_count(); ++next)
      again.apply(operation_from_bytes(operation_kind(log[next].operation), operation_to_bytes(log[next].operation)));
    again.step();
    if (again.step_count() % window == 0) again.close_window();
  }
  CHECK(again.state_hash() == world.state_hash());
}
