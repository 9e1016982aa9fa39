// Starts that formulas in `init` draw: the same as --where, written in the task.

#include <catch2/catch.hpp>
#include <numbers>
#include <set>

#include "engine/sim/world.h"
#include "engine/start/abstract_state.h"
#include "engine/start/part_questions.h"
#include "tests/support/make_start.h"
#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

TEST_CASE("formulas of init hold at the start, by different bindings and alternatives") {
  std::set<std::string> tops, drawers;
  for (int seed = 0; seed < 8; ++seed) {
    RunOptions options;
    options.seed = seed;
    const EpisodeRecord episode = run_task("drawn_start", "", options);
    INFO(seed << ": " << verdict(episode));
    REQUIRE(episode.outcome == Outcome::success);
    int stacked = 0, open = 0;
    for (const Fact& fact : abstract_state(episode, 0).facts) {
      if (fact.predicate == "on" && fact.arguments[1].starts_with("block")) ++stacked, tops.insert(fact.arguments[0]);
      if (fact.predicate == "open") ++open, drawers.insert(fact.arguments[0]);
    }
    CHECK(stacked == 1);
    CHECK(open == 1);
  }
  CHECK(tops.size() > 1);
  CHECK(drawers == std::set<std::string>{"chest.middle_drawer", "chest.top_drawer"});
}

TEST_CASE("a start that asks for a place on a surface and in a region is found, in any order of literals") {
  for (const char* task : {"cup_on_and_in", "cup_in_and_on"})
    for (int seed = 0; seed < 12; ++seed) {
      RunOptions options;
      options.seed = seed;
      EpisodeScripts scripts(all_tasks(), task, "", seed);
      const PreparedStart start = prepare_start(scripts.task(), scripts.symbols(), options);
      INFO(task << " " << seed << ": " << start.detail);
      CHECK(start.reason == Reason::none);
      CHECK(start.draws <= 5);
    }
}

TEST_CASE("what a task opens or shuts stands where the arm can move it") {
  struct Case {
    std::string task, variation;
    std::int64_t seed;
  };
  const std::vector<Case> once_out_of_reach = {{"slide_cabinet_open", "side=right", 7310000},
                                               {"slide_cabinet_open", "side=right", 7310002},
                                               {"close_door", "", 7310000},
                                               {"take_tray_out_of_oven", "", 7310000},
                                               {"take_tray_out_of_oven", "", 720001},
                                               {"take_tray_out_of_oven", "", 720004},
                                               {"empty_dishwasher", "", 7310001},
                                               {"close_drawer", "level=bottom", 7},
                                               {"close_drawer", "level=bottom", 8}};
  for (const auto& [task, variation, seed] : once_out_of_reach) {
    RunOptions options;
    options.seed = seed;
    options.split = seed >= 1000000 ? Split::test : Split::train;
    const EpisodeRecord episode = run_task(task, variation, options);
    INFO(task << " " << seed << ": " << verdict(episode));
    CHECK(episode.outcome == Outcome::success);
  }
}

TEST_CASE("a part can be moved where the arm can take it and go with it, not far away, and not behind what is shut") {
  const auto settled_scene = [](const std::string& task) {
    EpisodeScripts scripts(all_tasks(), task, first_variation(task), 1);
    return *make_start(scripts.task(), scripts.symbols(), {}).scene;
  };
  Scene chest = settled_scene("open_drawer");
  const auto can_move = [](const Scene& scene, const std::string& part, const std::string& before) {
    World world(std::make_shared<const Scene>(scene));
    return stampede::can_move(WorldView(world), part, "pull", before);
  };
  CHECK(can_move(chest, "chest.top_drawer", ""));
  const Body& body = chest.bodies[static_cast<std::size_t>(chest.body_index("chest"))];
  chest.bodies[static_cast<std::size_t>(chest.body_index("chest"))].world_from_body =
      translation(1, 0, 0) * body.world_from_body;
  CHECK_FALSE(can_move(chest, "chest.top_drawer", ""));
  const Scene dishwasher = settled_scene("empty_dishwasher");
  CHECK_FALSE(can_move(dishwasher, "dishwasher.rack", ""));
  CHECK(can_move(dishwasher, "dishwasher.rack", "dishwasher.door"));
}

TEST_CASE("a door that the arm can only open half is not one that it can open, a part with several grips is") {
  EpisodeScripts scripts(all_tasks(), "open_microwave", "", 1);
  Scene scene = *make_start(scripts.task(), scripts.symbols(), {}).scene;
  const auto can_open_at = [&](double x, double y, double yaw_deg, const char* enough) {
    Body& body = scene.bodies[static_cast<std::size_t>(scene.body_index("microwave"))];
    body.world_from_body.translation().head<2>() << x, y;
    body.world_from_body.linear() =
        Eigen::AngleAxisd(yaw_deg * std::numbers::pi / 180, Vector3::UnitZ()).toRotationMatrix();
    World world(std::make_shared<const Scene>(scene));
    return can_move(WorldView(world), "microwave.door", "pull", {}, enough);
  };
  CHECK(can_open_at(0.57, 0.01, -8, "open_at"));
  CHECK(can_open_at(0.23, 0.59, 96, "closed_at"));  // it is all but there
  CHECK_FALSE(can_open_at(0.23, 0.59, 96, "open_at"));
  CHECK_THROWS_WITH(can_open_at(0.57, 0.01, -8, "ajar"), Catch::Contains("has no number 'ajar'"));
}

TEST_CASE("a knob is where the arm can turn it, or is not") {
  EpisodeScripts scripts(all_tasks(), "turn_oven_on", "", 1);
  Scene scene = *make_start(scripts.task(), scripts.symbols(), {}).scene;
  const auto can_turn = [&] {
    World world(std::make_shared<const Scene>(scene));
    return can_move(WorldView(world), "cooker.oven_knob", "turn_to", {}, "turned_at");
  };
  CHECK(can_turn());
  scene.bodies[static_cast<std::size_t>(scene.body_index("cooker"))].world_from_body.translation().x() += 0.4;
  CHECK_FALSE(can_turn());
}

TEST_CASE("only of what has a joint can be asked whether the arm can move it: all else is a mistake of the task") {
  const auto traits_of = [](const char* predicate) {
    return all_tasks()->domain().predicate(predicate)->parameters[0].traits;
  };
  CHECK(traits_of("workable") == std::vector<std::string>{"openable"});
  CHECK(traits_of("workable_behind") == std::vector<std::string>{"openable"});
  CHECK(traits_of("workable_by_turning") == std::vector<std::string>{"turnable"});
}

TEST_CASE("what is behind a flap can be grasped once it is open, and not before") {
  EpisodeScripts scripts(all_tasks(), "take_tray_out_of_oven", "", 1);
  World world(make_start(scripts.task(), scripts.symbols(), {}).scene);
  CHECK_FALSE(can_grasp(WorldView(world), "tray"));
  CHECK(can_grasp(WorldView(world), "tray", "oven.door"));
}
