// What falls does not sink in: not for a step.
#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/base/random.h"
#include "engine/sim/overlap.h"
#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

namespace {

constexpr double kMost_m = 7e-4;  // a millimetre is wanted

Body falling(const std::string& name, const std::vector<Shape>& shapes, const Transform& pose) {
  Body body;
  body.name = name;
  body.free = true;
  body.world_from_body = pose;
  Part part;
  part.name = "base";
  part.shapes = shapes;
  set_uniform_mass(part, 0.2);
  body.parts.push_back(part);
  return body;
}

Shape disc(double radius, double thickness) {
  Shape shape;
  shape.kind = ShapeKind::cylinder;
  shape.radius = radius;
  shape.length = thickness;
  return shape;
}

Shape solid(std::vector<Vector3> points) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.points = std::move(points);
  return shape;
}

// The greatest depth to which bodies lie in each other until they rest.
double deepest_of(World& world, double seconds) {
  double deepest = 0;
  for (int i = 0; i < seconds / world.dt(); ++i) {
    world.step();
    if (world.step_count() % 12 == 0) world.close_window();
    for (const Overlap& overlap : overlapping_bodies(world.collision_state(), 1e-4))
      deepest = std::max(deepest, overlap.depth);
  }
  return deepest;
}

}  // namespace

TEST_CASE("what is thin or sharp and comes down tilted lands without sinking in and lies still", "[sim]") {
  const Shape prism = solid({{0.03, 0, -0.02},
                             {-0.02, 0.025, -0.02},
                             {-0.02, -0.025, -0.02},  //
                             {0.03, 0, 0.02},
                             {-0.02, 0.025, 0.02},
                             {-0.02, -0.025, 0.02}});
  const std::vector<std::pair<const char*, std::vector<Shape>>> things = {
      {"tile", {box_shape({0.10, 0.10, 0.004})}},
      {"disc", {disc(0.09, 0.004)}},
      {"prism", {prism}},
      {"cross", {box_shape({0.12, 0.01, 0.01}), box_shape({0.01, 0.12, 0.01})}}};
  Random random(RandomKey("landing"));
  for (const auto& [name, shapes] : things)
    for (int i = 0; i < 6; ++i) {
      Scene scene = table_scene(0);
      const double height = 0.1 + 0.05 * i;
      const Transform pose =
          translation(0.55, 0, height) * rotation_rpy(random.between(-0.4, 0.4), random.between(-0.4, 0.4), 0);
      add_body(scene, falling(name, shapes, pose));
      World world(shared(scene));
      INFO(name << " from " << height << " m");
      CHECK(deepest_of(world, 2) < kMost_m);
      const int body = body_index(world, name);
      CHECK(world.linear_velocity({body, 0}).norm() < 1e-3);
    }
}

TEST_CASE("a plate that topples off its rim lies on the table where it comes down", "[sim]") {
  const Shape plate = disc(0.085, 0.012);
  Random random(RandomKey("toppling"));
  for (int i = 0; i < 16; ++i) {
    Scene scene = table_scene(0);
    const double lean = random.between(0.3, 1.3), turn = random.between(-3, 3);
    const double height = plate.radius * std::sin(lean) + plate.length / 2 * std::cos(lean) + 0.001;
    add_body(scene, falling("plate", {plate}, translation(0.55, 0, height) * rotation_rpy(0, lean, turn)));
    World world(shared(scene));
    INFO("leaning by " << lean << " rad");
    CHECK(deepest_of(world, 2) < kMost_m);
    CHECK(world.linear_velocity({body_index(world, "plate"), 0}).norm() < 1e-3);
  }
}

TEST_CASE("what is thin and falls on something thin stays above it, however fast and turned it comes", "[sim]") {
  Random random(RandomKey("thin on thin"));
  std::vector<Shape> comb = {box_shape({0.085, 0.014, 0.016}, {-0.0375, 0, 0})};
  for (const double y : {-0.009, -0.003, 0.003, 0.009})
    comb.push_back(box_shape({0.08, 0.003, 0.004}, {0.045, y, -0.006}));
  for (int i = 0; i < 12; ++i) {
    Scene scene = table_scene(0);
    Body sheet = falling("sheet", {box_shape({0.3, 0.3, 0.004})}, translation(0.55, 0, 0.002));
    sheet.free = false;
    add_body(scene, sheet);
    const double height = 0.05 + 0.05 * i;
    const double lean = i < 6 ? 0 : 0.3;
    add_body(scene, falling("comb", comb,
                            translation(0.55, 0, height) *
                                rotation_rpy(random.between(-lean, lean), random.between(-lean, lean), i)));
    World world(shared(scene));
    INFO("from " << height << " m");
    CHECK(deepest_of(world, 2) < (height < 0.45 ? kMost_m : 0.002));  // its far end comes down with 6 m/s then
    const PartRef comb_base{body_index(world, "comb"), 0};
    CHECK(world.linear_velocity(comb_base).norm() < 1e-3);
    double held_up = 0;
    for (const Contact& contact : world.contacts()) held_up += std::abs(contact.force.z());
    CHECK(held_up == Approx(0.2 * 9.81).margin(0.02));
  }
}
