// Symbols beside the raw state: facts, what is known of them, and who may read them.
#include <catch2/catch.hpp>

#include "engine/sim/world.h"
#include "engine/start/relations.h"
#include "scripting/runtime/episode_scripts.h"

using namespace stampede;

namespace {

std::shared_ptr<const Library> facts_library() {
  static const auto shared =
      Library::load(Roots{{STAMPEDE_SOURCE_DIR, STAMPEDE_SOURCE_DIR "/tests/scripting/data/facts"}});
  return shared;
}

struct Watched {
  explicit Watched(const std::string& task, const std::string& variation = "")
      : scripts(facts_library(), task, variation, 1) {
    tracker.begin(tracker.read_all(view));
    tracker.look(view);
    view.set_facts(&tracker);
  }
  EpisodeScripts scripts;
  World world{std::make_shared<const Scene>(scripts.task()(0).scene)};
  WorldView view{world};
  FactTracker tracker{scripts.symbols(), view, named_by(scripts.task()(0), scripts.symbols())};
};

}  // namespace

TEST_CASE("only predicates that say so hide, and a closed drawer hides what is inside") {
  Watched watched("watch_drawer", "pulled=0");
  Symbols& symbols = watched.scripts.symbols();
  CHECK(symbols.can_hide("inside"));
  CHECK_FALSE(symbols.can_hide("on"));
  const Fact in_drawer{"inside", {"item", "chest.middle_drawer"}};
  CHECK_FALSE(symbols.observable(in_drawer, watched.view));
  CHECK(symbols.observable({"inside", {"item", "chest.front"}}, watched.view));
  CHECK(symbols.observable({"on", {"item", "table"}}, watched.view));
  Watched pulled("watch_drawer", "pulled=0.16");
  CHECK(pulled.tracker.facts().contains(in_drawer));
  CHECK(pulled.scripts.symbols().observable(in_drawer, pulled.view));
}

TEST_CASE("a task's tests read facts and what is known of them, the hand filled in") {
  Watched watched("watch_drawer", "pulled=0");
  CHECK(watched.scripts.task()(0).also(watched.view));
  CHECK_FALSE(watched.scripts.task()(0).fails(watched.view));    // inside, but not seen
  CHECK(watched.scripts.task()(0).reward(watched.view) == 3.0);  // three drawers are closed
  Watched pulled("watch_drawer", "pulled=0.16");
  CHECK(pulled.scripts.task()(0).also(pulled.view));
  CHECK(pulled.scripts.task()(0).fails(pulled.view));  // now it is seen
  CHECK(pulled.scripts.task()(0).reward(pulled.view) == 2.0);
}

TEST_CASE("a predicate may not read facts, nor may anybody where none are kept") {
  Watched watched("watch_drawer", "pulled=0");
  CHECK_THROWS_WITH(watched.scripts.symbols().value({"peeks", {"item"}}, watched.view),
                    Catch::Contains("facts are made of predicates"));
  const WorldView plain(watched.world);
  CHECK_THROWS_WITH(watched.scripts.task()(0).also(plain), Catch::Contains("no facts here"));
}

TEST_CASE("an unknown predicate and a wrong number of things are errors, not false") {
  Watched watched("ask_wrongly");
  CHECK_THROWS_WITH(watched.scripts.task()(0).also(watched.view), Catch::Contains("did you mean 'on'"));
  CHECK_THROWS_WITH(watched.scripts.task()(0).fails(watched.view), Catch::Contains("2 things, not 1"));
}

TEST_CASE("a test reads relations that it names, and one that nobody names is an error") {
  Watched watched("ask_unnamed");
  CHECK(watched.scripts.task()(0).also(watched.view));
  CHECK_THROWS_WITH(watched.scripts.task()(0).fails(watched.view),
                    Catch::Contains("facts of 'left_of' are kept only in tasks that name it"));
}
