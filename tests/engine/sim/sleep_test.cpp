// Sleep: who may, what wakes, and that nobody can tell by looking at the world.
#include <catch2/catch.hpp>
#include <numbers>

#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

namespace {

Vector3 place_of(const World& world, const char* name) {
  return world.world_from_part({body_index(world, name), 0}).translation();
}

bool still(const World& world, const char* name) {  // to the last bit: it sleeps
  const PartRef part{body_index(world, name), 0};
  return world.linear_velocity(part).isZero(0) && world.angular_velocity(part).isZero(0);
}

Scene tower(int stones) {
  Scene scene = table_scene(0);
  for (int i = 0; i < stones; ++i)
    add_body(scene,
             box_body("stone" + std::to_string(i), Vector3::Constant(0.04), {0.5, 0.2, 0.0205 + 0.0405 * i}, 0.1));
  return scene;
}

}  // namespace

TEST_CASE("what sleeps presses on what carries it as before", "[sim]") {
  World awake(shared(tower(3))), asleep(shared(tower(3)));
  awake.let_sleep(false);
  run(awake, 2);
  run(asleep, 2);
  REQUIRE(still(asleep, "stone1"));
  REQUIRE(awake.contacts().size() == asleep.contacts().size());
  for (std::size_t i = 0; i < awake.contacts().size(); ++i) {
    const Contact &one = awake.contacts()[i], &other = asleep.contacts()[i];
    CHECK(one.a == other.a);
    CHECK(one.b == other.b);
    CHECK(one.mean_force == Approx(other.mean_force).margin(1e-4));
    CHECK((one.normal - other.normal).norm() < 1e-3);
  }
}

TEST_CASE("a tower wakes as one when something falls on it, and stands", "[sim]") {
  World world(shared([] {
    Scene scene = tower(3);
    add_body(scene, box_body("drop", Vector3::Constant(0.03), {0.8, 0.2, 0.015}, 0.1));
    return scene;
  }()));
  run(world, 1);
  REQUIRE(still(world, "stone0"));
  world.apply(operation::Place{body_index(world, "drop"), translation(0.505, 0.205, 0.2)});
  run(world, 0.05);
  CHECK(still(world, "stone0"));  // it is still falling
  CHECK_FALSE(still(world, "drop"));
  bool woken = false;
  for (int step = 0; step < 480; ++step) {
    world.step();
    woken = woken || !still(world, "stone0");
  }
  CHECK(woken);
  CHECK(place_of(world, "drop").z() == Approx(0.12 + 0.015).margin(1e-3));
  for (const char* stone : {"stone0", "stone1", "stone2"}) CHECK(still(world, stone));
}

TEST_CASE("who loses what he stands on falls", "[sim]") {
  World world(shared(tower(3)));
  run(world, 1);
  REQUIRE(still(world, "stone2"));
  world.apply(operation::Place{body_index(world, "stone0"), translation(0.5, -0.3, 0.0201)});
  run(world, 1);
  CHECK(place_of(world, "stone1").z() == Approx(0.02).margin(1e-3));
  CHECK(place_of(world, "stone2").z() == Approx(0.06).margin(1e-3));
}

TEST_CASE("a sleeper is pushed, grasped and lifted like anything else", "[sim]") {
  Scene scene = table_scene(0);
  add_body(scene, box_body("near", Vector3::Constant(0.04), {0.5, -0.2, 0.02}, 0.1));
  add_body(scene, box_body("behind", Vector3::Constant(0.04), {0.5, -0.1, 0.02}, 0.1));
  World world(shared(scene));
  run(world, 1);
  REQUIRE(still(world, "near"));
  move_to(world, solve(world, tip_down(0.5, -0.28, 0.1), world.arm().home()), 1.5);
  grip(world, 0);
  move_line(world, tip_down(0.5, -0.28, 0.02), 1);
  CHECK(still(world, "near"));
  move_line(world, tip_down(0.5, -0.12, 0.02), 1.5);  // one pushes the other
  CHECK(place_of(world, "near").y() > -0.12);
  CHECK(place_of(world, "behind").y() > -0.085);
  CHECK(place_of(world, "near").z() == Approx(0.02).margin(1e-3));
  move_line(world, tip_down(0.5, -0.3, 0.02), 1);
  run(world, 0.5);
  CHECK(still(world, "behind"));
}

TEST_CASE("a drawer and what lies in it sleep, and are carried when it is pulled", "[sim]") {
  Scene scene = table_scene(0);
  add_body(scene, chest({0.72, 0, 0.4}));
  add_body(scene, box_body("toy", Vector3::Constant(0.04), {0.72, 0, 0.4505}, 0.1));
  World world(shared(scene));
  const PartRef drawer{body_index(world, "chest"), 1};
  const Transform grasp = translation(0.565, 0, 0.47) * rotation_rpy(0, 2 * std::numbers::pi / 3, 0) *
                          rotation_rpy(0, 0, std::numbers::pi / 2);
  move_to(world, solve(world, grasp * translation(0, 0, -0.08), world.arm().home()), 2);
  REQUIRE(still(world, "toy"));
  REQUIRE(world.joint_velocity(drawer) == 0);
  const double where = place_of(world, "toy").x();
  move_line(world, grasp, 1);
  grip(world, 0);
  REQUIRE(world.grasped() == drawer);
  move_line(world, translation(-0.15, 0, 0) * grasp, 3);
  CHECK(world.joint_position(drawer) == Approx(0.15).margin(0.003));
  CHECK(where - place_of(world, "toy").x() == Approx(0.15).margin(0.005));
}

TEST_CASE("a world of sleepers returns to a snapshot bit for bit, also in another world", "[sim]") {
  const auto scene = shared(tower(4));
  World world(scene), other(scene);
  run(world, 1);
  world.apply(operation::Boundary{});
  const Snapshot snapshot = world.snapshot();
  std::vector<std::string> hashes[3];
  for (int i = 0; i < 3; ++i) {
    World& played = i == 2 ? other : world;
    if (i > 0) played.restore(snapshot);
    for (int step = 0; step < 120; ++step) {
      played.step();
      if (step % 12 == 11) played.close_window();
      hashes[i].push_back(played.state_hash());
    }
    CHECK(still(played, "stone0"));
  }
  CHECK(hashes[0] == hashes[1]);
  CHECK(hashes[0] == hashes[2]);
}
