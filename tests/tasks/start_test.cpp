// Starts that formulas in `init` draw: the same as --where, written in the task.
#include "engine/episode/start.h"

#include <catch2/catch.hpp>
#include <set>

#include "engine/episode/abstract_state.h"
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
