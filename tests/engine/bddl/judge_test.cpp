// Their verdicts: the counting and pairing of BEHAVIOR, the geometry of LIBERO.
#include "engine/bddl/judge.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "texts.h"

using namespace stampede;

namespace {

BddlProblem kitchen(const std::string& goal) { return read_bddl(kitchen_with_goal(goal), "k").problem; }

// A 3 x 3 table of (nextto apple_i bowl_k) from bits, row by row.
Facts next_to(unsigned bits) {
  Facts facts;
  for (unsigned i = 0; i < 9; ++i) {
    if ((bits >> i & 1) == 0) continue;
    facts.insert({"nextto", {"apple.n.01_" + std::to_string(i / 3 + 1), "bowl.n.01_" + std::to_string(i % 3 + 1)}});
  }
  return facts;
}

bool has_matching(unsigned bits) {
  std::array<unsigned, 3> column = {0, 1, 2};
  do {
    if ((bits >> column[0] & bits >> (3 + column[1]) & bits >> (6 + column[2]) & 1) != 0) return true;
  } while (std::next_permutation(column.begin(), column.end()));
  return false;
}

constexpr const char* kPairs =
    "(forpairs (?apple.n.01 - apple.n.01) (?bowl.n.01 - bowl.n.01) (nextto ?apple.n.01 ?bowl.n.01))";

}  // namespace

TEST_CASE("forn is exactly n") {
  const BddlProblem p = kitchen("(forn (2) (?apple.n.01 - apple.n.01) (cooked ?apple.n.01))");
  Facts cooked;
  for (int n = 0; n <= 3; ++n) {
    if (n > 0) cooked.insert({"cooked", {"apple.n.01_" + std::to_string(n)}});
    CHECK(judge(p, BddlFacts(cooked)) == (n == 2));  // three of them are one too many
  }
}

TEST_CASE("forpairs counts rows and columns, which is weaker than a matching") {
  const BddlProblem p = kitchen(kPairs);
  const unsigned star = 0b001001111;  // the first apple with all bowls, all apples with the first bowl
  CHECK(judge(p, BddlFacts(next_to(star))));
  CHECK_FALSE(has_matching(star));
  int weaker = 0;
  for (unsigned bits = 0; bits < 512; ++bits) {
    unsigned rows = 0, columns = 0;
    for (unsigned i = 0; i < 3; ++i) {
      rows += (bits >> (3 * i) & 7) != 0 ? 1 : 0;
      columns += (bits >> i & 0b001001001) != 0 ? 1 : 0;
    }
    const bool theirs = judge(p, BddlFacts(next_to(bits)));
    REQUIRE(theirs == (rows == 3 && columns == 3));
    if (has_matching(bits)) REQUIRE(theirs);
    weaker += theirs && !has_matching(bits) ? 1 : 0;
  }
  // 265 tables have neither an empty row nor an empty column (inclusion and exclusion), 247 have a perfect matching
  // (0-1 matrices with a positive permanent).
  CHECK(weaker == 265 - 247);
}

TEST_CASE("fornpairs is the same test with n, and logic is as usual") {
  const std::string head = "(fornpairs (2) (?apple.n.01 - apple.n.01) (?bowl.n.01 - bowl.n.01) ";
  const BddlProblem p = kitchen(head + "(nextto ?apple.n.01 ?bowl.n.01))");
  CHECK(judge(p, BddlFacts(next_to(0b000010001))));
  CHECK(judge(p, BddlFacts(next_to(0b100010001))));        // three are at least two
  CHECK_FALSE(judge(p, BddlFacts(next_to(0b000000111))));  // one row
  const auto verdict = [](const std::string& goal, const Facts& facts) {
    return judge(kitchen(goal), BddlFacts(facts));
  };
  const Facts hot = {{"hot", {"apple.n.01_1"}}};
  const std::string each = " (?apple.n.01 - apple.n.01) (hot ?apple.n.01))";
  CHECK(verdict("(exists" + each, hot));
  CHECK_FALSE(verdict("(forall" + each, hot));
  CHECK(verdict("(not (forall" + each + ")", hot));
  CHECK(verdict("(imply (hot apple.n.01_2) (hot apple.n.01_3))", hot));
  CHECK_FALSE(verdict("(imply (hot apple.n.01_1) (hot apple.n.01_3))", hot));
  CHECK(verdict("(or (hot apple.n.01_2) (and (hot apple.n.01_1) (not (hot apple.n.01_3))))", hot));
  CHECK_THROWS_AS(verdict("(exists (?cabinet.n.01 - cabinet.n.01) (open ?cabinet.n.01))", hot), Error);  // a wildcard
}

TEST_CASE("LIBERO's goal is the conjunction of its list") {
  const BddlProblem p = read_bddl(desk_with(":goal", "(And (Up cup_1) (Open cup_2) (True cup_1))"), "d").problem;
  CHECK(judge(p, BddlFacts(Facts{{"up", {"cup_1"}}, {"open", {"cup_2"}}})));
  CHECK_FALSE(judge(p, BddlFacts(Facts{{"up", {"cup_1"}}})));
}

TEST_CASE("LIBERO: on asks for contact, order of height and 3 cm") {
  const auto on = [](double x, double y, double z, bool touching) {
    BddlGeometry cup, plate;
    cup.centre_m = {x, y, z};
    if (touching) cup.touching = {"plate"};
    return LiberoGeometry({{"cup", cup}, {"plate", plate}}).value({"on", {"cup", "plate"}});
  };
  CHECK(on(0, 0, 0.05, true));
  CHECK(on(0.02, 0.02, 0, true));  // 2.83 cm, same height
  CHECK_FALSE(on(0.03, 0, 0.05, true));
  CHECK_FALSE(on(0.022, 0.022, 0.05, true));  // 3.11 cm
  CHECK_FALSE(on(0, 0, -0.001, true));
  CHECK_FALSE(on(0, 0, 0.05, false));
}

TEST_CASE("LIBERO: on a region asks for its box and for contact with its parent") {
  const auto on = [](double x, double z, bool touching, bool parent) {
    BddlGeometry cup, spot, desk;
    cup.centre_m = {x, 0, z};
    spot.region = true;
    spot.parent = "desk";
    spot.half_size_m = {0.1, 0.05, 0.01};
    if (touching) desk.touching = {"cup"};
    std::map<std::string, BddlGeometry> things = {{"cup", cup}, {"spot", spot}};
    if (parent) things["desk"] = desk;
    return LiberoGeometry(things).value({"on", {"cup", "spot"}});
  };
  CHECK(on(0.09, 0.05, true, true));
  CHECK_FALSE(on(0.11, 0.05, true, true));
  CHECK_FALSE(on(0.09, 0.05, false, true));
  CHECK(on(0.09, 0.05, false, false));  // no parent in the scene: the box alone
  CHECK(on(0, 0.0051, true, true));     // half a centimetre into the top is allowed
  CHECK_FALSE(on(0, 0.0049, true, true));
  CHECK_FALSE(on(0, 0.111, true, true));  // 10 cm above the top is too high
}

TEST_CASE("LIBERO: in asks for the box, and for contact unless it is a region") {
  const auto in = [](double z, bool region, bool touching) {
    BddlGeometry cup, box;
    cup.centre_m = {0, 0, z};
    box.region = region;
    box.half_size_m = {0.1, 0.1, 0.1};
    if (touching) cup.touching = {"box"};
    return LiberoGeometry({{"cup", cup}, {"box", box}}).value({"in", {"cup", "box"}});
  };
  CHECK(in(0, true, false));
  CHECK_FALSE(in(0, false, false));
  CHECK(in(0, false, true));
  CHECK(in(-0.109, true, false));  // a centimetre deeper than the box
  CHECK_FALSE(in(-0.111, true, false));
  CHECK_FALSE(in(0.1, true, false));
}

TEST_CASE("LIBERO: open is any joint, close all of them, up one metre") {
  BddlGeometry half_open, bare, high;
  half_open.joints = {{true, false, false, true}, {false, true, true, false}};
  high.centre_m = {0, 0, 1.0};
  const LiberoGeometry scene({{"cabinet", half_open}, {"bare", bare}, {"high", high}});
  CHECK(scene.value({"open", {"cabinet"}}));
  CHECK_FALSE(scene.value({"close", {"cabinet"}}));
  CHECK(scene.value({"turnon", {"cabinet"}}));
  CHECK_FALSE(scene.value({"turnoff", {"cabinet"}}));
  CHECK_FALSE(scene.value({"open", {"bare"}}));
  CHECK(scene.value({"close", {"bare"}}));  // all of none
  CHECK(scene.value({"up", {"high"}}));
  CHECK_FALSE(scene.value({"up", {"cabinet"}}));
  CHECK_THROWS_AS(scene.value({"up", {"ghost"}}), Error);
  CHECK_THROWS_AS(scene.value({"nextto", {"bare", "high"}}), Error);
}
