#include "engine/start/constraints.h"

#include <catch2/catch.hpp>
#include <set>

#include "engine/base/error.h"
#include "engine/start/fact_tracker.h"
#include "engine/symbolic/pddl.h"
#include "tests/support/make_start.h"
#include "tests/support/plain_task.h"

using namespace stampede;
using namespace stampede::plain;

namespace {

Formula formula(const char* text) { return formula_from_pddl(text, "test"); }

const std::vector<TypedObject> kObjects = {
    {"a", "cube"}, {"b", "cube"}, {"c", "cube"}, {"hand", "hand"}, {"t", "table"}};
const Facts kKnown = {
    {"movable", {"a"}}, {"movable", {"b"}}, {"movable", {"c"}}, {"surface", {"t"}}, {"surface", {"b"}}};

std::optional<std::vector<Literal>> draw(const char* text, int n = 0) {
  return draw_literals(formula(text), PlainSymbols(), kObjects, kKnown, RandomKey("test").with(n));
}

Start start_where(const char* text, std::int64_t seed = 1) {
  const TaskDraw task = stack_draw();
  PlainSymbols symbols;
  RunOptions options;
  options.seed = seed;
  options.draws = 20;
  options.where = formula(text);
  return make_start(task, symbols, options);
}

}  // namespace

TEST_CASE("what is known of a scene without a world is what a tracker knows before it looks") {
  PlainSymbols symbols;
  const Scene scene = stack_task().scene;
  World world(std::make_shared<const Scene>(scene));
  FactTracker tracker(symbols, WorldView(world));
  tracker.begin({});
  const StaticFacts known = static_facts(scene, symbols.domain());
  CHECK(known.facts == tracker.facts());
  CHECK(known.objects == tracker.objects());
}

TEST_CASE("literals that make a formula true: what is known is decided, the rest is to be made") {
  const auto drawn = draw("(and (on a t) (not (on b t)) (movable a))");
  REQUIRE(drawn);
  REQUIRE(drawn->size() == 2);
  CHECK((*drawn)[0].fact == Fact{"on", {"a", "t"}});
  CHECK((*drawn)[1].negated);
  CHECK_FALSE(draw("(movable t)"));
  CHECK_FALSE(draw("(and (on a t) (not (on a t)))"));
  CHECK_FALSE(draw("(and (on a t) (= a b))"));
}

TEST_CASE("of what is not of a predicate's types and traits nothing is drawn: no such fact can be") {
  CHECK_FALSE(draw("(on t b)"));
  CHECK_FALSE(draw("(on a c)"));
  CHECK(draw("(not (on t b))")->empty());
  CHECK_FALSE(draw("(forall (?x) (on ?x t))"));
  std::set<std::pair<std::string, std::string>> drawn;
  for (int n = 0; n < 60; ++n) {
    const auto literals = draw("(exists (?x ?y) (on ?x ?y))", n);
    REQUIRE(literals);
    for (const Literal& literal : *literals) drawn.insert({literal.fact.arguments[0], literal.fact.arguments[1]});
  }
  using Pairs = std::set<std::pair<std::string, std::string>>;
  CHECK(drawn == Pairs{{"a", "b"}, {"a", "t"}, {"b", "b"}, {"b", "t"}, {"c", "b"}, {"c", "t"}});
  CHECK(atom_fault({"on", {"t", "b"}}, PlainSymbols().domain(), kObjects, kKnown) ==
        "t is not movable, which ?obj must be");
  CHECK(atom_fault({"on", {"a", "b"}}, PlainSymbols().domain(), kObjects, kKnown).empty());
}

TEST_CASE("what a predicate says of itself rules starts out before anything is placed") {
  CHECK(draw("(holding hand a)"));
  CHECK_FALSE(draw("(and (holding hand a) (holding hand b))"));
  CHECK(draw("(and (holding hand a) (not (holding hand b)))"));
  CHECK_FALSE(draw("(and (hand_empty hand) (holding hand b))"));  // whichever of the two names the other
  const auto drawn = draw("(and (holding hand a) (or (hand_empty hand) (on b t)))");
  REQUIRE(drawn);
  CHECK(drawn->at(1).fact == Fact{"on", {"b", "t"}});
}

TEST_CASE("every way to meet an existential constraint is drawn, and no other") {
  std::set<std::string> chosen;
  for (int n = 0; n < 60; ++n) {
    const auto drawn = draw("(exists (?x - cube) (and (on ?x t) (not (= ?x b))))", n);
    REQUIRE(drawn);
    REQUIRE(drawn->size() == 1);
    chosen.insert((*drawn)[0].fact.arguments[0]);
  }
  CHECK(chosen == std::set<std::string>{"a", "c"});
}

TEST_CASE("alternatives that contradict what comes after them are given up") {
  for (int n = 0; n < 20; ++n) {
    const auto drawn = draw("(and (or (on a t) (on a b)) (not (on a t)))", n);
    REQUIRE(drawn);
    CHECK((*drawn)[0].fact == Fact{"on", {"a", "b"}});
  }
  const auto all = draw("(forall (?x - cube) (on ?x t))");
  REQUIRE(all);
  CHECK(all->size() == 3);
}

TEST_CASE("a formula is checked against the scene, and the hand may be left out") {
  const Formula checked = checked_formula(formula("(holding a)"), domain(), kObjects, "--goal");
  REQUIRE(checked.terms.size() == 2);
  CHECK(checked.terms[0].name == "hand");
  const auto complaint = [](const char* text) -> std::string {
    try {
      checked_formula(formula(text), domain(), kObjects, "--where");
    } catch (const Error& error) {
      return std::string(error.what()) + error.hint();
    }
    return "";
  };
  CHECK(complaint("(onn a t)").find("did you mean 'on'") != std::string::npos);
  CHECK(complaint("(on a tt)").find("no object 'tt'") != std::string::npos);
  CHECK(complaint("(on a)").find("takes 2 arguments") != std::string::npos);
  CHECK(complaint("(on a ?x)").find("binds") != std::string::npos);
  CHECK(complaint("(exists (?x - cubee) (on ?x t))").find("did you mean 'cube'") != std::string::npos);
}

TEST_CASE("a start under a constraint has it in settled physics, instead of the task's own place") {
  const Start start = start_where("(on cube3 cube2)");
  INFO(start.detail);
  REQUIRE(start.reason == Reason::none);
  const auto at = [&](const char* name) {
    return start.scene->bodies[static_cast<std::size_t>(start.scene->body_index(name))].world_from_body.translation();
  };
  CHECK(at("cube3").z() - at("cube2").z() == Approx(0.04).margin(1e-3));
  CHECK((at("cube3") - at("cube2")).head<2>().norm() < 0.02);
}

TEST_CASE("a constraint that cannot be met says which part failed how often") {
  const Start start = start_where("(and (on cube3 table) (on cube3 cube2))");
  CHECK(start.reason == Reason::init_impossible);
  INFO(start.detail);
  CHECK(start.detail.find("(on cube3 ") != std::string::npos);
  CHECK(start.detail.find("20 times") != std::string::npos);
}

TEST_CASE("a goal that every start meets is said after ten draws") {
  const TaskDraw task = stack_draw();
  PlainSymbols symbols;
  RunOptions options;
  options.goal = formula("(on cube1 table)");
  options.where = formula("(on cube1 table)");
  const Start start = make_start(task, symbols, options);
  CHECK(start.reason == Reason::init_impossible);
  CHECK(start.detail.find("the goal holds at the start already, in each of 10 draws") == 0);
}

TEST_CASE("any goal over the predicates makes a task: planned, executed and said in words") {
  const TaskDraw task = stack_draw();
  PlainSymbols symbols;
  PlainSkills skills;
  RunOptions options;
  options.seed = 5;
  options.goal = formula("(exists (?x - cube) (and (not (= ?x cube1)) (on cube3 ?x)))");
  const EpisodeRecord episode = run_episode(task, symbols, skills, options);
  INFO(episode.detail);
  REQUIRE(episode.outcome == Outcome::success);
  bool on_cube2 = false;
  for (const FactRecord& fact : episode.labels.facts)
    on_cube2 |= fact.open_end && fact.fact == Fact{"on", {"cube3", "cube2"}};
  CHECK(on_cube2);
  options.goal = formula("(and (on cube3 cube2) (hand_empty))");
  const EpisodeRecord other = run_episode(task, symbols, skills, options);
  REQUIRE(other.outcome == Outcome::success);
  CHECK(other.labels.language.front().text.starts_with("make sure that the"));
}

TEST_CASE("random behaviour draws applicable skills, keeps what fails, and repeats") {
  const TaskDraw task = stack_draw();
  PlainSymbols symbols;
  PlainSkills skills;
  RunOptions options;
  options.seed = 2;
  options.behaviour = Behaviour::random_applicable;
  options.on_failure = OnFailure::recover;
  options.skills = 6;
  const EpisodeRecord a = run_episode(task, symbols, skills, options), b = run_episode(task, symbols, skills, options);
  CHECK(a.state_hash == b.state_hash);
  int drawn = 0;
  for (const SegmentRecord& segment : a.labels.segments)
    if (segment.kind == SegmentKind::skill) {
      ++drawn;
      CHECK(segment.precondition_held == true);
    }
  CHECK(drawn == 6);
  CHECK(a.labels.attempts.empty());
  CHECK(replay_episode(a).empty());
  options.behaviour = Behaviour::random_skills;
  const EpisodeRecord c = run_episode(task, symbols, skills, options);
  int refused = 0;
  for (const SegmentRecord& segment : c.labels.segments) refused += segment.precondition_held == false;
  CHECK(refused > 0);  // tried all the same
  CHECK(replay_episode(c).empty());
}

TEST_CASE("what quantifies over very many is refused with the count, and over many it takes no stack") {
  std::vector<TypedObject> objects;
  Facts known;
  for (int i = 0; i < 100; ++i) {
    objects.push_back({"c" + std::to_string(100 + i), "cube"});
    for (const char* trait : {"movable", "surface"}) known.insert({trait, {objects.back().name}});
  }
  const auto checked = [&](const char* text) {
    return checked_formula(formula(text), PlainSymbols().domain(), objects, "--where");
  };
  CHECK_THROWS_WITH(
      checked("(forall (?a - cube ?b - cube ?c - cube ?d - cube ?e - cube ?f - cube) (not (on ?a ?b)))"),
      Catch::Contains("--where: forall over ?a ?b ?c ?d ?e ?f: 1,000,000,000,000 instances, at most 200,000") &&
          Catch::Contains("name fewer variables"));
  CHECK_THROWS_WITH(checked("(exists (?a - cube ?b - cube) (forall (?c - cube ?d - cube) (on ?a ?d)))"),
                    Catch::Contains("forall over ?a ?b ?c ?d: 100,000,000 instances"));
  const Formula many = checked("(forall (?a - cube ?b - cube) (or (= ?a ?b) (not (on ?a ?b))))");
  const auto drawn = draw_literals(many, PlainSymbols(), objects, known, RandomKey("test"));
  REQUIRE(drawn);
  CHECK((drawn->size() >= 100 * 99 && drawn->size() <= 100 * 100));  // of one thing either part will do
}
