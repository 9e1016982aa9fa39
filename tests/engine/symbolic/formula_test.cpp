#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/symbolic/instances.h"
#include "kitchen.h"

using namespace stampede;

namespace {

bool truth(const std::string& text, const Facts& facts, const Problem& problem, const Domain& domain) {
  return holds(formula_from_pddl(text, "test"), facts, domain, problem.objects);
}

}  // namespace

TEST_CASE("every kind of formula holds exactly when its definition says so") {
  const Domain domain = test::kitchen();
  const Problem problem = test::kitchen_problem(domain, "(and)");
  const Facts facts = with_derived(problem.init, domain, problem.objects);
  const auto is = [&](const char* text) { return truth(text, facts, problem, domain); };
  CHECK(is("(and)"));
  CHECK_FALSE(is("(or)"));
  CHECK(is("(on cup1 cup2)"));
  CHECK_FALSE(is("(on cup2 cup1)"));  // closed world
  CHECK(is("(not (on cup2 cup1))"));
  CHECK(is("(= cup1 cup1)"));
  CHECK_FALSE(is("(= cup1 cup2)"));
  CHECK(is("(and (hand_empty) (closed chest--drawer))"));
  CHECK_FALSE(is("(and (hand_empty) (open chest--drawer))"));
  CHECK(is("(or (open chest--drawer) (hand_empty))"));
  CHECK(is("(exists (?x - cup) (on ?x table))"));
  CHECK_FALSE(is("(exists (?x - drawer) (on ?x table))"));  // only drawers are tried
  CHECK(is("(forall (?x - cup) (exists (?y) (on ?x ?y)))"));
  CHECK_FALSE(is("(forall (?x - cup) (on ?x table))"));
  CHECK(is("(imply (open chest--drawer) (or))"));
}

TEST_CASE("derived facts follow from basic ones, through traits and recursion") {
  const Domain domain = test::kitchen();
  const Problem problem = test::kitchen_problem(domain, "(and)");
  const Facts facts = with_derived(problem.init, domain, problem.objects);
  CHECK(facts.contains(Fact{"clear", {"cup1"}}));
  CHECK_FALSE(facts.contains(Fact{"clear", {"cup2"}}));          // cup1 is on it
  CHECK_FALSE(facts.contains(Fact{"clear", {"chest.drawer"}}));  // not movable
  const Domain tower = domain_from_pddl(
      "(define (domain tower) (:predicates (on ?x ?y) (above ?x ?y)) (:derived (above ?x ?y) (or (on ?x ?y) "
      "(exists (?z) (and (on ?x ?z) (above ?z ?y))))))",
      "tower.pddl");
  const std::vector<TypedObject> objects = {{"a", "object"}, {"b", "object"}, {"c", "object"}, {"d", "object"}};
  const Facts all = with_derived({{"on", {"a", "b"}}, {"on", {"b", "c"}}, {"on", {"c", "d"}}}, tower, objects);
  CHECK(all.size() == 3 + 6);  // three links, and all six ordered pairs are `above`
}

TEST_CASE("a predicate derived from its own negation is refused") {
  const Domain domain = domain_from_pddl(
      "(define (domain odd) (:predicates (p) (q)) (:derived (p) (not (q))) (:derived (q) (p)))", "odd.pddl");
  CHECK_THROWS_WITH(with_derived({}, domain, {}), Catch::Contains("is derived from its own negation"));
}

TEST_CASE("unmet names what a person would have to make true") {
  const Domain domain = test::kitchen();
  const Problem problem = test::kitchen_problem(domain, "(and)");
  const Facts facts = with_derived(problem.init, domain, problem.objects);
  const auto missing = [&](const char* text) {
    return unmet(formula_from_pddl(text, "test"), facts, domain, problem.objects);
  };
  using Texts = std::vector<std::string>;
  CHECK(missing("(and (on cup1 cup2) (open chest--drawer) (not (hand_empty)))") ==
        Texts{"(open chest.drawer)", "(not (hand_empty))"});
  CHECK(missing("(forall (?x - cup) (on ?x table))") == Texts{"(on cup1 table)"});
  CHECK(missing("(or (open chest--drawer) (holding cup1))") == Texts{"one of: (open chest.drawer) or (holding cup1)"});
  CHECK(missing("(hand_empty)").empty());
  // Of many ways the nearest are named, and the others are counted.
  CHECK(
      missing("(or (and (holding cup1) (holding cup2)) (and (holding cup1) (open chest--drawer)) (holding cup2) "
              "(and (hand_empty) (holding cup1)) (and (holding cup1) (on cup2 cup1)) (open chest--drawer))") ==
      Texts{"one of: (holding cup2) or (holding cup1) or (open chest.drawer) or (holding cup1) and (holding cup2) or 2 "
            "other ways"});
}

TEST_CASE("unmet names each literal once, in seconds where there are many") {
  Domain domain;
  domain.predicates = {{"near", {{"a", "", {}}, {"b", "", {}}}, {}, {}, {}}};
  std::vector<TypedObject> objects;
  for (int i = 0; i < 400; ++i) objects.push_back({"o" + std::to_string(1000 + i), "object"});
  Formula all;
  all.kind = Formula::Kind::forall;
  all.variables = {{"x", "", {}}, {"y", "", {}}};
  all.parts = {atom("near", {{true, "x"}, {true, "y"}})};
  const std::vector<std::string> texts = unmet(conjunction({all, all}), {}, domain, objects);
  REQUIRE(texts.size() == 160'000);
  CHECK(texts.front() == "(near o1000 o1000)");
  CHECK(texts.back() == "(near o1399 o1399)");
}

TEST_CASE("instances are counted by type and trait, quantifiers in quantifiers multiplied, and limited") {
  const Domain domain = domain_from_pddl("(define (domain d) (:types cup pan) (:predicates (old ?x) (p ?x ?y)))", "d");
  std::vector<TypedObject> objects;
  for (int i = 0; i < 500; ++i) objects.push_back({"c" + std::to_string(i), i < 400 ? "cup" : "pan"});
  const Facts none;
  const symbolic::View view{none, domain, objects};
  CHECK(symbolic::instances_of({{"x", "cup", {}}, {"y", "pan", {}}}, view) == 40'000);
  CHECK(symbolic::times(std::int64_t{1} << 40, std::int64_t{1} << 40) == 1'000'000'000'000'000'000);
  CHECK(symbolic::times(3, 0) == 0);
  const auto limited = [&](const std::string& text) {
    symbolic::limit_instances(formula_from_pddl(text, "f"), view, "here");
  };
  CHECK_NOTHROW(limited("(and (forall (?x - cup ?y - cup) (p ?x ?y)) (forall (?x - cup ?y - cup) (p ?y ?x)))"));
  CHECK_THROWS_WITH(limited("(forall (?x - cup) (exists (?y ?z) (p ?y ?z)))"),
                    Catch::Contains("here: exists over ?x ?y ?z: 100,000,000 instances, at most 200,000"));
  CHECK_THROWS_WITH(symbolic::limit_instances("action go", {{"x", "cup", {}}, {"y", "", {}}, {"z", "", {}}}, view, "f"),
                    Catch::Contains("f: action go over ?x ?y ?z: 100,000,000 instances"));
}

TEST_CASE("effects read the state before, additions win over removals") {
  const Domain domain = domain_from_pddl(
      "(define (domain lamps) (:types lamp) (:predicates (lit ?l - lamp) (used)) (:action toggle :parameters () "
      ":precondition (and) :effect (and (used) (not (used)) (forall (?l - lamp) (and (when (lit ?l) (not (lit ?l))) "
      "(when (not (lit ?l)) (lit ?l)))))))",
      "lamps.pddl");
  const std::vector<TypedObject> objects = {{"a", "lamp"}, {"b", "lamp"}};
  const Facts after = apply(domain.actions.front(), {}, {{"lit", {"a"}}}, domain, objects);
  CHECK(after == Facts{{"lit", {"b"}}, {"used", {}}});
}
