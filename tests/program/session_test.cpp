// The world in symbols for programs: it says what the catalogue says.
#include <catch2/catch.hpp>
#include <set>

#include "scripting/session/session_core.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

// `(inside item chest.top_drawer)` as the views `facts` and `observed_facts` would name it.
std::string text_of(const StateFact& fact) { return to_text(Fact{fact.predicate, fact.arguments}); }

std::set<std::string> facts_at(const SessionCore& session, const std::string& view, std::int64_t frame) {
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
    const WorldState state = session.state(episode.id, frame);
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
  for (const StateFact& fact : session.state(episode.id, episode.frames - 1).facts)
    if (fact.predicate == "on" && fact.arguments.at(0) == "item") CHECK((fact.holds && fact.known));
}

TEST_CASE("a state that is not there is an error with the cure") {
  const Folder folder;
  SessionCore session(STAMPEDE_SOURCE_DIR, {}, folder / "d.db");
  const Episode episode = session.run("reach_target", {.seed = 7});
  CHECK_THROWS_WITH(session.state(episode.id, episode.frames),
                    Catch::Contains("choose 0 to " + std::to_string(episode.frames - 1)));
  CHECK_THROWS_WITH(session.state(episode.id + 1, 0), Catch::Contains(std::to_string(episode.id + 1)));
  CHECK(session.state(episode.id, 0).frame == 0);  // and it still works
  CHECK_THROWS_WITH(SessionCore(STAMPEDE_SOURCE_DIR, {}, {}).state(1, 0), Catch::Contains("SessionOptions::catalogue"));
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

}  // namespace stampede::program
