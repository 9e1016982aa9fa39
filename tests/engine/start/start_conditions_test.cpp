// Conditions on a start: all that is asked of a thing is known before it is put somewhere, what is quick first; what
// was asked in vain is counted by its cause.
#include <catch2/catch.hpp>

#include "engine/start/impasse.h"
#include "engine/start/part_questions.h"
#include "engine/start/start.h"
#include "tests/support/make_start.h"
#include "tests/support/plain_task.h"

using namespace stampede;
using namespace stampede::plain;

namespace {

// Beside those of plain tasks: (far a b), middles 40 cm from each other; (west a), within 4 cm of the table's far edge;
// (reach a), two grasps of it; (lit a), which nothing can make.
class Conditions : public PlainSymbols {
 public:
  Conditions() : domain_(plain::domain()) {
    const Parameter a{"a", "", {"movable"}}, b{"b", "", {"movable"}};
    domain_.predicates.push_back({"far", {a, b}, PredicateKind::start, {}, "far"});
    domain_.predicates.push_back({"west", {a}, PredicateKind::start, {}, "west"});
    domain_.predicates.push_back({"reach", {a}, PredicateKind::start, {}, "reach"});
    domain_.predicates.push_back({"lit", {a}, PredicateKind::basic, {}, "lit"});
  }
  const Domain& domain() const override { return domain_; }
  PredicateTraits traits(const std::string& predicate) const override {
    PredicateTraits traits = PlainSymbols::traits(predicate);
    traits.sampled = predicate == "on";
    if (predicate == "far" || predicate == "west") traits.margin_unit = "m";
    return traits;
  }
  Value value(const Fact& fact, const WorldView& view) override {
    const auto at = [&](std::size_t i) -> Vector3 { return view.world_from(fact.arguments[i]).translation(); };
    if (fact.predicate == "far") return with_margin((at(0) - at(1)).norm() - 0.4);
    if (fact.predicate == "west") return with_margin(at(0).x() - 0.67);
    if (fact.predicate == "lit") return {};
    if (fact.predicate != "reach") return PlainSymbols::value(fact, view);
    ++asked;
    asked_in_vain += at(0).x() < 0.67 ? 1 : 0;
    return {can_grasp(view, fact.arguments[0], {}, turned_down_), {}, true};
  }
  void watch(std::vector<Looked>* turned_down) override { turned_down_ = turned_down; }
  std::string asked_at(const Fact& fact) const override { return fact.predicate == "reach" ? "tasks/t.lua:7" : ""; }

  int asked = 0, asked_in_vain = 0;

 private:
  static Value with_margin(double margin) { return {margin >= 0, margin}; }
  Domain domain_;
  std::vector<Looked>* turned_down_ = nullptr;
};

TaskDraw with(std::vector<Literal> conditions, int cubes = 2, double table_x = 0) {
  return [=](int) {
    Task task = stack_task(cubes);
    task.init.insert(task.init.begin(), conditions.begin(), conditions.end());
    task.scene.bodies[static_cast<std::size_t>(task.scene.body_index("table"))].world_from_body.translation().x() +=
        table_x;
    return task;
  };
}

Literal is(const char* predicate, std::vector<std::string> arguments) {
  return {{predicate, std::move(arguments)}, false};
}

Start start_of(const TaskDraw& task, Conditions& symbols, std::int64_t seed, int draws = 20) {
  RunOptions options;
  options.seed = seed;
  options.draws = draws;
  return make_start(task, symbols, options);
}

bool tells(const Start& start, const std::string& text) { return start.detail.find(text) != std::string::npos; }

}  // namespace

TEST_CASE("what is quickly asked of a place goes before what asks the arm, in whatever order a task names them") {
  for (int seed = 0; seed < 6; ++seed) {
    Conditions symbols;
    const Start start = start_of(with({is("reach", {"cube1"}), is("west", {"cube1"})}), symbols, seed);
    INFO(seed << ": " << start.detail);
    REQUIRE(start.reason == Reason::none);
    CHECK(start.draws == 1);
    CHECK(symbols.asked_in_vain <= 1);  // until it is known to ask the arm
    CHECK(symbols.asked <= 12);
  }
}

TEST_CASE("a thing that leaves the next one no place goes elsewhere, without a new draw") {
  int first = 0;
  for (int seed = 0; seed < 10; ++seed) {
    Conditions symbols;
    const Start start =
        start_of(with({is("far", {"cube2", "cube1"}), is("far", {"cube3", "cube1"})}, 3), symbols, seed);
    INFO(seed << ": " << start.detail);
    REQUIRE(start.reason == Reason::none);
    first += start.draws == 1 ? 1 : 0;
    World world(start.scene);
    CHECK(symbols.value({"far", {"cube2", "cube1"}}, WorldView(world)).holds);
    CHECK(symbols.value({"far", {"cube3", "cube1"}}, WorldView(world)).holds);
  }
  CHECK(first >= 9);
}

TEST_CASE("a thing out of reach: how often, how far, at which line, and the cure") {
  Conditions symbols;
  const Start start = start_of(with({is("reach", {"cube1"})}, 2, 0.6), symbols, 1, 5);
  INFO(start.detail);
  CHECK(start.reason == Reason::init_impossible);
  CHECK(tells(start, "tasks/t.lua:7: (reach cube1) failed 5 times: 5 out of reach"));
  CHECK(tells(start, " at least, 1."));
  CHECK(tells(start, " m from the arm)"));
  CHECK(tells(start, "; bring cube1 nearer to panda"));
}

TEST_CASE("a thing that the hand cannot take for another: which one") {
  const TaskDraw walled = [](int) {
    Task task = stack_task(1);
    Body& table = task.scene.bodies[static_cast<std::size_t>(task.scene.body_index("table"))];
    table.parts[0].shapes[0].size = {0.06, 0.06, 0.05};
    const Shape top = table.parts[0].shapes[0];
    for (const double way : {-0.036, 0.036})
      for (const bool along : {true, false}) {
        Shape wall = top;
        wall.size = along ? Vector3(0.01, 0.08, 0.10) : Vector3(0.08, 0.01, 0.10);
        wall.part_from_shape = along ? translation(way, 0, 0.075) : translation(0, way, 0.075);
        table.parts[0].shapes.push_back(wall);
      }
    task.init.push_back(is("reach", {"cube1"}));
    task.goal = atom("holding", {{false, "panda.hand"}, {false, "cube1"}});
    return task;
  };
  Conditions symbols;
  const Start start = start_of(walled, symbols, 1, 5);
  INFO(start.detail);
  CHECK(start.reason == Reason::init_impossible);
  CHECK(tells(start, "touch table"));
  CHECK(tells(start, "keep table away from cube1"));
}

// cube1 has its place, beyond the far edge of the table; cube2 is placed. The arm starts elsewhere in each draw.
TEST_CASE("what no draw changes is asked of the arm once more, not in each draw") {
  const TaskDraw fixed = [](int draw) {
    Task task = stack_task(2);
    Robot& robot = task.scene.robot;
    robot.body.parts[static_cast<std::size_t>(robot.arm[0])].joint.initial += 0.002 * draw;
    task.scene.bodies[static_cast<std::size_t>(task.scene.body_index("cube1"))].world_from_body =
        translation(1.1, 0, 0);
    task.unplaced = {"cube2"};
    task.init = {is("reach", {"cube1"}), is("on", {"cube2", "table"})};
    return task;
  };
  Conditions symbols;
  const Start start = start_of(fixed, symbols, 1, 100);
  INFO(start.detail);
  CHECK(start.reason == Reason::init_impossible);
  CHECK(symbols.asked <= 6);  // twice, once with nothing else there, and to tell why
  CHECK(tells(start, "(reach cube1) failed 100 times: 100 out of reach"));
  CHECK(tells(start, "; bring cube1 nearer to panda"));
}

TEST_CASE("what stands in the way in some draws only is asked for in the others, however often it was in vain before") {
  constexpr int kFree = 6;  // the first draw without walls
  const TaskDraw walled_at_first = [](int draw) {
    Task task = stack_task(2);
    Body& table = task.scene.bodies[static_cast<std::size_t>(task.scene.body_index("table"))];
    const Shape top = table.parts[0].shapes[0];
    const Vector3 cube =
        task.scene.bodies[static_cast<std::size_t>(task.scene.body_index("cube1"))].world_from_body.translation();
    for (const double way : {-0.036, 0.036})
      for (const bool along : {true, false}) {
        if (draw >= kFree) continue;
        Shape wall = top;
        wall.size = along ? Vector3(0.01, 0.08, 0.10) : Vector3(0.08, 0.01, 0.10);
        wall.part_from_shape = table.world_from_body.inverse() *
                               translation(cube.x() + (along ? way : 0), cube.y() + (along ? 0 : way), 0.055);
        table.parts[0].shapes.push_back(wall);
      }
    task.unplaced = {"cube2"};
    task.init = {is("reach", {"cube1"}), is("on", {"cube2", "table"})};
    return task;
  };
  Conditions symbols;
  const Start start = start_of(walled_at_first, symbols, 1);
  INFO(start.detail);
  REQUIRE(start.reason == Reason::none);
  CHECK(start.draws == kFree + 1);
}

TEST_CASE("a start is given up after ten draws with the same collision, not after a few that are alike by chance") {
  const auto free_from = [](int draws) -> TaskDraw {
    return [draws](int draw) {
      Task task = stack_task(2);
      Body& table = task.scene.bodies[static_cast<std::size_t>(task.scene.body_index("table"))];
      const Body& cube = task.scene.bodies[static_cast<std::size_t>(task.scene.body_index("cube1"))];
      Shape block = table.parts[0].shapes[0];
      block.size = {0.04, 0.04, 0.04};
      block.part_from_shape = table.world_from_body.inverse() * cube.world_from_body;
      if (draw < draws) table.parts[0].shapes.push_back(block);
      task.unplaced.clear();
      return task;
    };
  };
  Conditions symbols;
  const Start late = start_of(free_from(6), symbols, 1);
  INFO(late.detail);
  CHECK(late.reason == Reason::none);
  CHECK(late.draws == 7);
  const Start never = start_of(free_from(1000), symbols, 1);
  INFO(never.detail);
  CHECK(never.reason == Reason::init_impossible);
  CHECK(never.draws == 10);
  CHECK(tells(never, "cube1"));
}

TEST_CASE("of what has a margin it is told how much is missing, of what nothing makes that nothing does") {
  Conditions symbols;
  const Start far = start_of(with({is("far", {"cube1", "cube2"}),
                                   is("far", {"cube2", "cube1"}),
                                   is("west", {"cube1"}),
                                   {{"west", {"cube1"}}, true}}),
                             symbols, 1, 5);
  INFO(far.detail);
  CHECK(far.reason == Reason::init_impossible);
  CHECK(tells(far, "(west cube1)"));
  CHECK(tells(far, " mm at least"));
  const Start lit = start_of(with({is("lit", {"cube1"})}), symbols, 1, 4);
  INFO(lit.detail);
  CHECK(tells(lit, "(lit cube1) failed 4 times; nothing makes it so: 'lit' has no `sample`"));
}

TEST_CASE("who asks why is shown each grasp of a start that cannot be, in the scene of that moment") {
  Conditions symbols;
  std::vector<Impasse> told;
  RunOptions options;
  options.draws = 3;
  options.services.witness = [&](const Impasse& impasse) { told.push_back(impasse); };
  make_start(with({is("reach", {"cube1"})}, 2, 0.6), symbols, options);
  REQUIRE(told.size() == 1);
  CHECK(told[0].step == "init (reach cube1)");
  CHECK(told[0].subject == "cube1");
  CHECK(told[0].draws == 3);
  REQUIRE_FALSE(told[0].looked.empty());
  CHECK(told[0].looked[0].opening > 0);
  CHECK(told[0].scene->body_index("cube1") >= 0);
}
