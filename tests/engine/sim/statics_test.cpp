// Resting bodies: what Newton says of their contact forces, and stacks that stand.
#include <catch2/catch.hpp>

#include "engine/geometry/corners.h"
#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

TEST_CASE("a resting cube is held up by its weight", "[sim]") {
  World world(shared(table_scene(1)));
  const int cube = body_index(world, "cube1");
  run(world, 1.0);
  const Contact* found = nullptr;
  for (const Contact& contact : world.contacts())
    if (contact.a == PartRef{0, 0} && contact.b == PartRef{cube, 0}) found = &contact;
  REQUIRE(found);
  const double weight = 0.1 * 9.81;
  CHECK(found->mean_force == Approx(weight).epsilon(0.01));
  CHECK(found->peak_force >= found->mean_force);
  CHECK(found->normal.z() == Approx(-1).margin(1e-6));  // from the cube to the table
  CHECK(found->force.z() == Approx(-weight).epsilon(0.01));
  CHECK((found->point - world.world_from_part({cube, 0}).translation() - Vector3(0, 0, -0.02)).norm() < 2e-3);
  CHECK_FALSE(world.grasped());
}

TEST_CASE("a free fall covers g t^2 / 2", "[sim]") {
  Scene scene = table_scene(0);
  add_body(scene, box_body("ball", Vector3::Constant(0.05), {0.5, 0.5, 2.0}, 0.3));
  World world(shared(scene));
  const int ball = body_index(world, "ball");
  const int steps = 96;
  for (int i = 0; i < steps; ++i) world.step();
  // Semi-implicit Euler falls g dt^2 n (n + 1) / 2.
  const double fallen = 9.81 * world.dt() * world.dt() * steps * (steps + 1) / 2.0;
  CHECK(world.world_from_part({ball, 0}).translation().z() == Approx(2.0 - fallen).epsilon(1e-9));
  CHECK(world.linear_velocity({ball, 0}).z() == Approx(-9.81 * world.dt() * steps).epsilon(1e-9));
}

TEST_CASE("five stacked cubes stand for 30 s", "[sim]") {
  Scene scene = table_scene(0);
  for (int i = 0; i < 5; ++i)
    add_body(scene,
             box_body("stack" + std::to_string(i), Vector3::Constant(0.04), {0.5, 0.2, 0.0205 + 0.0405 * i}, 0.1));
  World world(shared(scene));
  run(world, 30);
  for (int i = 0; i < 5; ++i) {
    const Transform& pose = world.world_from_part({body_index(world, ("stack" + std::to_string(i)).c_str()), 0});
    CHECK((pose.translation() - Vector3(0.5, 0.2, 0.02 + 0.04 * i)).norm() < 0.003);
    CHECK(pose.linear()(2, 2) > 0.999);
  }
}

TEST_CASE("shapes rest at their height: hulls and cones do not grow by their margin", "[sim]") {
  Scene scene = table_scene(0);
  Body hull = box_body("hull", Vector3::Constant(0.04), {0.4, 0.2, 0.021}, 0.1);
  Shape& points = hull.parts[0].shapes[0];
  points.kind = ShapeKind::hull;
  for (const Vector3& corner : box_corners(Vector3::Constant(-0.02), Vector3::Constant(0.02)))
    points.points.push_back(corner);
  Body cone = box_body("cone", Vector3::Constant(0.04), {0.6, 0.2, 0.031}, 0.1);
  Shape& round = cone.parts[0].shapes[0];
  round.kind = ShapeKind::cone;
  round.radius = 0.03;
  round.length = 0.06;
  add_body(scene, hull);
  add_body(scene, cone);
  World world(shared(scene));
  run(world, 1);
  CHECK(world.world_from_part({body_index(world, "hull"), 0}).translation().z() == Approx(0.02).margin(2e-4));
  CHECK(world.world_from_part({body_index(world, "cone"), 0}).translation().z() == Approx(0.03).margin(3e-4));
}

TEST_CASE("a free body without mass is refused with a cure", "[sim]") {
  Scene scene = table_scene(1);
  scene.bodies.back().parts[0].mass = 0;
  CHECK_THROWS_WITH(World(shared(scene)), Catch::Contains("cube1") && Catch::Contains("mass"));
}

TEST_CASE("what is only drawn changes no bit of the physics", "[sim]") {
  const auto end_of = [](bool dressed) {
    Scene scene = table_scene(2);
    Body& cube = scene.bodies.back();
    Part& part = cube.parts[0];
    part.shapes[0].size = {0.04, 0.06, 0.02};
    part.shapes[0].part_from_shape = rotation_rpy(0.3, 0.2, 0.1);  // principal axes that are not the part's
    set_uniform_mass(part, 0.1);
    cube.world_from_body.translation().z() += 0.05;
    if (dressed) {
      Shape coat = box_shape({0.1, 0.02, 0.3});
      coat.collides = false;
      part.shapes.push_back(coat);
      set_uniform_mass(part, 0.1);
    }
    World world(shared(scene));
    run(world, 0.5);
    return world.state_hash();
  };
  CHECK(end_of(true) == end_of(false));
}
