// The frozen world that motion planning asks.
#include "engine/sim/collision_space.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/sim/convex.h"
#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

namespace {

Shape sphere(double radius) {
  Shape shape;
  shape.kind = ShapeKind::sphere;
  shape.radius = radius;
  return shape;
}

Transform random_pose(Random& random, double reach) {
  const Quaternion turn(random.normal(), random.normal(), random.normal(), random.normal());
  return make_transform({random.between(-reach, reach), random.between(-reach, reach), random.between(-reach, reach)},
                        turn.normalized());
}

// Distance of a point to a box, exactly.
double distance_to_box(const Vector3& point, const Vector3& half) {
  return (point.cwiseAbs() - half).cwiseMax(0.0).norm();
}

}  // namespace

TEST_CASE("a sphere and a box are as far apart as geometry says", "[sim]") {
  Random random(RandomKey("sphere and box"));
  const Convex ball(sphere(0.05)), box(box_shape({0.2, 0.1, 0.3}));
  for (int i = 0; i < 2000; ++i) {
    const Transform world_from_box = random_pose(random, 0.1), world_from_ball = random_pose(random, 0.4);
    const double gap =
        distance_to_box(world_from_box.inverse() * world_from_ball.translation(), {0.1, 0.05, 0.15}) - 0.05;
    CHECK(closer_than(ball, world_from_ball, box, world_from_box, gap + 1e-7));
    if (gap > 1e-6) CHECK_FALSE(closer_than(box, world_from_box, ball, world_from_ball, gap - 1e-7));
  }
}

TEST_CASE("a box and the hull of its corners agree", "[sim]") {
  Random random(RandomKey("box and hull"));
  Shape hull_shape;
  hull_shape.kind = ShapeKind::hull;
  for (int i = 0; i < 8; ++i)
    hull_shape.points.push_back({i & 1 ? 0.1 : -0.1, i & 2 ? 0.05 : -0.05, i & 4 ? 0.15 : -0.15});
  const Convex hull(hull_shape), box(box_shape({0.2, 0.1, 0.3}));
  Shape rod;
  rod.kind = ShapeKind::cylinder;
  rod.radius = 0.05;
  rod.length = 0.3;
  for (const ShapeKind kind : {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::capsule, ShapeKind::box}) {
    rod.kind = kind;
    rod.size = {0.1, 0.1, 0.3};
    const Convex other(rod);
    int near = 0;
    for (int i = 0; i < 2000; ++i) {
      const Transform a = random_pose(random, 0.2), b = random_pose(random, 0.2);
      const bool one = closer_than(box, a, other, b, 0.01);
      near += one;
      CHECK(one == closer_than(hull, a, other, b, 0.01));
      CHECK(one == closer_than(other, b, hull, a, 0.01));
    }
    CHECK(near > 200);
    CHECK(near < 1990);
  }
}

TEST_CASE("the arm is free at home, and meets what is put in its way", "[sim]") {
  Scene scene = table_scene(3);
  World world(shared(scene));
  auto space = world.collision_space();
  const JointVector home = world.arm().home();
  CHECK(space->free(home));
  CHECK_FALSE(space->first_contact(home));
  const int cube = body_index(world, "cube2");
  space->move_body(cube, world.world_from_tip() * translation(0, 0, -0.05));  // in the palm
  CHECK_FALSE(space->free(home));
  const auto pair = space->first_contact(home);
  REQUIRE(pair);
  CHECK(pair->other == PartRef{cube, 0});
  CHECK(pair->robot_part.body == -1);
  space->allow({cube, 0});
  CHECK(space->free(home));
  space->clear_allowed();
  CHECK_FALSE(space->free(home));
  // Between open fingers there is room for it; between closed ones there is not.
  space->move_body(cube, world.world_from_tip());
  space->set_opening(0.08);
  CHECK(space->free(home));
  space->set_opening(0.02);
  CHECK_FALSE(space->free(home));
}

TEST_CASE("padding is a distance: the table is met where the lowest point says", "[sim]") {
  World world(shared(table_scene(0)));
  auto space = world.collision_space();
  space->set_opening(0);
  // The lowest points of a hand that points down are the finger boxes, 0.0584 + 0.0545 m beyond the hand's frame.
  const double lowest_below_tip = 0.0584 + 0.04525 + 0.00925 - 0.1034;
  const auto free_at = [&](double gap) {
    return space->free(solve(world, tip_down(0.5, 0.1, lowest_below_tip + gap), world.arm().home()));
  };
  CHECK(free_at(0.001));
  CHECK_FALSE(free_at(-0.001));
  space->set_padding(0.02);
  CHECK(free_at(0.021));
  CHECK_FALSE(free_at(0.019));
}

TEST_CASE("a held body collides in the arm's stead", "[sim]") {
  World world(shared(table_scene(2)));
  auto space = world.collision_space();
  const int held = body_index(world, "cube1"), other = body_index(world, "cube2");
  const JointVector q = solve(world, tip_down(0.5, 0.3, 0.1), world.arm().home());
  CHECK(space->free(q));
  space->hold(held, translation(0, 0, 0.09));  // hangs below the tip: its lowest face is 1 cm into the table
  CHECK(space->held() == held);
  const auto pair = space->first_contact(q);
  REQUIRE(pair);
  CHECK(pair->robot_part == PartRef{held, 0});
  CHECK(pair->other == PartRef{0, 0});
  space->allow({0, 0});
  CHECK(space->free(q));
  space->clear_allowed();
  space->hold(held, translation(0, 0, 0.02));
  CHECK(space->free(q));
  space->move_body(other, translation(0.5, 0.3, 0.08));
  CHECK_FALSE(space->free(q));
  space->release();
  CHECK_FALSE(space->held());
}

TEST_CASE("an arm folded into itself is not free", "[sim]") {
  World world(shared(table_scene(0)));
  auto space = world.collision_space();
  // Elbow bent to its limit with the forearm turned: the hand ends in the upper arm.
  const JointVector folded = (JointVector(7) << 0, -1.7, 0, -3.05, 0, 0.0, 0).finished();
  const auto pair = space->first_contact(folded);
  REQUIRE(pair);
  CHECK(pair->robot_part.body == -1);
  CHECK(pair->other.body == -1);
}

TEST_CASE("the checker agrees with Bullet's own contacts", "[sim]") {
  // A cube on the table is touched by the pressing hand exactly when the space, frozen then, says so.
  World world(shared(table_scene(1)));
  grip(world, 0);
  const Vector3 cube = world.world_from_part({1, 0}).translation();
  move_to(world, solve(world, tip_down(cube.x(), cube.y(), 0.08), world.arm().home()), 2);
  CHECK(world.collision_space()->free(world.arm_position()));
  move_line(world, tip_down(cube.x(), cube.y(), 0.045), 1);
  auto space = world.collision_space();
  space->set_padding(0.001);
  const auto pair = space->first_contact(world.arm_position());
  REQUIRE(pair);
  CHECK(pair->other == PartRef{1, 0});
}

TEST_CASE("a free place may have something below, but nothing beside or within", "[sim]") {
  World world(shared(table_scene(2)));
  auto space = world.collision_space();
  const int cube = body_index(world, "cube1"), other = body_index(world, "cube2");
  const Vector3 neighbour = world.world_from_part({other, 0}).translation();
  CHECK(space->body_free(cube, translation(0.5, 0.3, 0.02), 0));
  CHECK(space->body_free(cube, translation(0.5, 0.3, 0.02), 0.02));  // padding does not count against the table
  CHECK_FALSE(space->body_free(cube, translation(0.5, 0.3, 0.01), 0));
  CHECK(space->body_free(cube, translation(neighbour + Vector3(0.041, 0, 0)), 0));
  CHECK_FALSE(space->body_free(cube, translation(neighbour + Vector3(0.041, 0, 0)), 0.005));
  CHECK(space->body_free(cube, translation(neighbour + Vector3(0, 0, 0.04)), 0.005));         // on top of it
  CHECK_FALSE(space->body_free(cube, world.world_from_tip() * translation(0, 0, -0.05), 0));  // in the palm
}
