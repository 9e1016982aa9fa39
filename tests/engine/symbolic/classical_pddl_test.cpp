// What the domains of planning competitions write, and what broken ones get told.
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/symbolic/pddl.h"

using namespace stampede;

namespace {

Domain domain_of(const std::string& text) { return domain_from_pddl("(define (domain d) " + text + ")", "d.pddl"); }

std::string refusal(const std::string& text) {
  try {
    domain_of(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace

TEST_CASE("`?` ends a word: (aircraft?a) is (aircraft ?a)") {
  const Domain domain = domain_of(
      "(:predicates (aircraft?a) (at?a?c)) (:action go :parameters (?x?y) :precondition (at?x ?y)"
      " :effect (not(at ?x?y)))");
  CHECK(domain.predicate("aircraft")->parameters.size() == 1);
  CHECK(domain.predicate("at")->parameters.size() == 2);
  CHECK(domain.actions[0].precondition == atom("at", {{true, "x"}, {true, "y"}}));
  CHECK(domain_from_pddl(to_pddl(domain), "again") == domain);
  CHECK(refusal("(:predicates (at ? a))").find("d.pddl:1:37: expected a variable such as `?x`, got `?`") == 0);
}

TEST_CASE("a type on several lines has the parent that lies below the others") {
  const Domain domain = domain_of(
      "(:types hoist surface area - object crate area - surface yard - area yard - surface yard) (:predicates (p))");
  CHECK(domain.types ==
        std::map<std::string, std::string>{
            {"area", "surface"}, {"crate", "surface"}, {"hoist", "object"}, {"surface", "object"}, {"yard", "area"}});
  CHECK(refusal("(:types a - b a - c)").find("`a` has parents of which none descends from the others: `b`, `c`") !=
        std::string::npos);
  CHECK(refusal("(:types a - b b - c a - object c - a)").find("descends from itself") != std::string::npos);
}

TEST_CASE("a variable twice in a predicate's declaration only says that there are two arguments") {
  const Domain domain = domain_of(
      "(:types t) (:predicates (near ?x ?x - t) (far ?x ?x_2 ?X)) (:action go :parameters (?a ?b - t)"
      " :precondition (near ?a ?b) :effect (not (near ?a ?b)))");
  const Predicate& near = *domain.predicate("near");
  CHECK(near.parameters == std::vector<Parameter>{{"x", "t", {}}, {"x_2", "t", {}}});
  CHECK(domain.predicate("far")->parameters.size() == 3);
  CHECK(domain_from_pddl(to_pddl(domain), "again") == domain);
  CHECK(refusal("(:predicates (p ?x)) (:action a :parameters (?x ?x))").find("`?x` is declared twice") !=
        std::string::npos);
}

TEST_CASE("broken type lists are told with line and column") {
  const auto is_told = [](const char* text) {
    const std::string said = refusal(text);
    INFO(text << "\n" << said);
    CHECK(said.find("d.pddl:1:") == 0);
    CHECK(said.find("map::at") == std::string::npos);
  };
  for (const char* text :
       {"(:types c - -)", "(:types c -)", "(:types c - - -)", "(:types c - (either a))", "(:types c - (a))",
        "(:types (a))", "(:types c - ?x)", "(:types ?c)", "(:types a - a)", "(:types a - b b - a)",
        "(:types c) (:predicates (p ?x - -))", "(:types c) (:constants a - -)", "(:predicates (p ?x - ?y))",
        "(:types a b - ())", "(:functions (f ?x - -))"}) {
    is_told(text);
  }
  CHECK(refusal("(:types     c - -) \n \n") ==
        "d.pddl:1:36: expected the name of a type after `-`, got `-`\n    write `- object` where any type will do");
}
