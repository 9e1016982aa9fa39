// Random problems through our writer, our reader and a model of their parser.
#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/bddl/bddl.h"
#include "texts.h"
#include "their_parser.h"

using namespace stampede;
using Catch::Matchers::Contains;

namespace {

class Maker {
 public:
  explicit Maker(int round) : random_(RandomKey("bddl property").with(round)) {}

  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.below(static_cast<std::int64_t>(n))); }
  template <typename T>
  const T& pick(const std::vector<T>& from) {
    return from[below(from.size())];
  }

  BddlProblem libero() {
    BddlProblem p;
    p.name = "libero_floor_manipulation";
    p.domain = "robosuite";
    p.language = below(3) == 0 ? "" : "pick the cup - up";
    p.fixtures = {{"table", {"table_1"}}, {"stove", {"stove_1", "stove_2"}}};
    for (std::size_t g = 0; g < 1 + below(3); ++g) {
      BddlGroup group{"kind" + std::to_string(g), {}};
      for (std::size_t i = 0; i < 1 + below(4); ++i) group.names.push_back(group.category + "_" + std::to_string(i));
      p.objects.push_back(group);
    }
    std::vector<std::string> things = {"table_1", "stove_1", "stove_2"}, all;
    for (const BddlGroup& group : p.objects) things.insert(things.end(), group.names.begin(), group.names.end());
    all = things;
    for (std::size_t r = 0; r < below(5); ++r) {
      BddlRegion region;
      region.name = "r" + std::to_string(r);
      region.target = pick(things);
      for (std::size_t k = 0; k < below(3); ++k) region.ranges.push_back({number(), number(), number(), number()});
      if (below(2) == 0) region.yaw_rad = {number(), number()};
      if (below(3) == 0) region.rgba = {number(), 0.5, 1e-9, 1};
      p.regions.push_back(region);
      all.push_back(region.key());
    }
    for (std::size_t i = 0; i < below(6); ++i) p.init.push_back({fact(all), false});
    for (std::size_t i = 0; i < 1 + below(4); ++i) {
      const Fact one = fact(all);
      BddlFormula atom;
      atom.predicate = one.predicate;
      for (const std::string& name : one.arguments) atom.terms.push_back({false, name});
      p.goal.push_back(atom);
    }
    for (std::size_t i = 0; i < below(3); ++i) p.interest.push_back(pick(all));
    return p;
  }

  BddlProblem behavior() {
    BddlProblem p;
    p.dialect = BddlDialect::behavior;
    p.name = "sort_things-0";
    p.domain = pick(std::vector<std::string>{"igibson", "omnigibson", "behavior-1k"});
    for (const char* category : {"cup.n.01", "tray.n.02", "can__of__soda.n.01"}) {
      BddlGroup group{category, {}};
      for (std::size_t i = 1; i <= 1 + below(3); ++i) group.names.push_back(group.category + "_" + std::to_string(i));
      p.objects.push_back(group);
    }
    if (below(2) == 0) {
      p.objects[1].names.push_back("tray.n.02_*");
      p.init.push_back({{"inroom", {"tray.n.02_*", "kitchen"}}, false});
    }
    for (std::size_t i = 0; i < below(4); ++i) p.init.push_back({{"ontop", {thing(p), thing(p)}}, false});
    for (std::size_t i = 0; i < below(2); ++i) p.init.push_back({{"open", {thing(p)}}, true});
    for (std::size_t i = 0; i < 1 + below(3); ++i) p.goal.push_back(formula(p, {}, 4));
    return p;
  }

 private:
  double number() { return random_.between(-1, 1) * (below(4) == 0 ? 1e-7 : 1); }
  Fact fact(const std::vector<std::string>& all) {
    if (below(3) == 0) return {pick(std::vector<std::string>{"open", "close", "up"}), {pick(all)}};
    return {pick(std::vector<std::string>{"on", "in"}), {pick(all), pick(all)}};
  }
  std::string thing(const BddlProblem& p) { return pick(p.objects).names.front(); }

  BddlFormula formula(const BddlProblem& p, std::vector<Parameter> bound, int depth) {
    using Kind = BddlFormula::Kind;
    BddlFormula f;
    f.kind = depth == 0 ? Kind::atom : static_cast<Kind>(below(10));
    std::vector<Parameter> free;
    for (const BddlGroup& group : p.objects) {
      const auto same = [&](const Parameter& v) { return v.name == group.category; };
      if (std::none_of(bound.begin(), bound.end(), same)) free.push_back({group.category, group.category, {}});
    }
    const std::size_t variables = f.kind == Kind::forpairs || f.kind == Kind::fornpairs ? 2
                                  : f.kind >= Kind::forall                              ? 1
                                                                                        : 0;
    if (free.size() < variables) f.kind = Kind::atom;
    if (f.kind == Kind::atom) {
      f.predicate = "nextto";
      for (int i = 0; i < 2; ++i)
        f.terms.push_back(bound.empty() || below(2) == 0 ? Term{false, thing(p)} : Term{true, pick(bound).name});
      return f;
    }
    f.variables.assign(free.begin(), free.begin() + static_cast<std::ptrdiff_t>(variables));
    if (f.kind == Kind::forn) f.count = static_cast<int>(below(3));
    if (f.kind == Kind::fornpairs) f.count = static_cast<int>(below(2));
    bound.insert(bound.end(), f.variables.begin(), f.variables.end());
    const bool many = f.kind == Kind::conjunction || f.kind == Kind::disjunction;
    const std::size_t parts = many ? 1 + below(3) : f.kind == Kind::implication ? 2 : 1;
    for (std::size_t i = 0; i < parts; ++i) f.parts.push_back(formula(p, bound, depth - 1));
    return f;
  }

  Random random_;
};

std::map<std::string, std::vector<std::string>> as_map(const std::vector<BddlGroup>& groups) {
  std::map<std::string, std::vector<std::string>> result;
  for (const BddlGroup& group : groups) result[group.category] = group.names;
  return result;
}

std::string without_marks(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), '?'), text.end());
  return text;
}

// Their parser finds in the text all that the value holds.
void check_theirs(const BddlProblem& p, const std::string& text) {
  const TheirProblem theirs = their_problem(text);
  CHECK(theirs.name == p.name);
  CHECK(theirs.language == p.language);
  CHECK(theirs.objects == as_map(p.objects));
  CHECK(theirs.fixtures == as_map(p.fixtures));
  CHECK(theirs.interest == p.interest);
  REQUIRE(theirs.regions.size() == p.regions.size());
  for (const BddlRegion& region : p.regions) CHECK(theirs.regions.count(region.key()) == 1);
  REQUIRE(theirs.init.size() == p.init.size());
  for (std::size_t i = 0; i < p.init.size(); ++i) {
    const std::string atom = to_text(p.init[i].atom);
    CHECK(theirs.init[i] == (p.init[i].negated ? "(not " + atom + ")" : atom));
  }
  REQUIRE(theirs.goal.size() == p.goal.size());
  for (std::size_t i = 0; i < p.goal.size(); ++i) {
    CHECK(without_marks(theirs.goal[i]) == without_marks(to_text(p.goal[i])));
  }
}

}  // namespace

TEST_CASE("reading what was written is the identity, and their parser loses nothing of it") {
  for (int round = 0; round < 300; ++round) {
    Maker maker(round);
    const BddlProblem p = round % 2 == 0 ? maker.libero() : maker.behavior();
    const std::string text = to_bddl(p);
    INFO(text);
    const BddlReading reading = read_bddl(text, "again");
    REQUIRE(reading.problem == p);
    REQUIRE(to_bddl(reading.problem) == text);
    check_theirs(p, text);
  }
}

TEST_CASE("what the warnings say their parser does is what its model does") {
  const std::string lines = desk_with(":objects", "cup_1 - cup cup_2 cup_3 - cup");
  CHECK(their_problem(lines).objects.at("cup") == std::vector<std::string>{"cup_2", "cup_3"});
  CHECK_THAT(read_bddl(lines, "d").warnings.at(0), Contains("keep only `cup_2 cup_3`"));
  const std::string sections = desk_with(":objects", "cup_1 - cup) (:objects cup_2 - cup");
  CHECK(their_problem(sections).objects.at("cup") == std::vector<std::string>{"cup_1"});
  CHECK_THAT(read_bddl(sections, "d").warnings.at(0), Contains("keep only `cup_1`"));
  const std::string inits = desk_with(":init", "(on cup_1 desk)) (:init (on cup_2 desk)");
  CHECK(their_problem(inits).init == std::vector<std::string>{"(on cup_1 desk)"});
  CHECK_THAT(read_bddl(inits, "d").warnings.at(0), Contains("would drop this one"));
  const std::string goals = desk_with(":goal", "(and (up cup_1))) (:goal (up cup_2)");
  CHECK(their_problem(goals).goal == std::vector<std::string>{"(up cup_2)", "(up cup_1)"});  // both, from the end
  CHECK(their_problem(desk_with(":goal", "(And)")).goal.empty());                            // solved at once
  CHECK_THROWS(their_problem("(define (problem p)"));
  CHECK_THROWS(their_problem("(define) (define)"));
}

TEST_CASE("damaged text is refused or read, never more") {
  int read = 0, refused = 0;
  for (int round = 0; round < 3000; ++round) {
    Maker maker(round);
    std::string text = round % 2 == 0 ? kTidyDesk : kClearKitchen;
    for (std::size_t k = 0; k < 1 + maker.below(3); ++k) {
      const std::size_t at = maker.below(text.size()), length = maker.below(30);
      const std::string piece = text.substr(maker.below(text.size()), length);
      if (maker.below(2) == 0) text.erase(at, length);
      text.insert(std::min(at, text.size()),
                  maker.below(3) == 0 ? std::string(1, static_cast<char>(maker.below(256))) : piece);
    }
    try {
      const BddlProblem p = read_bddl(text, "damaged").problem;
      ++read;
      REQUIRE(read_bddl(to_bddl(p), "again").problem == p);  // what is read can be written
    } catch (const Error&) {
      ++refused;
    }
  }
  CHECK(read > 50);
  CHECK(refused > 1000);
}

TEST_CASE("deep nesting is an error or a formula, never a crash") {
  std::string deep = "(open cabinet.n.01_1)";
  for (int i = 0; i < 200; ++i) deep = "(not " + deep + ")";
  CHECK(read_bddl(kitchen_with_goal(deep), "k").problem.goal.size() == 1);
  std::string open;
  for (int i = 0; i < 100'000; ++i) open += "(not ";
  deep = open + deep + std::string(100'000, ')');
  CHECK_THROWS_AS(read_bddl(kitchen_with_goal(deep), "k"), Error);
}
