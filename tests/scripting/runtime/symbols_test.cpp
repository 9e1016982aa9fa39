#include <catch2/catch.hpp>

#include "engine/sim/collision_state.h"
#include "engine/sim/world.h"
#include "scripts_fixture.h"

using namespace stampede;
using test::SmallWorld;

namespace {

Vector3 position(const Placement& placement) { return std::get<Transform>(placement.value).translation(); }

}  // namespace

TEST_CASE("a classifier reads the world, and its second result is the margin") {
  SmallWorld small;  // both cubes at z = 0.52
  const Symbols::Value value = small.scripts.symbols().value({"higher", {"cube", "top"}}, small.view);
  CHECK_FALSE(value.holds);
  REQUIRE(value.margin.has_value());
  CHECK(*value.margin == Approx(0.0).margin(1e-12));
  small.world.apply(operation::Place{small.world.scene().body_index("top"), translation(0.2, 0.1, 0.62)});
  const Symbols::Value lower = small.scripts.symbols().value({"higher", {"cube", "top"}}, small.view);
  const Symbols::Value higher = small.scripts.symbols().value({"higher", {"top", "cube"}}, small.view);
  CHECK(*lower.margin == Approx(-0.1));
  CHECK(higher.holds);
  CHECK(*higher.margin == Approx(0.1));
}

TEST_CASE("a predicate that extends another holds where both do, with the lesser margin and the other's samples") {
  SmallWorld small;
  Symbols& symbols = small.scripts.symbols();
  const auto value = [&] { return symbols.value({"much_higher", {"top", "cube"}}, small.view); };
  const int top = small.world.scene().body_index("top");
  CHECK_FALSE(value().holds);
  small.world.apply(operation::Place{top, translation(0.2, 0.1, 0.54)});
  CHECK_FALSE(value().holds);  // higher, but not by as much
  CHECK(*value().margin == Approx(-0.02));
  small.world.apply(operation::Place{top, translation(0.2, 0.1, 0.58)});
  CHECK(value().holds);
  CHECK(*value().margin == Approx(0.02));
  small.world.apply(operation::Place{top, translation(0.2, 0.1, 0.50)});
  CHECK(*value().margin == Approx(-0.02));  // of the first test, which fails
  const CollisionState state = small.world.collision_state();
  CHECK(symbols.sample({"much_higher", {"cube", "top"}}, small.view, state, RandomKey("test"), 8).size() == 2);
}

TEST_CASE("joints, numbers and the hand are read by name") {
  SmallWorld small;
  Symbols& symbols = small.scripts.symbols();
  CHECK_FALSE(symbols.value({"open", {"chest.drawer"}}, small.view).holds);
  CHECK(symbols.value({"hand_empty", {"mini.hand"}}, small.view).holds);
  CHECK_FALSE(symbols.value({"holding", {"mini.hand", "cube"}}, small.view).holds);
}

TEST_CASE("traits and attributes are facts without a script") {
  SmallWorld small;
  Symbols& symbols = small.scripts.symbols();
  CHECK(symbols.value({"openable", {"chest.drawer"}}, small.view).holds);
  CHECK_FALSE(symbols.value({"openable", {"cube"}}, small.view).holds);
  CHECK(symbols.value({"colour", {"cube", "white"}}, small.view).holds);
  CHECK_FALSE(symbols.value({"colour", {"cube", "red"}}, small.view).holds);
  CHECK(symbols.value({"material", {"cube", "wood"}}, small.view).holds);
}

TEST_CASE("an error in a classifier names file and line") {
  SmallWorld small;
  CHECK_THROWS_WITH(small.scripts.symbols().value({"broken", {"cube"}}, small.view),
                    Catch::Contains("broken.lua:2") && Catch::Contains("nothing"));
}

TEST_CASE("samples are poses of the first argument or joint positions, and a function of the key") {
  SmallWorld small;
  Symbols& symbols = small.scripts.symbols();
  const CollisionState state = small.world.collision_state();
  const RandomKey key = RandomKey("test").with(1);
  const auto poses = symbols.sample({"higher", {"cube", "top"}}, small.view, state, key, 8);
  REQUIRE(poses.size() == 2);
  CHECK(poses[0].object == "cube");
  CHECK((position(poses[0]) - Vector3(0.2, 0.1, 0.62)).norm() < 1e-9);
  CHECK((position(poses[1]).z() >= 0.72 && position(poses[1]).z() < 0.82));
  const auto again = symbols.sample({"higher", {"cube", "top"}}, small.view, state, key, 8);
  CHECK(position(again[1]) == position(poses[1]));
  const auto other = symbols.sample({"higher", {"cube", "top"}}, small.view, state, key.with(1), 8);
  CHECK(position(other[1]) != position(poses[1]));
  CHECK(symbols.sample({"higher", {"cube", "top"}}, small.view, state, key, 1).size() == 1);

  const auto joints = symbols.sample({"open", {"chest.drawer"}}, small.view, state, key, 8);
  REQUIRE(joints.size() == 8);
  for (const Placement& placement : joints) {
    CHECK(placement.object == "chest.drawer");
    const double q = std::get<double>(placement.value);
    CHECK((q >= 0.15 && q <= 0.2));
  }
  CHECK(symbols.sample({"holding", {"mini.hand", "cube"}}, small.view, state, key, 8).empty());
}

TEST_CASE("built-in spots lie on the surface") {
  SmallWorld small;
  const CollisionState state = small.world.collision_state();
  const auto spots =
      small.scripts.symbols().sample({"on", {"cube", "bench"}}, small.view, state, RandomKey("spots"), 5);
  REQUIRE_FALSE(spots.empty());
  for (const Placement& spot : spots) {
    CHECK(position(spot).z() == Approx(0.52).margin(0.002));  // half a cube above the top
    CHECK(position(spot).head<2>().cwiseAbs().maxCoeff() <= 0.5);
  }
}

TEST_CASE("nothing that a script keeps survives a skill boundary, and no sample sees another") {
  SmallWorld small;
  Symbols& symbols = small.scripts.symbols();
  const Fact counted{"counted", {"cube"}};
  CHECK(*symbols.value(counted, small.view).margin == 1.0);
  CHECK(*symbols.value(counted, small.view).margin == 2.0);  // one state between boundaries
  SkillCall call{"counting", "", {"cube", "bench", "mini.hand"}, {}, ControllerKind::joint_position, 0};
  auto run = small.scripts.skills().start(call, small.view);
  CHECK(*symbols.value(counted, small.view).margin == 1.0);
  CHECK(*symbols.value(counted, small.view).margin == 2.0);
  run.reset();
  CHECK(*symbols.value(counted, small.view).margin == 1.0);
  const CollisionState state = small.world.collision_state();
  for (int i = 0; i < 3; ++i) {
    const auto ways = symbols.sample(counted, small.view, state, RandomKey("k"), 4);
    REQUIRE(ways.size() == 1);
    CHECK(position(ways[0]).x() == Approx(1.0));  // the first sample of a fresh state, each time
  }
  EpisodeScripts next(test::small_library(), "steps", "", 7);
  CHECK(*next.symbols().value(counted, small.view).margin == 1.0);
}
