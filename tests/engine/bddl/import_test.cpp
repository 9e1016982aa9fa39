// BDDL problems in our words, and the two verdicts.
#include "engine/bddl/import.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/symbolic/pddl.h"
#include "texts.h"
#include "words.h"

using namespace stampede;
using Catch::Matchers::Contains;

namespace {

BddlMapping desk_mapping() {
  BddlMapping mapping = libero_words();
  for (const char* same : {"mug", "plate", "cup"}) mapping.categories.push_back({same, same});
  return mapping;
}

BddlMapping kitchen_mapping() {
  BddlMapping mapping = behavior_words();
  mapping.categories.push_back({"apple.n.01", "apple"});
  mapping.categories.push_back({"bowl.n.01", "bowl"});
  mapping.predicates.push_back({"nextto", "beside", false, {1, 0}, BddlMeaning::equal, "a test"});
  mapping.predicates.push_back({"cooked", "cooked", false, {}, BddlMeaning::equal, ""});
  return mapping;
}

BddlTask kitchen_task(const std::string& goal) {
  return from_bddl(kitchen_of(kitchen_with_goal(goal)), kitchen_mapping());
}

bool ours(const BddlTask& task, const Facts& facts) { return holds(task.goal, facts, {}, {}); }

Facts cooked(int n) {
  Facts facts;
  for (int i = 1; i <= n; ++i) facts.insert({"cooked", {"apple_" + std::to_string(i)}});
  return facts;
}

}  // namespace

TEST_CASE("a LIBERO problem becomes objects, placements and a goal of ours") {
  const BddlTask task = from_bddl(read_bddl(kTidyDesk, "d").problem, desk_mapping());
  CHECK(task.refusal.empty());
  CHECK(task.warnings.empty());
  REQUIRE(task.fixtures.size() == 2);
  CHECK(task.fixtures[1].name == "cabinet_1");
  CHECK(task.fixtures[1].class_name == "chest");
  REQUIRE(task.objects.size() == 3);
  CHECK(task.objects[0].group == "mug");
  // What lies on a region of the desk lies on the desk, and its rectangle says where.
  REQUIRE(task.placements.size() == 2);
  CHECK(task.placements[0].object == "mug_1");
  CHECK(task.placements[0].on == "desk");
  CHECK(task.placements[0].ranges[0].x_min_m == Approx(-0.1));
  const std::vector<BddlLiteral> init = {{{"on", {"mug_1", "desk"}}, false},
                                         {{"on", {"plate_1", "desk"}}, false},
                                         {{"on", {"mug_2", "plate_1"}}, false},
                                         {{"open", {"cabinet_1.top_drawer"}}, false}};
  CHECK(task.init == init);
  CHECK(to_pddl(task.goal) == "(and (inside mug_1 cabinet_1--top_drawer) (closed cabinet_1--top_drawer))");
  CHECK(task.regions.empty());  // the two of the desk only say where things start
  CHECK(task.interest == std::vector<std::string>{"mug_1", "cabinet_1"});
}

TEST_CASE("a goal on a region asks for the surface and for the region") {
  const BddlTask task =
      from_bddl(read_bddl(desk_with(":goal", "(And (On cup_1 desk_spot) (Up cup_2))"), "d").problem, desk_mapping());
  CHECK(to_pddl(task.goal_parts.at(0)) == "(and (on cup_1 desk) (inside cup_1 desk--spot))");
  REQUIRE(task.regions.size() == 1);
  CHECK(task.regions[0].name == "desk.spot");
  CHECK(task.regions[0].ranges.size() == 1);
  const auto meaning = [&](const std::string& theirs) {
    const auto found =
        std::find_if(task.notes.begin(), task.notes.end(), [&](const BddlNote& n) { return n.theirs == theirs; });
    return found == task.notes.end() ? BddlMeaning::equal : found->meaning;
  };
  CHECK(meaning("on") == BddlMeaning::stronger);
  CHECK(meaning("up") == BddlMeaning::incomparable);
}

TEST_CASE("fixtures are placed without a fact, and sites are parts only of classes that have them") {
  std::string text = desk_with(":goal", "(And (On cup_1 rack_1_top_region))");
  text.replace(text.find("desk - table"), 12, "desk - table rack_1 - wine_rack");
  text.replace(text.find("(spot (:target desk)"), 5, "(top_region (:target rack_1)) (spot");
  text.replace(text.find("(:init "), 7, "(:init (On rack_1 desk_spot) ");
  BddlMapping mapping = desk_mapping();
  mapping.categories.push_back({"wine_rack", "rack"});
  const BddlTask task = from_bddl(read_bddl(text, "d").problem, mapping);
  REQUIRE(task.placements.size() == 2);
  CHECK(task.placements[0].object == "rack_1");
  CHECK(task.init == std::vector<BddlLiteral>{{{"on", {"cup_1", "desk"}}, false}});
  CHECK(to_pddl(task.goal) == "(and (on cup_1 rack_1) (inside cup_1 rack_1--top_region))");
  CHECK_THAT(task.warnings.at(0), Contains("make `rack_1.top_region`"));
}

TEST_CASE("pairs are of two different things, even of one category") {
  const BddlTask task = kitchen_task("(forpairs (?a - apple.n.01) (?b - apple.n.01) (nextto ?a ?b))");
  CHECK(task.goal.parts.size() == 2);  // derangements of three
}

TEST_CASE("a thing with several drawers is open when any is, closed when all are") {
  const auto goal = [](const std::string& text) {
    std::string problem = desk_with(":goal", text);
    problem.replace(problem.find("desk - table"), 12, "desk - table box - wooden_cabinet");
    return to_pddl(from_bddl(read_bddl(problem, "d").problem, desk_mapping()).goal);
  };
  CHECK(goal("(Open box)") == "(or (open box--bottom_drawer) (open box--middle_drawer) (open box--top_drawer))");
  CHECK(goal("(Close box)") ==
        "(and (closed box--bottom_drawer) (closed box--middle_drawer) (closed box--top_drawer))");
  // BEHAVIOR's `not open` is our `closed`, of all drawers.
  CHECK_THAT(to_pddl(kitchen_task("(not (open cabinet.n.01_1))").goal),
             Contains("(and (closed cabinet_1--bottom_drawer)"));
}

TEST_CASE("BEHAVIOR: names, rooms and the start") {
  const BddlTask task = kitchen_task("(cooked apple.n.01_1)");
  CHECK(task.name == "clear_kitchen_0");
  REQUIRE(task.fixtures.size() == 3);  // what :init puts into a room
  CHECK(task.fixtures[0].name == "cabinet_1");
  CHECK(task.rooms.at("cabinet_2") == "kitchen");  // of the wildcard
  CHECK(task.names.at("agent.n.01_1") == "panda.hand");
  CHECK(std::count(task.init.begin(), task.init.end(), BddlLiteral{{"closed", {"cabinet_1.top_drawer"}}, false}) == 1);
  CHECK(std::count(task.init.begin(), task.init.end(), BddlLiteral{{"on", {"apple_1", "floor_1"}}, false}) == 1);
  CHECK_THAT(task.warnings.at(0), Contains("(ontop agent.n.01_1 floor.n.01_1) is left out"));
}

TEST_CASE("imply and nested negation are pushed down to what we can say") {
  const BddlTask task =
      kitchen_task("(imply (cooked apple.n.01_1) (not (or (cooked apple.n.01_2) (nextto apple.n.01_3 bowl.n.01_1))))");
  CHECK(to_pddl(task.goal) == "(or (not (cooked apple_1)) (and (not (cooked apple_2)) (not (beside bowl_1 apple_3))))");
}

TEST_CASE("forn is written out as exactly n") {
  const BddlTask task = kitchen_task("(forn (2) (?apple.n.01 - apple.n.01) (cooked ?apple.n.01))");
  const BddlTask not_two = kitchen_task("(not (forn (2) (?apple.n.01 - apple.n.01) (cooked ?apple.n.01)))");
  for (int n = 0; n <= 3; ++n) {
    CHECK(ours(task, cooked(n)) == (n == 2));
    CHECK(ours(not_two, cooked(n)) == (n != 2));
  }
}

TEST_CASE("forpairs is a matching for us, and the star is where the verdicts differ") {
  const std::string goal =
      "(forpairs (?apple.n.01 - apple.n.01) (?bowl.n.01 - bowl.n.01) (nextto ?apple.n.01 ?bowl.n.01))";
  const BddlProblem problem = kitchen_of(kitchen_with_goal(goal));
  const BddlTask task = from_bddl(problem, kitchen_mapping());
  CHECK(task.goal.parts.size() == 6);  // 3! matchings
  int differ = 0;
  for (unsigned bits = 0; bits < 512; ++bits) {
    Facts theirs, facts;
    for (unsigned i = 0; i < 9; ++i) {
      if ((bits >> i & 1) == 0) continue;
      const std::string row = std::to_string(i / 3 + 1), column = std::to_string(i % 3 + 1);
      theirs.insert({"nextto", {"apple.n.01_" + row, "bowl.n.01_" + column}});
      facts.insert({"beside", {"bowl_" + column, "apple_" + row}});  // the mapping swaps the two
    }
    const BddlVerdicts verdicts = judge_both(problem, BddlFacts(theirs), task, {facts, {}, {}});
    REQUIRE(verdicts.theirs == judge(problem, BddlFacts(theirs)));
    REQUIRE((verdicts.theirs || !verdicts.ours));  // theirs is the weaker
    REQUIRE(verdicts.disagreements.empty() == (verdicts.theirs == verdicts.ours));
    if (bits == 0b001001111) {
      CHECK((verdicts.theirs && !verdicts.ours));
      CHECK_THAT(verdicts.disagreements.at(0), Contains("BEHAVIOR says yes, we say no; the atoms are the same"));
    }
    differ += verdicts.theirs != verdicts.ours ? 1 : 0;
  }
  CHECK(differ == 265 - 247);
}

TEST_CASE("verdicts name the literals on which they differ") {
  const BddlProblem problem = read_bddl(desk_with(":goal", "(And (On cup_1 cup_2) (Up cup_1))"), "d").problem;
  const BddlTask task = from_bddl(problem, desk_mapping());
  BddlGeometry low, high;
  low.touching = {"cup_1"};
  high.centre_m = {0.035, 0, 1.2};  // it rests on the other, 3.5 cm beside its centre
  const LiberoGeometry geometry({{"cup_1", high}, {"cup_2", low}});
  const Facts facts = {{"on", {"cup_1", "cup_2"}}, {"lifted", {"cup_1"}}};
  const BddlVerdicts verdicts = judge_both(problem, geometry, task, {facts, {}, {}});
  CHECK_FALSE(verdicts.theirs);
  CHECK(verdicts.ours);
  const std::vector<std::string> expected = {"(on cup_1 cup_2): LIBERO says no, we say yes",
                                             "(on cup_1 cup_2): LIBERO says no, we say yes"};
  CHECK(verdicts.disagreements == expected);  // the part of the goal, and the literal in it
}

TEST_CASE("what we cannot say is refused with the reason") {
  const std::string apple = "(?apple.n.01 - apple.n.01)", bowl = "(?bowl.n.01 - bowl.n.01)";
  CHECK_THAT(kitchen_task("(touching apple.n.01_1 bowl.n.01_1)").refusal, Contains("`touching` has no counterpart"));
  CHECK_THAT(kitchen_task("(forn (5) " + apple + " (cooked ?apple.n.01))").refusal, Contains("can never hold"));
  BddlMapping poor = kitchen_mapping();
  poor.categories.resize(poor.categories.size() - 2);
  const BddlProblem p = kitchen_of(kClearKitchen);
  CHECK_THAT(from_bddl(p, poor).refusal, Contains("no object of ours stands for `apple.n.01`, `bowl.n.01`"));
  BddlProblem many =
      read_bddl(kitchen_with_goal("(forpairs " + apple + bowl + " (nextto ?apple.n.01 ?bowl.n.01))"), "k").problem;
  for (int i = 4; i <= 7; ++i) {
    many.objects[0].names.push_back("apple.n.01_" + std::to_string(i));
    many.objects[2].names.push_back("bowl.n.01_" + std::to_string(i));
  }
  CHECK_THAT(from_bddl(many, kitchen_mapping()).refusal, Contains("more than 1000 cases"));  // 7! = 5040
  const BddlProblem desk = read_bddl(desk_with(":goal", "(And (False cup_1))"), "d").problem;
  CHECK_THAT(from_bddl(desk, desk_mapping()).refusal, Contains("can never hold"));
  const BddlProblem idle = read_bddl(desk_with(":goal", "(And (True cup_1))"), "d").problem;
  CHECK_THAT(from_bddl(idle, desk_mapping()).refusal, Contains("always holds"));
}

TEST_CASE("a mapping with unknown words is bad input") {
  BddlMapping bad = desk_mapping();
  bad.predicates.push_back({"stack", "on", false, {}, BddlMeaning::equal, ""});
  CHECK_THROWS_WITH(check_mapping(bad, "map.lua"), Contains("map.lua: LIBERO has no predicate `stack`"));
  bad = desk_mapping();
  bad.predicates[0].order = {0, 0};
  CHECK_THROWS_WITH(check_mapping(bad, "map.lua"), Contains("no permutation"));
  CHECK_THROWS_WITH(from_bddl(read_bddl(kTidyDesk, "d").problem, behavior_words()), Contains("is for BEHAVIOR"));
}

TEST_CASE("names become ours: well-formed, unique and not reserved") {
  std::string text = desk_with(":objects", "cup-1 cup_1 cup.1 end - cup 3cup - mug");
  text.replace(text.find("(and (on cup_1 desk))"), 21, "(and (on end desk))");
  const BddlTask task = from_bddl(read_bddl(text, "d").problem, desk_mapping());
  std::vector<std::string> names;
  for (const BddlObject& object : task.objects) names.push_back(object.name);
  CHECK(names == std::vector<std::string>{"cup_1", "cup_1_2", "cup_1_3", "end_thing", "thing_3cup"});
  CHECK(to_pddl(task.goal) == "(on end_thing desk)");
}
