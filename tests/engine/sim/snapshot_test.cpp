// Snapshots restore the same future, bit for bit; logs replay; worlds do not meet.
#include <catch2/catch.hpp>
#include <thread>

#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

namespace {

// A drawer with a toy inside, a latched door, a button under a block, cubes, a mug of two shapes.
std::shared_ptr<const Scene> busy_scene() {
  Scene scene = table_scene(3);
  add_body(scene, chest({0.72, 0.4, 0.01}));
  add_body(scene, latched_door({0.9, -0.3, 0.16}));
  add_body(scene, button({0.3, -0.4, 0.01}));
  add_body(scene, box_body("toy", Vector3::Constant(0.04), {0.72, 0.4, 0.0505}, 0.1));
  add_body(scene, box_body("weight", {0.05, 0.05, 0.03}, {0.3, -0.4, 0.06}, 0.5));
  Body mug = box_body("mug", {0.06, 0.06, 0.02}, {0.35, 0.35, 0.012}, 0.2);
  Shape ball;
  ball.kind = ShapeKind::sphere;
  ball.radius = 0.02;
  ball.part_from_shape = translation(0.02, 0.01, 0.02);
  mug.parts[0].shapes.push_back(ball);
  set_uniform_mass(mug.parts[0], 0.2);
  add_body(scene, mug);
  return shared(scene);
}

// One stretch of a story in which things are grasped, carried and pushed.
void act(World& world, int stretch) {
  const Vector3 cube(0.4, -0.2, 0.02);
  switch (stretch) {
    case 0:
      move_to(world, solve(world, tip_down(cube.x(), cube.y(), 0.12), world.arm().home()), 1);
      break;
    case 1:
      move_line(world, tip_down(cube.x(), cube.y(), cube.z()), 0.5);
      world.apply(operation::Hand{0, 20});
      run(world, 0.13);  // the fingers are closing
      break;
    case 2:
      run(world, 0.5);
      world.apply(operation::Controller{ControllerKind::cartesian_impedance, 0});
      move_line(world, tip_down(cube.x(), cube.y(), 0.15), 0.7);
      break;
    case 3:
      move_line(world, tip_down(0.45, 0.1, 0.1), 0.7);
      world.apply(operation::Controller{ControllerKind::joint_impedance, 300});
      run(world, 0.21);
      break;
    default:
      world.apply(operation::Hand{0.08, 20});
      move_line(world, tip_down(0.45, -0.1, 0.05), 0.5);
      world.apply(operation::Controller{});
      run(world, 0.2);
  }
}

void act_stepwise(World& world, const std::vector<Command>& commands, std::size_t from, std::int64_t until,
                  std::vector<std::string>& hashes) {
  std::size_t next = from;
  for (;;) {
    for (; next < commands.size() && commands[next].step == world.step_count(); ++next)
      world.apply(commands[next].operation);
    if (world.step_count() >= until) return;
    world.step();
    if (world.step_count() % 12 == 0) world.close_window();
    hashes.push_back(world.state_hash());
  }
}

}  // namespace

TEST_CASE("a replayed log gives the same state at every step", "[sim]") {
  const auto scene = busy_scene();
  World original(scene);
  for (int stretch = 0; stretch < 5; ++stretch) {
    act(original, stretch);
    original.apply(operation::Boundary{});
  }
  const auto commands = original.log();
  std::vector<std::string> once, twice, threaded;
  World first(scene), second(scene);
  act_stepwise(first, commands, 0, original.step_count(), once);
  CHECK(first.state_hash() == original.state_hash());

  std::vector<Command> decoded;  // through the bytes that catalogues hold
  for (const Command& command : commands)
    decoded.push_back(
        {command.step, operation_from_bytes(operation_kind(command.operation), operation_to_bytes(command.operation))});
  World third(scene);
  std::thread other([&] { act_stepwise(third, decoded, 0, original.step_count(), threaded); });
  act_stepwise(second, decoded, 0, original.step_count(), twice);
  other.join();
  CHECK(once == twice);
  CHECK(once == threaded);
  CHECK(once.size() == static_cast<std::size_t>(original.step_count()));
}

TEST_CASE("restoring gives the same future, in the same world and in a fresh one", "[sim]") {
  const auto scene = busy_scene();
  World world(scene);
  std::vector<Snapshot> snapshots;
  for (int stretch = 0; stretch < 5; ++stretch) {
    world.apply(operation::Boundary{});
    snapshots.push_back(world.snapshot());
    act(world, stretch);
  }
  const auto commands = world.log();
  const std::int64_t end = world.step_count();
  const std::string end_hash = world.state_hash();
  const auto end_contacts = world.contacts();
  CHECK(world.joint_position({world.scene().body_index("button"), 1}) > 0.003);  // pressed by the weight

  for (const Snapshot& snapshot : snapshots) {
    std::vector<std::string> same, fresh;
    world.restore(snapshot);
    const std::size_t length = world.log().size();
    CHECK(world.log().size() < commands.size());
    act_stepwise(world, commands, length, end, same);
    CHECK(world.state_hash() == end_hash);
    CHECK(world.log().size() == commands.size());
    REQUIRE(world.contacts().size() == end_contacts.size());
    for (std::size_t i = 0; i < end_contacts.size(); ++i) CHECK(world.contacts()[i].force == end_contacts[i].force);

    World other(scene);
    other.restore(snapshot);
    CHECK(other.log().size() == length);
    act_stepwise(other, commands, length, end, fresh);
    CHECK(same == fresh);
    CHECK(other.state_hash() == end_hash);
  }
}

TEST_CASE("a snapshot between boundaries or of another scene is refused", "[sim]") {
  World world(shared(table_scene(1))), other(shared(table_scene(2)));
  const Snapshot snapshot = world.snapshot();  // just built counts as a boundary
  world.step();
  CHECK_THROWS_WITH(world.snapshot(), Catch::Contains("Boundary"));
  CHECK_THROWS_WITH(other.restore(snapshot), Catch::Contains("another scene"));
}

TEST_CASE("a placed body is where it was placed, at rest", "[sim]") {
  World world(shared(table_scene(1)));
  const PartRef cube{body_index(world, "cube1"), 0};
  run(world, 0.2);
  world.apply(operation::Place{cube.body, translation(0.6, 0.3, 0.02) * rotation_rpy(0, 0, 0.5)});
  CHECK((world.world_from_part(cube).translation() - Vector3(0.6, 0.3, 0.02)).norm() < 1e-12);
  run(world, 0.5);
  CHECK((world.world_from_part(cube).translation() - Vector3(0.6, 0.3, 0.02)).norm() < 5e-4);
  CHECK_THROWS_AS(world.apply(operation::Place{0, Transform::Identity()}), std::exception);  // the table
}
