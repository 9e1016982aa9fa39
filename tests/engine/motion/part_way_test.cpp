// How far a hand goes with what it holds: the whole way, or as far as the wrist turns.
#include "engine/motion/part_way.h"

#include <catch2/catch.hpp>

#include "engine/motion/route.h"
#include "tests/engine/motion/cluttered.h"

using namespace stampede;

namespace {

// Something on an upright axis through the tip turns by so much.
PartWay turning(const Transform& tip, double turn) {
  PartWay way;
  way.part = {-1, 0};
  way.turn = turn;
  way.moved = [at = Vector3(tip.translation()), turn](double share) {
    return Transform(translation(at) * Eigen::AngleAxisd(share * turn, Vector3::UnitZ()) * translation(Vector3(-at)));
  };
  return way;
}

}  // namespace

TEST_CASE("a wrist turns with what it holds as far as its last joint goes, and says so") {
  const World world(std::make_shared<Scene>(table_scene(0)));
  const CollisionState state = world.collision_state();
  const Arm& arm = state.arm();
  const JointVector start = *arm.solve(above(0.5, 0, 0.3), arm.home(), RandomKey("start"));
  const Eigen::Index last = arm.joints() - 1;
  const JointLimits& limits = arm.limits()[static_cast<std::size_t>(last)];
  for (const double sign : {1.0, -1.0}) {
    const PartWay little = turning(arm.world_from_tip(start), sign * 0.8);
    REQUIRE(way_with_part(state, start, little, RandomKey("way")));
    CHECK(furthest_with_part(state, start, little, RandomKey("way"))->reach == 1);
    const PartWay rounds = turning(arm.world_from_tip(start), sign * 9.5);
    CHECK_FALSE(way_with_part(state, start, rounds, RandomKey("way")));
    const auto found = furthest_with_part(state, start, rounds, RandomKey("way"));
    REQUIRE(found);
    // The tool points down: what turns upwards about the world's z turns the joint back.
    const double room = sign > 0 ? start[last] - limits.lower : limits.upper - start[last];
    CHECK(9.5 * found->reach > room - 0.5);
    CHECK(9.5 * found->reach < room + 1.5);  // the rest of the arm helps a little
    const JointVector& end = found->arm.back();
    CHECK(arm.within_limits(end));
    const Transform expected = rounds.moved(found->reach) * arm.world_from_tip(start);
    CHECK((found->world_from_tip(1).translation() - expected.translation()).norm() < 1e-9);
    CHECK(angle_between(Quaternion(found->world_from_tip(1).linear()), Quaternion(expected.linear())) < 1e-6);
    CHECK(angle_between(Quaternion(arm.world_from_tip(end).linear()), Quaternion(expected.linear())) < 2e-3);
    CHECK(free_at_end(state, start, first_of(rounds, found->reach), end));
  }
}

TEST_CASE("the elbow turns where an arm could not slide something on with it as it is") {
  const World world(cluttered_scene());
  const CollisionState state = world.collision_state();
  const Arm& arm = state.arm();
  Random random(RandomKey("starts"));
  int as_it_is = 0, with_elbow = 0;
  for (int i = 0; i < 200; ++i) {
    const JointVector start = random_free(state, random);
    PartWay slide = turning(arm.world_from_tip(start), 0);
    slide.moved = [](double share) { return translation(0, 0, share * 0.25); };
    const ToolPath rigid = follow_tool(
        arm, start, {[&](double share) { return Transform(slide.moved(share) * arm.world_from_tip(start)); }, 50},
        RandomKey("rigid"));
    if (rigid.reason == Reason::none && !first_touch_of_line(state, rigid.waypoints, 0.01)) ++as_it_is;
    const auto found = way_with_part(state, start, slide, RandomKey("way"));
    if (!found) continue;
    ++with_elbow;
    const Transform end = slide.moved(1) * arm.world_from_tip(start);
    CHECK((arm.world_from_tip(found->arm.back()).translation() - end.translation()).norm() < 1e-3);
    for (const JointVector& q : found->arm) CHECK(state.free(q));
  }
  INFO(as_it_is << ", then " << with_elbow);
  CHECK(with_elbow > as_it_is);
}

TEST_CASE("whether there is a way is known wherever one is found, of doors and of drawers") {
  const World world(cluttered_scene());
  const CollisionState state = world.collision_state();
  Random random(RandomKey("doors"));
  int ways = 0, none = 0, soon_only = 0;
  for (int i = 0; i < 120; ++i) {
    const JointVector start = random_free(state, random);
    Transform hinge = state.arm().world_from_tip(start);
    hinge.translation() += Vector3(0, 0.3, 0);
    PartWay way = turning(hinge, i % 3 == 0 ? 0 : 1.2);  // a drawer, or a door
    if (way.turn == 0) way.moved = [](double share) { return translation(0, 0, share * 0.25); };
    way.pivot = i % 3 == 1 ? 0.6 : 0;
    const bool found = way_with_part(state, start, way, RandomKey("way")).has_value();
    const bool can = can_go_with_part(state, start, way, RandomKey("way"));
    CHECK((can || !found));
    ++(found ? ways : none);
    if (can && !found) ++soon_only;
  }
  CHECK(ways > 10);
  CHECK(none > 10);
  CHECK(soon_only <= 2);
}

TEST_CASE("a part that cannot be followed at all is no way") {
  const World world(std::make_shared<Scene>(table_scene(0)));
  const CollisionState state = world.collision_state();
  const JointVector start = *state.arm().solve(above(0.5, 0, 0.3), state.arm().home(), RandomKey("start"));
  PartWay away = turning(state.arm().world_from_tip(start), 0);
  away.moved = [](double share) { return translation(0, 0, share > 0 ? 5.0 : 0.0); };
  CHECK_FALSE(furthest_with_part(state, start, away, RandomKey("way")));
}

TEST_CASE("the first share of a way ends where the way is then") {
  PartWay way = turning(Transform::Identity(), 2);
  way.stop = 0.8;
  const PartWay half = first_of(way, 0.5);
  CHECK(half.turn == 1.0);
  CHECK(half.stop == 1.0);
  CHECK(half.moved(1).isApprox(way.moved(0.5)));
  CHECK(half.moved(0.5).isApprox(way.moved(0.25)));
  CHECK(first_of(way, 1).stop == 0.8);
}

TEST_CASE("the rest of a way begins where its first share ends") {
  PartWay way = turning(Transform::Identity(), 2);
  way.stop = 0.8;
  const PartWay rest = rest_of(way, 0.6);
  CHECK(rest.turn == Approx(0.8));
  CHECK(rest.stop == Approx(0.5));
  CHECK(rest.before.isApprox(way.moved(0.6)));
  CHECK(rest.moved(0).isApprox(Transform::Identity()));
  CHECK((rest.moved(0.5) * rest.before).isApprox(way.moved(0.8)));
  CHECK((rest_of(rest, 0.5).moved(1) * rest_of(rest, 0.5).before).isApprox(way.moved(1)));
  CHECK(rest_of(way, 0.9).stop == 0);
}

TEST_CASE("a line to where the arm cannot follow is as long as it can be, where that will do") {
  const World world(std::make_shared<Scene>(table_scene(0)));
  const CollisionState state = world.collision_state();
  const JointVector start = *state.arm().solve(above(0.5, 0, 0.3), state.arm().home(), RandomKey("start"));
  const Transform far = translation(0.5, 0, 0) * state.arm().world_from_tip(start);
  LineOptions line;
  CHECK(plan_line({state, start, {}, RandomKey("far")}, far, line).reason == Reason::unreachable);
  line.least_share = 0.95;
  CHECK(plan_line({state, start, {}, RandomKey("far")}, far, line).reason == Reason::unreachable);
  line.least_share = 0.1;
  const auto some = plan_line({state, start, {}, RandomKey("far")}, far, line);
  REQUIRE(some.reason == Reason::none);
  const Vector3 end = state.arm().world_from_tip(some.trajectory.knots.back().position).translation();
  CHECK(end.x() > 0.55);
  CHECK(end.x() < 0.99);
  CHECK((end - Vector3(end.x(), 0, 0.3)).norm() < 2e-4);
}
