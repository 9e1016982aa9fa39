// Links do not pass through each other, nor through what stands about: who is looked at, how deep, and what physics
// does.
#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/sim/depth.h"
#include "engine/sim/overlap.h"
#include "engine/sim/self_pairs.h"
#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

namespace {

bool among(const Robot& robot, const std::vector<std::pair<int, int>>& pairs, const char* one, const char* other) {
  const int a = robot.body.part_index(one), b = robot.body.part_index(other);
  return std::ranges::find(pairs, std::pair(std::min(a, b), std::max(a, b))) != pairs.end();
}

// Bars on hinges one after the other; the third begins so near to the first's end that their ends always overlap.
Robot chain() {
  Robot robot;
  robot.name = "chain";
  robot.body.name = "chain";
  for (int i = 0; i < 5; ++i) {
    Part part = moving_part("bar" + std::to_string(i), i == 0 ? JointKind::fixed : JointKind::hinge, Vector3::UnitZ(),
                            {i == 0   ? 0.0
                             : i == 2 ? 0.01
                                      : 0.3,
                             0, 0},
                            -2.5, 2.5);
    part.parent = i - 1;
    part.mass = 1;
    part.inertia = 0.01 * Matrix3::Identity();
    part.shapes.push_back(box_shape({0.3, 0.04, 0.04}, {i == 2 ? 0.1 : 0.15, 0, 0}));
    if (i == 1) part.shapes = {box_shape({0.04, 0.04, 0.04})};
    robot.body.parts.push_back(part);
    if (i == 0) continue;
    robot.arm.push_back(i);
    robot.limits.push_back({-2.5, 2.5, 2, 10, 5000, 50});
    robot.home.push_back(0);
  }
  robot.tip_part = 4;
  return robot;
}

std::shared_ptr<const Scene> arm_only(bool sampled) {
  Scene scene = table_scene(0);
  scene.bodies.clear();
  scene.objects.clear();
  if (sampled) scene.robot.checked_pairs = pairs_that_meet(scene.robot);
  return shared(std::move(scene));
}

JointVector joints(std::initializer_list<double> values) {
  JointVector q(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), q.data());
  return q;
}

// Folded so far that the wrist is in the shoulder, and just before that.
const JointVector kFolded = joints({-0.7748, -0.3424, 1.6957, -3.0702, 2.5479, 3.7052, 0.3604});
const JointVector kBefore = joints({-1.3192, -0.7137, 2.2337, -2.6, 2.468, 3.0, 0.5182});

}  // namespace

TEST_CASE("which links of a Panda can meet is found by looking: wrist and shoulder too", "[sim]") {
  const Robot robot = panda_robot();
  const auto pairs = pairs_that_meet(robot);
  CHECK(among(robot, pairs, "link2", "link6"));
  for (const auto& listed : robot.checked_pairs) {  // those that people list for it, and more
    INFO(robot.body.parts[static_cast<std::size_t>(listed.first)].name
         << " " << robot.body.parts[static_cast<std::size_t>(listed.second)].name);
    CHECK(std::ranges::find(pairs, listed) != pairs.end());
  }
  CHECK_FALSE(among(robot, pairs, "link3", "link4"));               // on one joint
  CHECK_FALSE(among(robot, pairs, "left_finger", "right_finger"));  // no joint of the arm moves them
  CHECK_FALSE(among(robot, pairs, "link7", "hand"));                // one behind the other, without a joint
  CHECK(pairs_that_meet(robot) == pairs);
}

TEST_CASE("links whose shapes overlap wherever the joints are do not count as meeting", "[sim]") {
  const Robot robot = chain();
  const auto pairs = pairs_that_meet(robot);
  CHECK_FALSE(among(robot, pairs, "bar0", "bar2"));
  CHECK(among(robot, pairs, "bar0", "bar4"));
  CHECK(among(robot, pairs, "bar2", "bar4"));
}

TEST_CASE("how deep shapes lie in each other is told to a tenth of a millimetre", "[sim]") {
  const Convex box(box_shape({0.2, 0.1, 0.3})), small(box_shape({0.02, 0.02, 0.02}));
  CHECK(depth_between(box, Transform::Identity(), small, translation(0.107, 0, 0)) == Approx(0.003).margin(1e-4));
  CHECK(depth_between(box, Transform::Identity(), small, translation(0, 0.0595, 0.02)) == Approx(0.0005).margin(1e-4));
  CHECK(depth_between(box, Transform::Identity(), small, translation(0.1101, 0, 0)) == 0);
  Shape ball;
  ball.kind = ShapeKind::sphere;
  ball.radius = 0.05;
  const Convex sphere(ball);
  CHECK(depth_between(sphere, Transform::Identity(), sphere, translation(0.06, 0.06, 0)) ==
        Approx(0.1 - 0.06 * std::sqrt(2.0)).margin(2e-4));
  // Two sheets on one plane, a corner of one over the other: they are as deep as they are thick.
  const Convex mat(box_shape({0.25, 0.38, 0.002})), napkin(box_shape({0.20, 0.23, 0.002}));
  CHECK(depth_between(mat, translation(0.198645, 0.048945, 0.751) * rotation_rpy(0, 0, -0.12094), napkin,
                      translation(0.148459, 0.378324, 0.751) * rotation_rpy(0, 0, 0.25343)) ==
        Approx(0.002).margin(1e-4));
}

TEST_CASE("of a way on which the hand may meet things, the arm alone counts", "[sim]") {
  Scene scene = table_scene(0);
  scene.robot.checked_pairs = pairs_that_meet(scene.robot);
  const World world(shared(scene));
  const Arm arm(scene.robot);
  const auto q = arm.solve(tip_down(0.5, 0, -0.02), arm.home(), RandomKey("into the table"));
  REQUIRE(q);
  CollisionState state = world.collision_state();
  REQUIRE_FALSE(state.free(*q));
  count_arm_alone(state);
  CHECK(state.free(*q));
  CHECK(state.first_touching(std::vector<JointVector>{*q}) == 1);
  CHECK_FALSE(state.free(kFolded));
  CHECK(state.first_touching(std::vector<JointVector>{kFolded}) == 0);
  const auto deepest = deepest_overlap(state, kFolded);
  REQUIRE(deepest);
  CHECK(deepest->depth > 0.05);
}

TEST_CASE("bodies that lie in each other are found, with what they are", "[sim]") {
  Scene scene = table_scene(2);
  scene.bodies[static_cast<std::size_t>(scene.body_index("cube1"))].world_from_body = translation(0.5, 0, 0.015);
  scene.bodies[static_cast<std::size_t>(scene.body_index("cube2"))].world_from_body = translation(0.5, 0.0395, 0.1);
  const World world(shared(scene));
  const auto all = overlapping_bodies(world.collision_state(), 0.001);
  REQUIRE(all.size() == 1);
  CHECK(scene.body_at(all[0].one.body).name == "table");
  CHECK(scene.body_at(all[0].other.body).name == "cube1");
  CHECK(all[0].depth == Approx(0.005).margin(2e-4));
}

TEST_CASE("in physics no link passes through another, however it is driven", "[sim]") {
  for (const bool sampled : {true, false}) {
    Scene scene = *arm_only(sampled);
    if (!sampled) scene.robot.checked_pairs.clear();
    for (std::size_t j = 0; j < scene.robot.arm.size(); ++j)
      scene.robot.body.parts[static_cast<std::size_t>(scene.robot.arm[j])].joint.initial =
          kBefore[static_cast<Eigen::Index>(j)];
    World world(shared(scene));
    CollisionState state = World(arm_only(true)).collision_state();
    REQUIRE(state.free(kBefore));
    move_to(world, kFolded, 2);
    run(world, 1);
    const auto deepest = deepest_overlap(state, world.arm_position());
    const double depth = deepest ? deepest->depth : 0;
    if (sampled)
      CHECK(depth < 0.003);  // a strong arm presses with all it has
    else
      CHECK(depth > 0.05);  // where nobody says that links can meet
  }
}
