#include <catch2/catch.hpp>

#include "engine/motion/pieces.h"
#include "tests/engine/motion/cluttered.h"

using namespace stampede;

namespace {

double turn_between(const Transform& a, const Transform& b) {
  return angle_between(Quaternion(a.linear()), Quaternion(b.linear()));
}

// A post on the table, to the left of its middle, and a bar that lies behind the arm.
std::shared_ptr<const Scene> scene_with_post() {
  Scene scene = table_scene(0);
  Body post = box_body("post", Vector3(0.04, 0.04, 0.2)), bar = box_body("bar", Vector3(0.02, 0.02, 0.2));
  post.world_from_body = translation(0.5, 0.2, 0.1);
  bar.free = true;
  set_uniform_mass(bar.parts[0], 0.1);
  bar.world_from_body = translation(-0.5, 0, 0.1);
  scene.bodies.insert(scene.bodies.begin(), {bar, post});
  return std::make_shared<const Scene>(std::move(scene));
}

}  // namespace

TEST_CASE("an approach is passed close by, without stopping, and the grasp is reached") {
  const World world(std::make_shared<Scene>(table_scene(10)));
  const CollisionState state = world.collision_state();
  Random random(RandomKey("through"));
  int solved = 0;
  for (int k = 0; k < 15; ++k) {
    const double x = random.between(0.35, 0.65), y = random.between(-0.35, 0.35), yaw = random.between(-1, 1);
    const Transform grasp = above(x, y, 0.06, yaw), approach = above(x, y, 0.15, yaw);
    const PlannedMotion motion = plan_through({state, state.arm().home(), {}, RandomKey("t").with(k)},
                                              {{"approach", approach}, {"grasp", grasp}});
    if (motion.reason != Reason::none) continue;
    ++solved;
    REQUIRE(motion.vias.size() == 1);
    CHECK(motion.vias[0].name == "approach");
    const JointState passing = evaluate(motion.trajectory, static_cast<double>(motion.vias[0].step), kHz);
    CHECK(passing.velocity.norm() > 0.1);
    CHECK((state.arm().world_from_tip(passing.position).translation() - approach.translation()).norm() < 0.03);
    const Transform end = state.arm().world_from_tip(motion.trajectory.knots.back().position);
    CHECK((end.translation() - grasp.translation()).norm() < 1e-4);
    CHECK(turn_between(end, grasp) < 1e-3);
    CHECK(touches(state, motion.trajectory, kHz, 0.0025) == 0);
    CHECK(static_cast<double>(motion.trajectory.steps()) / kHz < 2.5);
  }
  CHECK(solved >= 14);
}

TEST_CASE("the last half of an approach is a straight line of the tool") {
  const World world(std::make_shared<Scene>(table_scene(0)));
  const CollisionState state = world.collision_state();
  const Transform grasp = above(0.5, 0.1, 0.05), approach = above(0.5, 0.1, 0.15);
  const PlannedMotion motion =
      plan_through({state, state.arm().home(), {}, RandomKey("line")}, {{"approach", approach}, {"grasp", grasp}});
  REQUIRE(motion.reason == Reason::none);
  double worst = 0;
  for (std::int64_t step = motion.vias[0].step; step <= motion.trajectory.steps(); ++step) {
    const Vector3 tip =
        state.arm().world_from_tip(evaluate(motion.trajectory, static_cast<double>(step), kHz).position).translation();
    if (tip.z() < 0.10) worst = std::max(worst, (tip - grasp.translation()).head<2>().norm());
  }
  CHECK(worst < 0.002);
}

TEST_CASE("what a held thing may touch at the goal it keeps clear of on the way, in rounded corners too") {
  const auto scene = scene_with_post();
  const World world(scene);
  CollisionState all = world.collision_state();
  all.hold(scene->body_index("bar"), translation(0, 0, 0.08));  // it hangs down from the hand
  CollisionState state = all;
  state.allow({scene->body_index("post"), 0});
  const JointVector start = *all.arm().solve(above(0.5, 0.36, 0.22), all.arm().home(), RandomKey("start"), 1);
  const std::vector<ToolTarget> beside = {{"approach", above(0.5, 0.13, 0.22)}, {"goal", above(0.5, 0.13, 0.21)}};
  for (const bool lines : {true, false}) {  // a way that lines follow, and one that ends there
    const std::vector<ToolTarget> targets(beside.begin(), lines ? beside.end() : beside.begin() + 1);
    for (int k = 0; k < 20; ++k) {
      const PlannedMotion motion = plan_through({state, start, {}, RandomKey("clear").with(k)}, targets);
      REQUIRE(motion.reason == Reason::none);
      const std::int64_t end = lines ? motion.vias[0].step : motion.trajectory.steps();
      int touching = 0;
      for (std::int64_t step = 0; step <= end; ++step)
        touching += !all.free(evaluate(motion.trajectory, static_cast<double>(step), kHz).position);
      CHECK(touching == 0);
    }
  }
}

TEST_CASE("a line is straight, keeps the tool's speed and its rotation") {
  const World world(std::make_shared<Scene>(table_scene(0)));
  const CollisionState space = world.collision_state();
  const Arm& arm = space.arm();
  const Transform from = arm.world_from_tip(arm.home());
  const Transform to = translation(0.1, 0.15, -0.1) * from;
  LineOptions line;
  line.tool_speed = 0.2;
  const PlannedMotion motion = plan_line({space, arm.home(), {}, RandomKey("line")}, to, line);
  REQUIRE(motion.reason == Reason::none);
  const Vector3 direction = (to.translation() - from.translation()).normalized();
  double off = 0, speed = 0, turned = 0;
  for (std::int64_t step = 0; step <= motion.trajectory.steps(); ++step) {
    const JointState state = evaluate(motion.trajectory, static_cast<double>(step), kHz);
    const Vector3 way = arm.world_from_tip(state.position).translation() - from.translation();
    off = std::max(off, (way - way.dot(direction) * direction).norm());
    turned = std::max(turned, turn_between(arm.world_from_tip(state.position), from));
    speed = std::max(speed, (arm.jacobian(state.position) * state.velocity).head<3>().norm());
  }
  CHECK(off < 1e-3);
  CHECK(turned < 3e-3);
  CHECK(speed < 1.05 * line.tool_speed);
  CHECK(speed > 0.9 * line.tool_speed);
  const double way = (to.translation() - from.translation()).norm();
  CHECK(static_cast<double>(motion.trajectory.steps()) / kHz < way / line.tool_speed + 0.4);
}

TEST_CASE("a tool path round a hinge stays on its circle") {
  const World world(std::make_shared<Scene>(table_scene(0)));
  const CollisionState state = world.collision_state();
  const Arm& arm = state.arm();
  const Transform from = arm.world_from_tip(arm.home());
  const Vector3 hinge = from.translation() + Vector3(0, 0.3, 0);
  const auto path = [&](double s) {
    Transform turn = Transform::Identity();
    turn.linear() = Eigen::AngleAxisd(0.6 * s, Vector3::UnitZ()).toRotationMatrix();
    return Transform(translation(hinge) * turn * translation(-hinge) * from);
  };
  const PlannedMotion motion = plan_tool_path({state, arm.home(), {}, RandomKey("door")}, path, {});
  REQUIRE(motion.reason == Reason::none);
  double worst = 0;
  for (std::int64_t step = 0; step <= motion.trajectory.steps(); ++step) {
    const Vector3 tip =
        arm.world_from_tip(evaluate(motion.trajectory, static_cast<double>(step), kHz).position).translation();
    worst = std::max(worst, std::abs((tip - hinge).norm() - 0.3));
  }
  CHECK(worst < 1e-3);
  const Transform end = arm.world_from_tip(motion.trajectory.knots.back().position);
  CHECK((end.translation() - path(1).translation()).norm() < 1e-4);
}

TEST_CASE("targets out of reach and lines into the table say so") {
  const World world(std::make_shared<Scene>(table_scene(3)));
  const CollisionState state = world.collision_state();
  const JointVector home = state.arm().home();
  const PlannedMotion far = plan_through({state, home, {}, RandomKey("far")}, {{"shelf", above(1.5, 0, 0.3)}});
  CHECK(far.reason == Reason::unreachable);
  CHECK(far.detail.find("shelf") != std::string::npos);

  const PlannedMotion below = plan_through({state, home, {}, RandomKey("below")},
                                           {{"approach", above(0.7, 0.3, 0.1)}, {"grasp", above(0.7, 0.3, -0.02)}});
  CHECK(below.reason == Reason::no_path);
  CHECK(below.detail.find("touches table") != std::string::npos);

  LineOptions line;
  line.keep_clear = true;
  const PlannedMotion into = plan_line({state, home, {}, RandomKey("into")}, above(0.55, 0, -0.05), line);
  CHECK(into.reason == Reason::no_path);
  const PlannedMotion beyond = plan_line({state, home, {}, RandomKey("beyond")}, above(1.6, 0, 0.4), {});
  CHECK(beyond.reason == Reason::unreachable);
  CHECK(beyond.trajectory.knots.empty());
}

TEST_CASE("lines ahead are to be free: nothing is grasped that cannot be taken away") {
  const World world(scene_with_post());
  const CollisionState state = world.collision_state();
  const auto plan = [&](double aside) {
    return plan_through({state, state.arm().home(), {}, RandomKey("l")},
                        {{"grasp", above(0.5, 0, 0.1)}, {"ahead", above(0.5, aside, 0.1), true}});
  };
  CHECK(plan(0.03).reason == Reason::none);
  const PlannedMotion into_post = plan(0.18);
  CHECK(into_post.reason == Reason::no_path);
  CHECK_THAT(into_post.detail, Catch::StartsWith("on from grasp: ") && Catch::Contains(" touches post"));
}

TEST_CASE("what follows is to be free and in reach: before the arm moves, it is known that it can go on") {
  const World world(scene_with_post());
  const CollisionState state = world.collision_state();
  const Transform grasp = above(0.5, 0, 0.1);
  const auto plan = [&](const std::function<Transform(double)>& way) {
    std::vector<ToolPiece> pieces(2);
    pieces[0].world_from_tip = [&](double share) { return way(0.1 * share); };
    pieces[1].world_from_tip = [&](double share) { return way(0.1 + 0.9 * share); };
    return plan_through({state, state.arm().home(), {}, RandomKey("then")}, {{"goal", grasp}}, {.pieces = &pieces});
  };
  const auto arc = [&](double angle) {  // about an upright line between arm and target
    return [angle](double share) {
      const Vector3 about(0.3, 0, 0);
      return Transform(translation(about) * rotation_rpy(0, 0, share * angle) * translation(-about) *
                       above(0.5, 0, 0.1));
    };
  };
  CHECK(plan(arc(-1.0)).reason == Reason::none);
  const PlannedMotion into_post = plan([](double share) { return above(0.5, 0.18 * share, 0.1); });
  CHECK(into_post.reason == Reason::no_path);
  CHECK_THAT(into_post.detail, Catch::StartsWith("then, on piece 2: ") && Catch::Contains(" touches post"));
  const PlannedMotion beyond = plan([](double share) { return above(0.5 + share, 0, 0.1); });
  CHECK(beyond.reason == Reason::unreachable);
  CHECK_THAT(beyond.detail, Catch::StartsWith("then, on piece 2: the arm cannot follow beyond "));
}
