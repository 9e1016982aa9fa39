// Via-points are passed in their order.
#include "engine/rollout/passages.h"

#include <catch2/catch.hpp>

#include "tests/support/panda.h"

using namespace stampede;

TEST_CASE("a path that passes one place twice passes its via-points in their order") {
  Scene scene = table_scene(0);
  World world(std::make_shared<Scene>(scene));
  // The first joint swings out and back: what lies on the way is passed twice.
  const auto turned = [&](double turn) -> JointVector {
    return world.arm().home() + turn * JointVector::Unit(world.arm().joints(), 0);
  };
  const auto pose_at = [&](double turn) { return world.arm().world_from_tip(turned(turn)); };
  const std::int64_t steps = 240;
  Trajectory swing;
  const JointVector still = JointVector::Zero(world.arm().joints());
  for (const auto& [step, turn] : {std::pair<std::int64_t, double>{0, 0.0}, {steps, 0.6}, {2 * steps, 0.0}})
    swing.knots.push_back({step, turned(turn), still, still});
  world.apply(operation::Follow{swing});
  Passages passages({{"far", pose_at(0.6), 0}, {"back", pose_at(0.3), 0}, {"nowhere", translation(9, 9, 9), 0}}, 7);
  Passages forth({{"out", pose_at(0.3), 0}, {"far", pose_at(0.6), 0}}, 7);
  for (std::int64_t step = 0; step < 2 * steps; ++step) {
    world.step();
    passages.look(world);
    forth.look(world);
  }
  const auto found = passages.in_order();
  REQUIRE(found.size() == 2);
  CHECK(found[0].name == "far");
  CHECK(found[0].step == Approx(steps).margin(12));
  CHECK(found[1].name == "back");
  CHECK(found[1].step > steps + 60);
  CHECK(found[1].tool_speed > 0.1);
  const auto out = forth.in_order();
  REQUIRE(out.size() == 2);
  CHECK(out[0].step < steps - 60);
  CHECK(out[1].step == Approx(steps).margin(12));
}

TEST_CASE("a via that is passed by time is found where the plan has got to it, however often the tool is there") {
  World world(std::make_shared<Scene>(table_scene(0)));
  const Transform here = world.world_from_tip();
  Passages passages({{"first", here, 10, true}, {"second", here, 30, true}, {"never", here, 90, true}}, 3);
  for (int step = 0; step < 60; ++step) {  // the plan waits for twenty steps after its fifteenth
    world.step();
    passages.look(world, step < 15 ? step + 1 : std::max(15, step + 1 - 20));
  }
  const auto found = passages.in_order();
  REQUIRE(found.size() == 2);
  CHECK((found[0].name == "first" && found[0].step == 10));
  CHECK((found[1].name == "second" && found[1].step == 50));
}
