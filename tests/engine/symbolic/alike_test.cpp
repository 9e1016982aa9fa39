// Crowds of objects that are alike: plans of a few of them, and what must not be left out.
#include "engine/symbolic/alike.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "engine/symbolic/pddl.h"

using namespace stampede;

namespace {

constexpr const char* kDomain = R"((define (domain shelves)
  (:requirements :strips :typing :negative-preconditions :universal-preconditions)
  (:types book shelf)
  (:predicates (on ?b - book ?s - shelf) (held ?b - book) (free) (red ?b - book) (above ?b - book ?c - book))
  (:action take :parameters (?b - book ?s - shelf)
    :precondition (and (on ?b ?s) (free) (forall (?c - book) (not (above ?c ?b))))
    :effect (and (held ?b) (not (free)) (not (on ?b ?s)) (forall (?c - book) (not (above ?b ?c)))))
  (:action put :parameters (?b - book ?s - shelf)
    :precondition (held ?b)
    :effect (and (on ?b ?s) (free) (not (held ?b))))))";

// Forty books on one shelf; b39 lies on b0, b38 on b39.
Problem problem_of(const Domain& domain, const std::string& goal) {
  std::string books, facts = "(free) (above b39 b0) (above b38 b39)";
  for (int i = 0; i < 40; ++i) {
    const std::string book = "b" + std::to_string(i);
    books += book + " ";
    facts += " (on " + book + " low)";
    if (i % 2 == 1) facts += " (red " + book + ")";  // nothing asks for it
  }
  return problem_from_pddl("(define (problem p) (:domain shelves) (:objects " + books +
                               "- book low high - shelf)\n(:init " + facts + ")\n(:goal " + goal + "))",
                           "p.pddl", domain);
}

}  // namespace

TEST_CASE("of a crowd that nothing tells apart a few stay, and of the rest everybody") {
  const Domain domain = domain_from_pddl(kDomain, "d.pddl");
  const Problem problem = problem_of(domain, "(on b0 high)");
  const auto fewer = symbolic::without_crowds(domain, problem, {});
  REQUIRE(fewer);
  const auto has = [&](const std::string& name) {
    return std::any_of(fewer->objects.begin(), fewer->objects.end(),
                       [&](const TypedObject& object) { return object.name == name; });
  };
  for (const char* name : {"b0", "b38", "b39", "low", "high"}) CHECK(has(name));  // named, or told apart by facts
  CHECK(fewer->objects.size() == 7);                                              // and two of the other 37
  for (const Fact& fact : fewer->init)
    for (const std::string& argument : fact.arguments) CHECK(has(argument));
  const PlanOutcome outcome = solve(domain, problem);
  REQUIRE(outcome.solved);
  CHECK(validate(domain, problem, outcome.plan).valid);
  CHECK(outcome.plan.size() == 6);  // b38 and b39 away, then b0
  CHECK(symbolic::without_crowds(domain, problem, {{"take", {"b7", "low"}}})->objects.size() == 8);
}

TEST_CASE("a goal for the whole crowd is planned with all of it") {
  const Domain domain = domain_from_pddl(kDomain, "d.pddl");
  const Problem problem = problem_of(domain, "(forall (?b - book) (on ?b high))");
  REQUIRE(symbolic::without_crowds(domain, problem, {}));
  const PlanOutcome outcome = solve(domain, problem);
  REQUIRE(outcome.solved);
  CHECK(validate(domain, problem, outcome.plan).valid);
  CHECK(outcome.plan.size() == 80);
}

TEST_CASE("where few of a crowd do not do, the search among them ends soon") {
  // Three unnamed books must be held at once by three hands: no plan with two books.
  const Domain domain = domain_from_pddl(R"((define (domain hands)
    (:requirements :strips :typing :equality :existential-preconditions)
    (:types book hand)
    (:predicates (held ?b - book ?h - hand) (lies ?b - book) (empty ?h - hand))
    (:action take :parameters (?b - book ?h - hand)
      :precondition (and (lies ?b) (empty ?h))
      :effect (and (held ?b ?h) (not (lies ?b)) (not (empty ?h))))
    (:action put :parameters (?b - book ?h - hand)
      :precondition (held ?b ?h) :effect (and (lies ?b) (empty ?h) (not (held ?b ?h))))))",
                                         "d.pddl");
  std::string books, lying;
  for (int i = 0; i < 12; ++i) {
    books += "b" + std::to_string(i) + " ";
    lying += "(lies b" + std::to_string(i) + ") ";
  }
  const Problem problem = problem_from_pddl("(define (problem p) (:domain hands) (:objects " + books +
                                                "- book l m r - hand) (:init " + lying +
                                                "(empty l) (empty m) (empty r)) (:goal (exists (?x ?y ?z - book) (and "
                                                "(held ?x l) (held ?y m) (held ?z r)))))",
                                            "p.pddl", domain);
  const auto fewer = symbolic::without_crowds(domain, problem, {});
  REQUIRE(fewer);
  CHECK_FALSE(solve(domain, *fewer).solved);
  const PlanOutcome outcome = solve(domain, problem);
  REQUIRE(outcome.solved);
  CHECK(outcome.plan.size() == 3);
}
