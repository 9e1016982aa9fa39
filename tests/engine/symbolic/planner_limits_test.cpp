// What is too large is refused with a count and a cure; what only looks large is planned.
#include <catch2/catch.hpp>

#include "engine/symbolic/pddl.h"

using namespace stampede;

namespace {

const char* const kBlocks =
    "(define (domain d) (:types block) (:predicates (on ?x ?y - block) (clear ?x - block) (down ?x - block))"
    " (:action stack :parameters (?x ?y - block) :precondition (and (clear ?x) (clear ?y) (down ?x) (not (= ?x ?y)))"
    " :effect (and (on ?x ?y) (not (clear ?y)) (not (down ?x)))))";

Problem blocks_problem(const Domain& domain, int count, const std::string& goal) {
  std::string objects, init;
  for (int i = 0; i < count; ++i) {
    const std::string name = " b" + std::to_string(i);
    objects += name;
    init += " (clear" + name + ") (down" + name + ")";
  }
  return problem_from_pddl(
      "(define (problem p) (:domain d) (:objects" + objects + " - block) (:init" + init + ") (:goal " + goal + "))",
      "p", domain);
}

std::string variables(const char* stem, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += std::string(i > 0 ? " ?" : "?") + stem + std::to_string(i);
  return text;
}

}  // namespace

TEST_CASE("a chain of six among twenty is joined link by link, not as 64 million formulas") {
  const Domain domain = domain_from_pddl(kBlocks, "d");
  const Problem problem = blocks_problem(domain, 20,
                                         "(exists (?a ?b ?c ?d ?e ?f - block) (and (on ?a ?b) (on ?b ?c) (on ?c ?d)"
                                         " (on ?d ?e) (on ?e ?f)))");
  PlanLimits limits;
  limits.memory_bytes = 200'000'000;
  const PlanOutcome outcome = solve(domain, problem, limits);
  INFO(outcome.explanation);
  REQUIRE(outcome.solved);
  CHECK(outcome.plan.size() == 5);
  CHECK(validate(domain, problem, outcome.plan).valid);
  CHECK_FALSE(validate(domain, problem, {}).valid);
}

TEST_CASE("a formula that would be written out millions of times is refused with its size and a cure") {
  const Domain domain = domain_from_pddl(kBlocks, "d");
  const Problem problem = blocks_problem(
      domain, 20, "(forall (" + variables("x", 6) + " - block) (or (on ?x0 ?x1) (on ?x2 ?x3) (on ?x4 ?x5)))");
  const PlanOutcome outcome = solve(domain, problem);
  CHECK(outcome.end == PlanEnd::memory_limit);
  CHECK_THAT(outcome.explanation, Catch::Contains("over 6 variables and 20 objects has more than 1000000 ground"));
  CHECK_THAT(outcome.explanation, Catch::Contains("narrow the types of the variables"));
}

TEST_CASE("too many ground actions are refused with their number and the action that makes most of them") {
  const Domain domain = domain_from_pddl(
      "(define (domain d) (:types block) (:predicates (on ?x ?y - block) (clear ?x "
      "- block) (down ?x - block)) (:action all :parameters (" +
          variables("x", 6) + " - block) :effect (on ?x0 ?x5)))",
      "d");
  PlanLimits limits;
  limits.memory_bytes = 100'000'000;
  // Of all blocks: so that a few of them do not do.
  const PlanOutcome outcome = solve(domain, blocks_problem(domain, 20, "(forall (?x - block) (on ?x b1))"), limits);
  CHECK(outcome.end == PlanEnd::memory_limit);
  CHECK_THAT(outcome.explanation,
             Catch::Contains("ground formulas") && Catch::Contains("of the action `all` over 6 variables"));
}

TEST_CASE("conditions of any number of positive literals with variables") {
  std::string literals;
  for (int i = 0; i < 100; ++i) literals += " (p" + std::to_string(i) + " ?x)";
  std::string declared, init;
  for (int i = 0; i < 100; ++i) {
    declared += " (p" + std::to_string(i) + " ?x)";
    if (i % 2 == 0) init += " (p" + std::to_string(i) + " a)";
    init += " (p" + std::to_string(i) + " b)";
  }
  const Domain domain = domain_from_pddl("(define (domain d) (:predicates (done ?x)" + declared +
                                             ") (:action go :parameters (?x) :precondition (and" + literals +
                                             ") :effect (and (done ?x) (not (p0 ?x)))))",
                                         "d");
  const auto outcome = [&](const std::string& goal) {
    return solve(domain, problem_from_pddl(
                             "(define (problem p) (:domain d) (:objects a b) (:init" + init + ") (:goal " + goal + "))",
                             "p", domain));
  };
  CHECK(outcome("(done b)").plan == Plan{{"go", {"b"}}});
  CHECK(outcome("(done a)").end == PlanEnd::unsolvable);
}
