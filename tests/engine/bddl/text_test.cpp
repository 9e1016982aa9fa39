// Reading and writing BDDL: the traps of its lexer and of both parsers.
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/bddl/bddl.h"
#include "texts.h"

using namespace stampede;
using Catch::Matchers::Contains;

TEST_CASE("a LIBERO problem is read with all its sections") {
  const BddlReading reading = read_bddl(kTidyDesk, "desk.bddl");
  const BddlProblem& p = reading.problem;
  CHECK(reading.warnings.empty());
  CHECK(p.dialect == BddlDialect::libero);
  CHECK(p.name == "libero_tabletop_manipulation");  // their lexer makes all letters small
  CHECK(p.language == "put the red mug in the top drawer and close it");
  REQUIRE(p.regions.size() == 3);
  CHECK(p.regions[0].key() == "desk_mug_spot");
  CHECK(p.regions[0].ranges == std::vector<BddlRectangle>{{-0.1, -0.02, -0.08, 0.0}});
  CHECK(p.regions[0].yaw_rad[1] == Approx(1.5707963267948966));  // pi/2, which they pass to eval
  CHECK(p.regions[1].rgba == std::array<double, 4>{1, 0, 0, 0.5});
  CHECK(p.regions[2].ranges.empty());
  CHECK(p.objects == std::vector<BddlGroup>{{"mug", {"mug_1", "mug_2"}}, {"plate", {"plate_1"}}});
  CHECK(p.interest == std::vector<std::string>{"mug_1", "cabinet_1"});
  CHECK(p.init.front().atom == Fact{"on", {"mug_1", "desk_mug_spot"}});
  REQUIRE(p.goal.size() == 2);
  CHECK(to_text(p.goal[0]) == "(in mug_1 cabinet_1_top_region)");
}

TEST_CASE("the order of sections does not matter, and writing gives one canonical text") {
  const BddlProblem forwards = read_bddl(kTidyDesk, "a").problem;
  const BddlProblem backwards = read_bddl(kTidyDeskBackwards, "b").problem;
  CHECK(forwards == backwards);
  CHECK(to_bddl(forwards) == to_bddl(backwards));
}

TEST_CASE("a second line of the same type is kept, with a word on what their parser would lose") {
  const BddlReading reading = read_bddl(desk_with(":objects", "cup_1 - cup cup_2 cup_3 - cup"), "d.bddl");
  CHECK(reading.problem.objects == std::vector<BddlGroup>{{"cup", {"cup_1", "cup_2", "cup_3"}}});
  REQUIRE(reading.warnings.size() == 1);
  CHECK_THAT(reading.warnings[0], Contains("keep only `cup_2 cup_3`") && Contains("d.bddl:"));
  // Another section of the same kind earlier in the file wins there, since theirs are consumed from the end.
  const BddlReading two = read_bddl(desk_with(":objects", "cup_1 - cup) (:objects cup_2 - cup"), "d.bddl");
  CHECK(two.problem.objects == std::vector<BddlGroup>{{"cup", {"cup_1", "cup_2"}}});
  CHECK_THAT(two.warnings.at(0), Contains("keep only `cup_1`"));
  // Written, both are on one line, so that nothing is lost any more.
  CHECK_THAT(to_bddl(reading.problem), Contains("    cup_1 cup_2 cup_3 - cup\n"));
}

TEST_CASE("second sections are joined and named") {
  const BddlReading init = read_bddl(desk_with(":init", "(On cup_1 desk_spot)) (:init (On cup_2 desk_spot)"), "d");
  CHECK(init.problem.init.size() == 2);
  CHECK_THAT(init.warnings.at(0), Contains("a second :init") && Contains("drop this one"));
  const BddlReading goal = read_bddl(desk_with(":goal", "(And (On cup_1 cup_2))) (:goal (Up cup_1)"), "d");
  CHECK(goal.problem.goal.size() == 2);
  CHECK_THAT(goal.warnings.at(0), Contains("a second :goal"));
  const BddlReading words = read_bddl(desk_with(":language", "one two) (:language three"), "d");
  CHECK(words.problem.language == "one two");
  CHECK(words.warnings.size() == 1);
  CHECK_THAT(read_bddl(desk_with(":mood", "merry"), "d").warnings.at(0), Contains("`:mood` is unknown"));
}

TEST_CASE("what their parsers choke on or lose is refused with place and cure") {
  struct Case {
    const char *section, *text, *what, *cure;
  };
  const Case section = GENERATE(values<Case>({
      {":goal", "(And)", "the goal is empty", "solved before anything happens"},
      {":goal", "", "the goal is empty", "name what must become true"},
      {":goal", "up", "expected a formula", ""},
      {":goal", "(Up cup_1) (Up cup_2)", "a second formula", "(and …)"},
      {":goal", "(And (Not (Open cup_1)))", "LIBERO reads `not` in a goal but cannot evaluate it",
       "one `and` of atoms"},
      {":goal", "(Or (Up cup_1) (Up cup_2))", "LIBERO reads `or`", "one `and` of atoms"},
      {":goal", "(And (And (Up cup_1)))", "LIBERO reads `and`", ""},
      {":goal", "(And (On cup_1 spot))", "has another name here", "write `desk_spot`"},
      {":goal", "(And (On cup_1))", "`on` takes 2 arguments, got 1", "(on a b)"},
      {":goal", "(And (Up cup_1 cup_2))", "`up` takes 1 argument, got 2", "(up a)"},
      {":goal", "(And (On cup_1 cup_9))", "`cup_9` is neither", "did you mean"},
      {":goal", "(And (Onn cup_1 cup_2))", "LIBERO has no predicate `onn`", "did you mean"},
      {":goal", "(And (Turnon desk_spot))", "AttributeError", "name the fixture"},
      {":scene_properties", "(floor (:floor wood))", "NameError", "remove the section"},
      {":objects", "cup_1 Cup_1 - cup", "declared twice", "differ only in case"},
      {":objects", "cup_1 cup_2", "without a type", "write `cup_2 - TYPE`"},
      {":objects", "cup_1 cup_2 - cup desk - cup", "`desk` is declared twice", ""},
      {":objects", "cup_1 cup_2 cup_* - cup", "no wildcard", ""},
      {":regions", "(spot (:ranges ((0 0 1 1))))", "no (:target OBJECT)", "name what it belongs to"},
      {":regions", "(spot (:target table))", "`desk_spot` is neither", ""},
      {":regions", "(spot (:target desk) (:range ((0 0 1 1))))", "no attribute `:range`", ":ranges"},
      {":regions", "(spot (:target desk) (:ranges ((0 0 1))))", "a rectangle needs 4 numbers", ""},
      {":regions", "(spot (:target desk) (:yaw_rotation ((0 tau))))", "`tau` is not a number", "-pi/2"},
      {":regions", "(spot (:target desk)) (spot (:target desk))", "`desk_spot` is declared twice", ""},
      {":init", "(Not (Open cup_1))", "LIBERO's :init cannot say `not`", "opposite"},
      {":language", "take (it)", "parentheses in :language", "plain words"},
      {":domain", "kitchen", "belongs to no known dialect", "robosuite"},
  }));
  INFO(section.section << " " << section.text);
  CHECK_THAT(complaint(desk_with(section.section, section.text)), Contains(section.what) && Contains(section.cure));
  CHECK_THAT(complaint(desk_with(section.section, section.text)), Contains("desk.bddl:"));
}

TEST_CASE("a region of something that is not there is left out, as long as nothing names it") {
  const BddlReading reading =
      read_bddl(desk_with(":regions", "(spot (:target desk)) (left_region (:target drainer_1))"), "d");
  REQUIRE(reading.problem.regions.size() == 1);
  CHECK_THAT(reading.warnings.at(0), Contains("`drainer_1_left_region` is left out"));
}

TEST_CASE("numbers are what their eval makes of them") {
  const auto yaw = [](const std::string& text) {
    const std::string region = "(spot (:target desk) (:yaw_rotation ((" + text + " 7))))";
    return read_bddl(desk_with(":regions", region), "d").problem.regions.at(0).yaw_rad[0];
  };
  const double pi = 3.14159265358979323846;
  CHECK(yaw("-pi/2") == Approx(-pi / 2));
  CHECK(yaw("3*np.pi/4") == Approx(3 * pi / 4));
  CHECK(yaw("1e-3+--2") == Approx(2.001));
  CHECK(yaw("-1.5-2*-pi") == Approx(-1.5 + 2 * pi));
  CHECK_THROWS_AS(yaw("1/0"), Error);
  CHECK_THROWS_AS(yaw("1e999"), Error);
  CHECK_THROWS_AS(yaw(std::string(1'000'000, '-')), Error);
}

TEST_CASE("places of complaints are line and column") {
  CHECK_THAT(complaint("(define (problem p)\n  (:domain robosuite)\n  (:goal (and (up cup))))"),
             Contains("desk.bddl:3:15:"));
  CHECK_THAT(complaint("(define (problem p) (:domain robosuite)"),
             Contains("desk.bddl:1:1") && Contains("never closed"));
  CHECK_THAT(complaint("(define (problem p)) (define)"), Contains("after the last"));
  CHECK_THAT(complaint(""), Contains("empty"));
  CHECK_THAT(complaint("(problem p)"), Contains("begins with (define"));
  CHECK_THAT(complaint("(define (problem p) (:domain robosuite))"), Contains("no (:goal …)"));
}

TEST_CASE("a BEHAVIOR problem is read with negation, quantifiers and wildcards") {
  const BddlReading reading = read_bddl(kClearKitchen, "k.bddl");
  const BddlProblem& p = reading.problem;
  CHECK(reading.warnings.empty());
  CHECK(p.dialect == BddlDialect::behavior);
  CHECK(p.objects[1] == BddlGroup{"cabinet.n.01", {"cabinet.n.01_1", "cabinet.n.01_*"}});
  CHECK(p.init[3] == BddlLiteral{{"open", {"cabinet.n.01_1"}}, true});
  REQUIRE(p.goal.size() == 5);
  CHECK(p.goal[0].kind == BddlFormula::Kind::forall);
  CHECK(p.goal[0].variables[0] == Parameter{"apple.n.01", "apple.n.01", {}});
  CHECK(p.goal[0].parts[0].terms == std::vector<Term>{{true, "apple.n.01"}, {false, "cabinet.n.01_1"}});
  CHECK(p.goal[1].kind == BddlFormula::Kind::forn);
  CHECK(p.goal[1].count == 2);
  CHECK(p.goal[2].kind == BddlFormula::Kind::fornpairs);
  CHECK(p.goal[3].kind == BddlFormula::Kind::implication);
}

TEST_CASE("what BEHAVIOR cannot mean is refused") {
  const auto [goal, what] = GENERATE(table<const char*, const char*>({
      {"(forall (?pear.n.01 - pear.n.01) (cooked ?pear.n.01))", "no object is of the category `pear.n.01`"},
      {"(forall (?apple.n.01 - apple.n.01) (exists (?apple.n.01 - apple.n.01) (cooked ?apple.n.01)))", "bound twice"},
      {"(fornpairs (4) (?apple.n.01 - apple.n.01) (?bowl.n.01 - bowl.n.01) (inside ?apple.n.01 ?bowl.n.01))",
       "at most 3"},
      {"(forn 2 (?apple.n.01 - apple.n.01) (cooked ?apple.n.01))", "a number in parentheses"},
      {"(forn (-1) (?apple.n.01 - apple.n.01) (cooked ?apple.n.01))", "a number in parentheses"},
      {"(not (open cabinet.n.01_1) (open cabinet.n.01_1))", "`not` needs 1 formula"},
      {"(and (or) (open cabinet.n.01_1))", "`or` needs at least 1"},
      {"(open cabinet.n.01_*)", "wildcard `cabinet.n.01_*` in the goal"},
      {"(cooked ?apple.n.01)", "`apple.n.01` is neither"},
  }));
  INFO(goal);
  CHECK_THAT(complaint(kitchen_with_goal(goal)), Contains(what));
}

TEST_CASE("a wildcard stands in one room") {
  BddlProblem nowhere = read_bddl(kClearKitchen, "k").problem;
  nowhere.init.erase(nowhere.init.begin() + 2);
  CHECK_THROWS_WITH(to_bddl(nowhere), Contains("stands in 0 rooms"));
}

TEST_CASE("a value that their parser would not read back is not written") {
  const BddlProblem good = read_bddl(kTidyDesk, "d").problem;
  const auto refused = [&](void (*spoil)(BddlProblem&)) {
    BddlProblem bad = good;
    spoil(bad);
    try {
      to_bddl(bad);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("written");
  };
  CHECK_THAT(refused([](BddlProblem& p) { p.name = "Tidy"; }), Contains("`Tidy` cannot be its name"));
  CHECK_THAT(refused([](BddlProblem& p) { p.objects.push_back({"mug", {"mug_3"}}); }), Contains("has two lines"));
  CHECK_THAT(refused([](BddlProblem& p) { p.objects[0].names[0] = "mug 1"; }), Contains("`mug 1` cannot be"));
  CHECK_THAT(refused([](BddlProblem& p) { p.language = "Put it"; }), Contains("would not be read back"));
  CHECK_THAT(refused([](BddlProblem& p) { p.language = "put it (there)"; }), Contains("would not be read back"));
  CHECK_THAT(refused([](BddlProblem& p) { p.goal.clear(); }), Contains("the goal is empty"));
  CHECK_THAT(refused([](BddlProblem& p) { p.interest.push_back("ghost"); }), Contains("`ghost` is neither"));
  CHECK_THAT(refused([](BddlProblem& p) { p.init[0].negated = true; }), Contains("cannot say `not`"));
  CHECK_THAT(refused([](BddlProblem& p) { p.domain = "igibson"; }), Contains("not of this dialect"));
}
