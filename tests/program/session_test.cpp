// The world in symbols for programs: it says what the catalogue says.
#include <catch2/catch.hpp>
#include <set>

#include "engine/record/arrays.h"
#include "engine/symbolic/pddl.h"
#include "scripting/session/own_words.h"
#include "scripting/session/session_core.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

// `(inside item chest.top_drawer)` as the views `facts` and `observed_facts` would name it.
std::string text_of(const StateFact& fact) { return to_text(Fact{fact.predicate, fact.arguments}); }

std::set<std::string> facts_at(SessionCore& session, const std::string& view, std::int64_t frame) {
  std::set<std::string> facts;
  const std::string at = std::to_string(frame);
  for (const auto& row :
       session.query("SELECT fact FROM " + view + " WHERE first_frame <= " + at + " AND end_frame > " + at).rows)
    facts.insert(std::get<std::string>(row.at(0)));
  return facts;
}

}  // namespace

TEST_CASE("the state of any frame is that of the views, and an item in a closed drawer is not known") {
  const Folder folder;
  SessionCore session(STAMPEDE_SOURCE_DIR, {}, folder / "d.db");
  const Episode episode = session.run("find_item_in_drawer", {.seed = 7});
  REQUIRE(episode.outcome == Outcome::success);
  int hidden_at_first = 0;
  for (const std::int64_t frame : {std::int64_t{0}, episode.frames / 2, episode.frames - 1}) {
    const WorldState state = session.state(episode, frame);
    CHECK(state.frame == frame);
    CHECK(state.time_s == Approx(static_cast<double>(frame) / 20));
    std::set<std::string> holding;
    for (const StateFact& fact : state.facts) {
      CHECK((fact.holds || fact.known));
      if (fact.holds) holding.insert(text_of(fact));
      if (frame == 0 && fact.holds && !fact.known) ++hidden_at_first;
    }
    CHECK(holding == facts_at(session, "facts", frame));
    for (const StateJoint& joint : state.joints) CHECK((joint.fraction > -0.01 && joint.fraction < 1.01));
    CHECK(state.objects.size() > 1);
    CHECK(state.hands.size() == 1);
  }
  CHECK(hidden_at_first > 0);
  for (const StateFact& fact : session.state(episode, episode.frames - 1).facts)
    if (fact.predicate == "on" && fact.arguments.at(0) == "item") CHECK((fact.holds && fact.known));
}

TEST_CASE("a state that is not there is an error with the cure") {
  const Folder folder;
  SessionCore session(STAMPEDE_SOURCE_DIR, {}, folder / "d.db");
  const Episode episode = session.run("reach_target", {.seed = 7});
  CHECK_THROWS_WITH(session.state(episode, episode.frames),
                    Catch::Contains("choose 0 to " + std::to_string(episode.frames - 1)));
  CHECK_THROWS_WITH(session.state({.id = episode.id + 1}, 0), Catch::Contains(std::to_string(episode.id + 1)));
  CHECK(session.state({.id = episode.id}, 0).frame == 0);  // and it still works
  CHECK_THROWS_WITH(SessionCore(STAMPEDE_SOURCE_DIR, {}, {}).state({.id = 1}, 0),
                    Catch::Contains("SessionOptions::catalogue"));
}

TEST_CASE("an episode of a session without a catalogue holds what happened, and says what a stored one says") {
  const Folder folder;
  SessionCore memory(STAMPEDE_SOURCE_DIR, {}, {}), stored(STAMPEDE_SOURCE_DIR, {}, folder / "d.db");
  const Episode here = memory.run("reach_target", {.seed = 7}), there = stored.run("reach_target", {.seed = 7});
  REQUIRE(here.record);
  CHECK_FALSE(there.record);
  CHECK(here.key == there.key);
  const WorldState a = memory.state(here, here.frames - 1), b = stored.state(there, there.frames - 1);
  REQUIRE(a.objects.size() == b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) CHECK(a.objects[i].position == b.objects[i].position);
  CHECK(memory.picture(here, 3, {.width = 48, .height = 32}).rgb ==
        stored.picture(there, 3, {.width = 48, .height = 32}).rgb);
  CHECK_FALSE(memory.points(here, 3, {.width = 48, .height = 32}).positions.empty());
  const EpisodeArrays x = memory.arrays(here, {}), y = stored.arrays(there, {});
  CHECK(first_difference(x, y).empty());
  CHECK(first_difference(y, x).empty());
  EpisodeArrays changed = x;
  std::get<std::vector<double>>(changed.columns.at(4).data).at(5) += 1e-9;
  CHECK(says(first_difference(changed, x), "frame"));
  CHECK_THROWS_WITH(memory.query("SELECT 1"), Catch::Contains("SessionOptions::catalogue"));
  CHECK_THROWS_WITH(SessionCore(STAMPEDE_SOURCE_DIR, {}, ":memory:"), Catch::Contains("leave it empty"));
  CHECK(says(say({"run", "reach_target", "--root", STAMPEDE_SOURCE_DIR, "--out", ":memory:"}).err, "name a file"));
}

TEST_CASE("a session keeps one catalogue open, answers are typed, and others may read meanwhile") {
  const Folder folder;
  SessionCore session(STAMPEDE_SOURCE_DIR, {}, folder / "d.db");
  CHECK_THROWS_AS(session.query("SELECT 1"), CatalogueError);  // no file yet, and none is made by asking
  const Episode first = session.run("reach_target", {.seed = 7});
  const Episode again = session.run("reach_target", {.seed = 7});
  CHECK(again.id == first.id);
  session.run("reach_target", {.seed = 8});
  CHECK(Catalogue::open(folder / "d.db").episodes().size() == 2);
  const Rows rows = session.query("SELECT task, seed, duration_s, NULL AS missing, x'0041' AS bytes FROM episodes");
  REQUIRE(rows.size() == 2);
  CHECK(rows.text(0, "task") == "reach_target");
  CHECK(session.query("SELECT episode FROM episodes WHERE seed = ?1 AND task = ?2", {std::int64_t{8}, "reach_target"})
            .size() == 1);
  CHECK(rows.integer(1, "seed") == 8);
  CHECK(rows.real(0, "duration_s") == first.duration_s);
  CHECK(rows.real(0, "seed") == 7);
  CHECK(rows.is_null(0, "missing"));
  CHECK(rows.blob(0, "bytes") == std::string("\0A", 2));
  CHECK_THROWS_WITH(rows.integer(0, "task"), Catch::Contains("text, not an integer"));
  CHECK_THROWS_WITH(rows.text(0, "tsk"), Catch::Contains("did you mean 'task'"));
  CHECK_THROWS_WITH(rows.text(2, "task"), Catch::Contains("2 rows"));
}

TEST_CASE("a program's mistakes are told in words of its own, not in the program's flags") {
  const Folder folder;
  SessionCore session(STAMPEDE_SOURCE_DIR, {}, folder / "d.db");
  const auto environments =
      std::make_shared<SessionCore>(STAMPEDE_SOURCE_DIR, std::vector<std::filesystem::path>{}, "");
  const auto refused = [](const auto& call, const std::string& words) {
    CAPTURE(words);
    try {
      call();
      FAIL("no complaint");
    } catch (const Error& error) {
      CHECK_THAT(error.what(), Catch::Contains(words));
      CHECK_THAT(error.what(), !Catch::Contains(" --") && !Catch::StartsWith("--"));
    }
  };
  for (const auto& [request, words] : std::vector<std::pair<EpisodeRequest, std::string>>{
           {{.variation = "colour=plaid"}, "variation: task 'stack_blocks' has no variation 'colour=plaid'"},
           {{.seed = -1}, "seed: a seed is 0 or more"},
           {{.where = "(on block1 nothing)"}, "nothing"},
           {{.where = "(and (clear block1) (block block1 table))"}, "where"},
           {{.goal = "(on nothing block1)"}, "goal"}}) {
    refused([&] { session.run("stack_blocks", request); }, words);
    refused([&] { session.plan("stack_blocks", request); }, words);
    RunRequest many{.tasks = {"stack_blocks"}, .each = request};
    refused([&] { session.run_all(many); }, words);
    ResetRequest reset{.variation = request.variation, .seed = request.seed, .where = request.where};
    reset.goal = request.goal;
    refused([&] { environments->environment("stack_blocks", {}).reset(reset); }, words);
  }
  refused([&] { session.run("stack_blocks", {.controller = "joint_postion"}); },
          "EpisodeRequest::controller: there is no controller 'joint_postion'");
  refused([&] { session.run("stack_blocks", {.motion_planner = "ompl:RRTConect"}); },
          "EpisodeRequest::motion_planner: ");
  RunRequest both{.tasks = {"stack_blocks"}, .episodes = 2};
  both.each.seed = 999'999;
  refused([&] { session.run_all(both); }, "seeds from 1000000 up belong to the test split");
  refused([&] { session.evaluate({"stack_blocks"}, {.variation = "colour=plaid"}); }, "variation: task");
  refused([&] { SessionCore("/nowhere", {}, ""); }, "root: '/nowhere' is not a folder");
  refused([&] { SessionCore(STAMPEDE_SOURCE_DIR, {"/nowhere"}, ""); }, "paths: '/nowhere' is not a folder");
  CHECK(without_flags("--on-failure: say --split test, or `stampede run --split test`") ==
        "on_failure: say split test, or `stampede run --split test`");
  CHECK(without_flags("chest--top_drawer -- no (--where)") == "chest--top_drawer -- no (where)");
}

TEST_CASE("a program asks for the plan of a start without executing it, and gets what the run then does") {
  const SessionCore session(STAMPEDE_SOURCE_DIR, {}, {});
  const TaskPlan plan = session.plan("put_item_in_drawer", {.variation = "level=top", .seed = 3});
  REQUIRE(plan.found);
  CHECK(plan.end == "solved");
  REQUIRE(plan.steps.size() == 3);
  CHECK(plan.steps[0].action == "open");
  CHECK(plan.steps[0].arguments.at(0) == "chest.top_drawer");
  const TaskPlan again = plan_of_texts(plan.domain, plan.problem);
  CHECK(again.found);
  CHECK(again.steps.size() == 3);

  const TaskPlan other =
      session.plan("put_item_in_drawer", {.variation = "level=top", .seed = 3, .where = "(open chest.top_drawer)"});
  CHECK(other.steps.size() == 2);
  const TaskPlan none = session.plan("put_item_in_drawer", {.goal = "(inside chest.top_drawer chest.bottom_drawer)"});
  CHECK_FALSE(none.found);
  CHECK(says(none.explanation, "inside"));
  CHECK_THROWS_WITH(plan_of_texts("(define (domain d)", "(define (problem p)"), Catch::Contains("domain:1"));
}

TEST_CASE("a plan is of what is known at the start, and says what it assumes of the rest") {
  const SessionCore session(STAMPEDE_SOURCE_DIR, {}, {});
  std::set<std::string> assumed;
  for (std::int64_t seed = 1; seed <= 6; ++seed) {
    const TaskPlan plan = session.plan("find_item_in_drawer", {.variation = "hidden_in=top", .seed = seed});
    REQUIRE(plan.found);
    REQUIRE(plan.assumed.size() == 1);
    const std::string drawer = plan.steps.at(0).arguments.at(0);
    CHECK(plan.assumed[0] == "(inside item " + drawer + ")");
    CHECK(says(plan.problem, "(inside item " + to_pddl_name(drawer) + ")"));
    if (drawer != "chest.top_drawer") CHECK_FALSE(says(plan.problem, "(inside item chest--top_drawer)"));
    CHECK(plan_of_texts(plan.domain, plan.problem).found);
    assumed.insert(drawer);
  }
  CHECK(assumed.size() > 1);  // nobody knows that it is in the top one
  CHECK(session.plan("put_item_in_drawer", {}).assumed.empty());
}

}  // namespace stampede::program
