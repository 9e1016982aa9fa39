// Where things are beside others: one point of view, places that make it true, facts where a task names them.
#include "engine/start/relations.h"

#include <catch2/catch.hpp>

#include "engine/sim/world.h"
#include "engine/start/language.h"
#include "engine/start/start.h"
#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

std::shared_ptr<const Library> spatial() {
  static const std::shared_ptr<const Library> shared =
      Library::load(Roots{{STAMPEDE_SOURCE_DIR, STAMPEDE_SOURCE_DIR "/tests/tasks/spatial"}});
  return shared;
}

EpisodeRecord run_spatial(const std::string& task, const std::string& variation, std::int64_t seed) {
  RunOptions options;
  options.seed = seed;
  return run_task(task, variation, options, spatial());
}

// Three cubes where one says, x and y in m, on the table.
class CubesAt {
 public:
  CubesAt() : scripts_(spatial(), "three_at_once", "", 1), scene_(scripts_.task()(0).scene) {}
  void put(const std::string& name, double x, double y, double yaw = 0) {
    Body& body = scene_.bodies[static_cast<std::size_t>(scene_.body_index(name))];
    body.world_from_body = translation(x, y, 0.77) * Eigen::AngleAxisd(yaw, Vector3::UnitZ());
  }
  void recolour(const std::string& name, const std::string& colour) {
    for (Object& object : scene_.objects)
      if (object.name == name) object.attributes["colour"] = colour;
  }
  std::string called(const std::string& name) const { return phrase(scene_, name); }
  // Of the thing's middle in the front camera's picture, from the left; in focal lengths.
  double column(const std::string& name) const {
    const auto front = std::ranges::find(scene_.cameras, "front", &Camera::name);
    const Body& body = scene_.bodies[static_cast<std::size_t>(scene_.body_index(name))];
    const Vector3 seen = front->mount_from_camera.inverse() * body.world_from_body.translation();
    return seen.x() / seen.z();
  }
  void turn_robot(double yaw) { scene_.robot.body.world_from_body.rotate(Eigen::AngleAxisd(yaw, Vector3::UnitZ())); }
  Symbols::Value value(const std::string& predicate, std::vector<std::string> arguments) {
    World world(std::make_shared<const Scene>(scene_));
    const WorldView view(world);
    return scripts_.symbols().value({predicate, std::move(arguments)}, view);
  }
  // Holds exactly where its margin is not negative.
  double margin(const std::string& predicate, std::vector<std::string> arguments) {
    const Symbols::Value found = value(predicate, std::move(arguments));
    CHECK(found.holds == (found.margin.value() >= 0));
    return *found.margin;
  }

 private:
  EpisodeScripts scripts_;
  Scene scene_;
};

bool names_relation(const FactRecord& one) {
  const std::set<std::string> all = {"left_of", "right_of", "in_front_of", "beyond", "between", "near"};
  return all.contains(one.fact.predicate);
}

std::vector<Fact> at_the_end(const EpisodeRecord& episode) {
  std::vector<Fact> facts;
  for (const FactRecord& one : episode.labels.facts)
    if (one.open_end && names_relation(one)) facts.push_back(one.fact);
  return facts;
}

}  // namespace

TEST_CASE("left, right, front and beyond are seen by who stands opposite the robot, as in the front camera's picture") {
  CubesAt cubes;
  cubes.put("blue_cube", 0.2, 0);
  cubes.put("red_cube", 0.2, -0.1);
  cubes.put("green_cube", 0.5, 0.5);
  CHECK(cubes.margin("left_of", {"red_cube", "blue_cube"}) == Approx(0.06).margin(1e-6));
  CHECK(cubes.margin("right_of", {"red_cube", "blue_cube"}) == Approx(-0.14).margin(1e-6));
  CHECK(cubes.margin("right_of", {"blue_cube", "red_cube"}) == Approx(0.06).margin(1e-6));
  CHECK(cubes.margin("in_front_of", {"red_cube", "blue_cube"}) == Approx(-0.1).margin(1e-6));
  CHECK(cubes.column("red_cube") < cubes.column("blue_cube"));
  cubes.put("red_cube", 0.3, 0.02);  // further from the robot, nearer to the camera
  CHECK(cubes.margin("in_front_of", {"red_cube", "blue_cube"}) == Approx(0.06).margin(1e-6));
  CHECK(cubes.margin("beyond", {"blue_cube", "red_cube"}) == Approx(0.06).margin(1e-6));
  CHECK(cubes.margin("left_of", {"red_cube", "blue_cube"}) == Approx(-0.12).margin(1e-6));
  cubes.turn_robot(std::numbers::pi / 2);  // it looks along +y: the left of who looks at it is +x
  CHECK(cubes.margin("left_of", {"red_cube", "blue_cube"}) == Approx(0.06).margin(1e-6));
  CHECK(cubes.margin("in_front_of", {"red_cube", "blue_cube"}) < 0);
}

TEST_CASE("sentences that tell things apart have the same left as the relation") {
  CubesAt cubes;
  cubes.recolour("green_cube", "red");
  cubes.put("blue_cube", 0.5, 0.5);
  cubes.put("red_cube", 0.2, -0.1);
  cubes.put("green_cube", 0.2, 0.1);
  CHECK(cubes.margin("left_of", {"red_cube", "green_cube"}) > 0);
  CHECK(cubes.called("red_cube") == "left red cube");
  CHECK(cubes.called("green_cube") == "right red cube");
}

TEST_CASE("a thing is at one side only: the one at which it is furthest off, wholly beside the other") {
  CubesAt cubes;
  cubes.put("blue_cube", 0.2, 0);
  cubes.put("green_cube", 0.5, 0.5);
  cubes.put("red_cube", 0.26, -0.08);
  CHECK(cubes.margin("left_of", {"red_cube", "blue_cube"}) == Approx(0.02).margin(1e-6));
  CHECK(cubes.margin("in_front_of", {"red_cube", "blue_cube"}) == Approx(-0.02).margin(1e-6));
  cubes.put("red_cube", 0.2, -0.03);  // they would be in each other, seen from above
  CHECK(cubes.margin("left_of", {"red_cube", "blue_cube"}) == Approx(-0.01).margin(1e-6));
  cubes.put("red_cube", 0.2, -0.045, std::numbers::pi / 4);  // turned, it is wider
  CHECK(cubes.margin("left_of", {"red_cube", "blue_cube"}) == Approx(0.025 - 0.02 * std::sqrt(2)).margin(1e-6));
}

TEST_CASE("near counts from box to box, between is past the one, before the other and near their line") {
  CubesAt cubes;
  cubes.put("blue_cube", 0.2, -0.1);
  cubes.put("green_cube", 0.2, 0.1);
  cubes.put("red_cube", 0.2, 0);
  CHECK(cubes.margin("near", {"red_cube", "blue_cube"}) == Approx(0.02).margin(1e-6));
  CHECK(cubes.margin("near", {"green_cube", "blue_cube"}) == Approx(-0.08).margin(1e-6));
  CHECK(cubes.margin("between", {"red_cube", "blue_cube", "green_cube"}) == Approx(0.05).margin(1e-6));
  CHECK(cubes.margin("between", {"red_cube", "green_cube", "blue_cube"}) == Approx(0.05).margin(1e-6));
  CHECK(cubes.margin("between", {"blue_cube", "red_cube", "green_cube"}) < 0);
  cubes.put("red_cube", 0.26, 0);  // 6 cm off a line of 20 cm: a quarter is 5
  CHECK(cubes.margin("between", {"red_cube", "blue_cube", "green_cube"}) == Approx(-0.01).margin(1e-6));
  cubes.put("red_cube", 0.2, 0.07);
  CHECK(cubes.margin("between", {"red_cube", "blue_cube", "green_cube"}) == Approx(-0.01).margin(1e-6));
}

TEST_CASE("a goal of relations is planned and done with the skills that ship") {
  const std::vector<std::pair<std::string, std::string>> tasks = {{"red_left_of_blue", ""},
                                                                  {"red_at_a_side", "side=left_of"},
                                                                  {"red_at_a_side", "side=in_front_of"},
                                                                  {"left_is_taken", ""},
                                                                  {"red_at_a_side", "side=right_of"},
                                                                  {"red_at_a_side", "side=beyond"},
                                                                  {"three_at_once", ""},
                                                                  {"in_a_row", ""},
                                                                  {"either_side", ""}};
  for (const auto& [task, variation] : tasks)
    for (const std::int64_t seed : {1, 2, 3}) {
      const EpisodeRecord episode = run_spatial(task, variation, seed);
      INFO(task + " " + variation + " seed " + std::to_string(seed) + ": " + verdict(episode));
      CHECK(episode.outcome == Outcome::success);
    }
}

TEST_CASE("one placing meets all that is asked of the thing") {
  const EpisodeRecord episode = run_spatial("three_at_once", "", 1);
  INFO(verdict(episode));
  REQUIRE(episode.outcome == Outcome::success);
  const std::vector<Fact> facts = at_the_end(episode);
  for (const Fact& fact : {Fact{"between", {"red_cube", "blue_cube", "green_cube"}},
                           Fact{"near", {"red_cube", "blue_cube"}}, Fact{"left_of", {"red_cube", "green_cube"}}})
    CHECK(std::ranges::find(facts, fact) != facts.end());
}

TEST_CASE("relations are facts of those tasks alone that name them, and never of hands") {
  const EpisodeRecord named = run_spatial("red_left_of_blue", "", 1);
  std::set<std::string> predicates;
  for (const FactRecord& one : named.labels.facts) {
    if (!names_relation(one)) continue;
    predicates.insert(one.fact.predicate);
    CHECK(std::ranges::find(one.fact.arguments, "panda.hand") == one.fact.arguments.end());
  }
  CHECK(predicates == std::set<std::string>{"left_of"});
  RunOptions options;
  options.seed = 1;
  const EpisodeRecord other = run_task("pick_and_lift", first_variation("pick_and_lift"), options, spatial());
  CHECK(std::ranges::none_of(other.labels.facts, names_relation));
}

TEST_CASE("the plan's own domain says who makes a relation and who ends it") {
  EpisodeScripts scripts(spatial(), "red_left_of_blue", "", 1);
  const Task task = scripts.task()(0);
  World world(std::make_shared<const Scene>(task.scene));
  const WorldView view(world);
  CHECK(named_by(task, scripts.symbols()) == std::set<std::string>{"left_of"});
  FactTracker facts(scripts.symbols(), view, named_by(task, scripts.symbols()));
  facts.begin({});
  const std::vector<Literal> asked = relations_asked(task, facts);
  REQUIRE(asked.size() == 1);
  CHECK(asked.front().fact == Fact{"left_of", {"red_cube", "blue_cube"}});
  CHECK_FALSE(asked.front().negated);
}

TEST_CASE("a start leaves room for the relations that the goal asks for") {
  EpisodeScripts scripts(spatial(), "in_a_row", "", 1);
  const PreparedStart start = prepare_start(scripts.task(), scripts.symbols(), {});
  REQUIRE(start.reason == Reason::none);
  const auto without_room = [&](double green_y) {
    Scene scene = *start.scene;
    const double y_of[] = {green_y, 0.1, 0.2};
    const char* names[] = {"green_cube", "blue_cube", "red_cube"};
    for (int i = 0; i < 3; ++i) {
      Body& cube = scene.bodies[static_cast<std::size_t>(scene.body_index(names[i]))];
      cube.world_from_body = translation(0.25, y_of[i], cube.world_from_body.translation().z());
    }
    World world(std::make_shared<const Scene>(scene));
    for (int i = 0; i < 60; ++i) world.step();
    world.close_window();
    const WorldView view(world);
    FactTracker facts(scripts.symbols(), view, named_by(start.task, scripts.symbols()));
    facts.begin(facts.read_all(view));
    return relation_without_room(relations_asked(start.task, facts), facts, view, scripts.symbols(), RandomKey("test"));
  };
  World world(start.scene);
  const double side = WorldView(world).size("table").y() / 2;
  const auto at_the_edge = without_room(0.095 - side);  // room for one cube beside it, not for two
  REQUIRE(at_the_edge);
  CHECK(at_the_edge->fact == Fact{"left_of", {"red_cube", "blue_cube"}});
  CHECK_FALSE(without_room(0));
  const EpisodeRecord once_without_room = run_spatial("in_a_row", "", 525);
  INFO(verdict(once_without_room));
  CHECK(once_without_room.outcome == Outcome::success);
}
