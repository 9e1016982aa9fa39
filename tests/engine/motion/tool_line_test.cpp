// On lines and paths of the tool the arm keeps clear of itself and of what stands about, whatever the hand is to meet.
#include <catch2/catch.hpp>

#include "engine/motion/checker.h"
#include "engine/motion/pieces.h"
#include "engine/sim/overlap.h"
#include "engine/sim/self_pairs.h"
#include "tests/engine/motion/cluttered.h"

using namespace stampede;

namespace {

std::shared_ptr<Scene> arm_only() {
  auto scene = std::make_shared<Scene>(table_scene(0));
  scene->bodies.clear();
  scene->objects.clear();
  scene->robot.checked_pairs = pairs_that_meet(scene->robot);
  return scene;
}

// Near itself; straight back from here the wrist comes to the shoulder, unless the elbow gives way.
JointVector folded() {
  JointVector q(7);
  q << -1.3192, -0.7137, 2.2337, -2.6, 2.468, 3.0, 0.5182;
  return q;
}

double deepest_on(const CollisionState& state, const Trajectory& trajectory) {
  double deepest = 0;
  for (std::int64_t step = 0; step <= trajectory.steps(); ++step)
    if (const auto overlap = deepest_overlap(state, evaluate(trajectory, static_cast<double>(step), kHz).position))
      deepest = std::max(deepest, overlap->depth);
  return deepest;
}

}  // namespace

TEST_CASE("a line that would lead the arm into itself is not taken, and says what meets what") {
  const World world(arm_only());
  const CollisionState state = world.collision_state();
  REQUIRE(state.free(folded()));
  const Transform tip = state.arm().world_from_tip(folded());
  int refused = 0;
  for (const double back : {0.02, 0.04, 0.06, 0.08, 0.10, 0.12}) {
    const PlannedMotion motion =
        plan_line({state, folded(), {}, RandomKey("back")}, tip * translation(0, 0, -back), {});
    INFO(back << " " << motion.detail);
    if (motion.reason == Reason::none) {
      CHECK(deepest_on(state, motion.trajectory) < 5e-4);
      continue;
    }
    ++refused;
    if (motion.reason != Reason::no_path) continue;  // out of reach
    CHECK(motion.detail.find(" touches ") != std::string::npos);
  }
  CHECK(refused < 6);
}

TEST_CASE("a link that would meet furniture on a line keeps off it, the hand may meet it") {
  auto scene = arm_only();
  Part part;
  part.name = "post";
  Shape shape;
  shape.size = Vector3(0.05, 0.05, 1.2);
  part.shapes.push_back(shape);
  Body post;
  post.name = "post";
  post.parts.push_back(part);
  const Arm arm(scene->robot);
  const JointVector start = *arm.solve(above(0.5, -0.15, 0.3), arm.home(), RandomKey("start"));
  const JointVector end = *arm.solve(above(0.5, 0.25, 0.3), start, RandomKey("end"));
  const Transform line_end = arm.world_from_tip(end);
  LineOptions line;
  {  // in the way of the tool: the caller's business
    post.world_from_body = translation(0.5, 0.05, 0.1);
    scene->bodies = {post};
    const World world(scene);
    const PlannedMotion motion = plan_line({world.collision_state(), start, {}, RandomKey("hand")}, line_end, line);
    INFO(motion.detail);
    CHECK((motion.reason == Reason::none || motion.detail.find("hand") == std::string::npos));
  }
  {  // in the way of the elbow
    auto walled = std::make_shared<Scene>(*scene);
    walled->bodies[0].world_from_body = translation(0.2, 0.12, 0.6);
    const World world(walled);
    const CollisionState state = world.collision_state();
    REQUIRE(state.free(start));
    const PlannedMotion motion = plan_line({state, start, {}, RandomKey("elbow")}, line_end, line);
    INFO(motion.detail);
    if (motion.reason == Reason::none)
      CHECK(deepest_on(state, motion.trajectory) < 5e-4);
    else
      CHECK(motion.detail.find("post") != std::string::npos);
  }
}

TEST_CASE("an arm that contact has left in itself comes away on a line, but never deeper") {
  const World world(arm_only());
  const CollisionState state = world.collision_state();
  JointVector inside = folded();
  inside << -0.7748, -0.3424, 1.6957, -3.0702, 2.5479, 3.7052, 0.3604;
  REQUIRE_FALSE(state.free(inside));
  const Transform tip = state.arm().world_from_tip(inside);
  const PlannedMotion on = plan_line({state, inside, {}, RandomKey("deeper")}, tip * translation(0, 0, -0.02), {});
  if (on.reason == Reason::none)
    CHECK(deepest_on(state, on.trajectory) <= deepest_overlap(state, inside)->depth + 1e-3);
}

TEST_CASE("a way in pieces on which the arm would meet itself is refused by piece and pair") {
  const World world(arm_only());
  const CollisionState state = world.collision_state();
  const Transform tip = state.arm().world_from_tip(folded());
  ToolPiece back;
  back.name = "back";
  back.world_from_tip = [&](double share) { return Transform(tip * translation(0, 0, -0.1 * share)); };
  const PlannedMotion motion = plan_pieces({state, folded(), {}, RandomKey("pieces")}, {back}, {});
  INFO(motion.detail);
  if (motion.reason == Reason::none)
    CHECK(deepest_on(state, motion.trajectory) < 5e-4);
  else
    CHECK(motion.detail.find("piece 1 'back'") != std::string::npos);
}
