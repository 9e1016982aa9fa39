// What is in the way of a skill is found, named, and moved first.
#include <catch2/catch.hpp>

#include "engine/start/planning.h"
#include "engine/symbolic/task_planner.h"
#include "tests/support/make_start.h"
#include "tests/support/plain_task.h"

using namespace stampede;
using namespace stampede::plain;

namespace {

// cube1 stands between two walls; the fingers need the other two sides, and cube2 stands 8 mm off one of these.
Task niche_of(int cubes) {
  Task task = stack_task(cubes);
  Scene& scene = task.scene;
  const auto cube = [&](const char* name) -> Body& {
    return scene.bodies[static_cast<std::size_t>(scene.body_index(name))];
  };
  cube("cube1").world_from_body = translation(0.45, 0, 0.02);
  cube("cube2").world_from_body = translation(0.498, 0, 0.02);
  for (Object& object : scene.objects)  // nothing is put down on cubes here
    if (object.type == "cube") object.traits = {"graspable", "movable"};
  for (const double side : {-1.0, 1.0}) {
    Body wall = cube("cube1");
    wall.name = side < 0 ? "wall1" : "wall2";
    wall.free = false;
    wall.parts[0].shapes[0].size = {0.04, 0.03, 0.04};
    wall.world_from_body = translation(0.45, side * 0.042, 0.02);
    scene.bodies.insert(scene.bodies.begin() + 1, wall);
  }
  task.unplaced.clear();
  task.init = {{{"on", {"cube1", "table"}}, false}};
  task.goal = atom("holding", {{false, "panda.hand"}, {false, "cube1"}});
  return task;
}

Task niche_task(int) { return niche_of(2); }

// As before, and cube3 keeps the fingers from the one side of cube2 that cube1 leaves free.
Task corner_task(int) {
  Task task = niche_of(3);
  for (Body& body : task.scene.bodies) {
    if (body.name == "wall2") body.parts[0].shapes[0].size.y() = 0.006;
    if (body.name == "wall2") body.world_from_body = translation(0.45, 0.03, 0.02);
    if (body.name == "cube3") body.world_from_body = translation(0.498, 0.05, 0.02);
  }
  return task;
}

EpisodeRecord run_niche(OnFailure on_failure) {
  const TaskDraw task = niche_task;
  PlainSymbols symbols;
  PlainSkills skills;
  RunOptions options;
  options.seed = 1;
  options.on_failure = on_failure;
  return run_episode(task, symbols, skills, options);
}

std::vector<std::string> done(const EpisodeRecord& episode) {
  std::vector<std::string> steps;
  for (const SegmentRecord& segment : episode.labels.segments)
    if (segment.kind == SegmentKind::skill && segment.outcome == Outcome::success)
      steps.push_back(segment.skill + " " + segment.arguments[0]);
  return steps;
}

}  // namespace

TEST_CASE("undo: the plan that failed is kept with its reason, and what was in the way is moved first") {
  const EpisodeRecord episode = run_niche(OnFailure::undo);
  INFO(to_string(episode.reason) << " " << episode.detail);
  REQUIRE(episode.outcome == Outcome::success);
  CHECK(done(episode) == std::vector<std::string>{"pick cube2", "place cube2", "pick cube1"});
  REQUIRE_FALSE(episode.labels.attempts.empty());
  const SegmentRecord& first = episode.labels.attempts.front().segment;
  CHECK(first.arguments[0] == "cube1");
  CHECK(first.reason == Reason::no_grasp);
  CHECK(first.detail.find("in the way: cube2") != std::string::npos);
}

TEST_CASE("what is in the way of what is in the way is moved before both") {
  const TaskDraw task = corner_task;
  PlainSymbols symbols;
  PlainSkills skills;
  RunOptions options;
  options.seed = 1;
  const EpisodeRecord episode = run_episode(task, symbols, skills, options);
  std::string tries;
  for (const AttemptRecord& attempt : episode.labels.attempts)
    if (attempt.segment.kind == SegmentKind::skill)
      tries += attempt.segment.skill + " " + attempt.segment.arguments[0] + ": " + attempt.segment.detail + "\n";
  INFO(to_string(episode.reason) << " " << episode.detail << "\n" << tries);
  REQUIRE(episode.outcome == Outcome::success);
  CHECK(done(episode) ==
        std::vector<std::string>{"pick cube3", "place cube3", "pick cube2", "place cube2", "pick cube1"});
}

TEST_CASE("recover: the failed try stays, and the blocker is moved afterwards") {
  const EpisodeRecord episode = run_niche(OnFailure::recover);
  REQUIRE(episode.outcome == Outcome::success);
  CHECK(done(episode) == std::vector<std::string>{"pick cube2", "place cube2", "pick cube1"});
  CHECK(episode.labels.attempts.empty());
  int failed = 0;
  for (const SegmentRecord& segment : episode.labels.segments)
    failed += segment.kind == SegmentKind::skill && segment.reason == Reason::no_grasp;
  CHECK(failed == 1);
}

TEST_CASE("a problem without obstructions is the plain one, with one the action waits for the move") {
  const TaskDraw task = niche_task;
  PlainSymbols symbols;
  RunOptions options;
  const Start start = make_start(task, symbols, options);
  REQUIRE(start.scene);
  World world(start.scene);
  WorldView view(world);
  FactTracker facts(symbols, view);
  facts.begin({{{"on", {"cube1", "table"}}, {true, {}}},
               {{"on", {"cube2", "table"}}, {true, {}}},
               {{"hand_empty", {"panda.hand"}}, {true, {}}}});
  const PlanStep pick{"pick", {"cube1", "table", "panda.hand"}};
  const PlanningTask plain = planning_task(task(0), symbols.domain(), facts, 0);
  CHECK(plain.domain == symbols.domain());
  CHECK(solve(plain.domain, plain.problem).plan == Plan{pick});
  const PlanningTask aware =
      planning_task(task(0), symbols.domain(), facts, 0, {{pick, "cube2", {{"on", {"cube2", "table"}}}}});
  CHECK_FALSE(validate(aware.domain, aware.problem, {pick}).valid);
  const PlanOutcome outcome = solve(aware.domain, aware.problem);
  REQUIRE(outcome.solved);
  REQUIRE(outcome.plan.size() == 3);
  CHECK(outcome.plan.front().action == "pick");
  CHECK(outcome.plan.front().arguments.front() == "cube2");
  CHECK(outcome.plan.back() == pick);
}
