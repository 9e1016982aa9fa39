#include <catch2/catch.hpp>

#include "kitchen.h"

using namespace stampede;

namespace {

std::string why_not(const Domain& domain, const std::string& goal, const std::set<PlanStep>& forbidden = {}) {
  const PlanOutcome outcome = solve(domain, test::kitchen_problem(domain, goal), {}, forbidden);
  CHECK_FALSE(outcome.solved);
  return outcome.explanation;
}

}  // namespace

TEST_CASE("no plan: the goal literal and the missing action or fact are named") {
  Domain domain = test::kitchen();
  std::erase_if(domain.actions, [](const Action& action) { return action.name == "put_in"; });
  CHECK(why_not(domain, "(inside cup1 chest--drawer)") ==
        "(inside cup1 chest.drawer) cannot become true: no action adds `inside`");
  domain = test::kitchen();
  std::erase_if(domain.actions, [](const Action& action) { return action.name == "open"; });
  CHECK(why_not(domain, "(inside cup1 chest--drawer)") ==
        "(inside cup1 chest.drawer) cannot become true: `put_in` needs (open chest.drawer), which is not a fact and "
        "which no action adds");
}

TEST_CASE("no plan: chains are followed to their end") {
  Domain domain = test::kitchen();
  for (Action& action : domain.actions) {
    if (action.name == "open") action.precondition = formula_from_pddl("(open ?d)", "test");
  }
  CHECK(why_not(domain, "(inside cup1 chest--drawer)") ==
        "(inside cup1 chest.drawer) cannot become true: `put_in` needs (open chest.drawer), which nothing achieves "
        "because `open` needs (open chest.drawer), which nothing achieves");
}

TEST_CASE("no plan: long chains are told five links deep") {
  std::string actions, predicates, expected = "(p0) cannot become true: ";
  for (int i = 0; i < 9; ++i) {
    const std::string has = std::to_string(i), wants = std::to_string(i + 1);
    predicates += "(p" + has + ")";
    if (i < 8) actions += "(:action a" + has + " :precondition (p" + wants + ") :effect (p" + has + "))";
    if (i < 5) expected += "`a" + has + "` needs (p" + wants + "), which nothing achieves" + (i < 4 ? " because " : "");
  }
  const Domain domain = domain_from_pddl("(define (domain d) (:predicates " + predicates + ")" + actions + ")", "d");
  const Problem problem = problem_from_pddl("(define (problem p) (:domain d) (:goal (p0)))", "p", domain);
  CHECK(solve(domain, problem).explanation == expected);
}

TEST_CASE("no plan: objects of the wrong kind, and goals that exclude each other") {
  const Domain domain = test::kitchen();
  CHECK(why_not(domain, "(holding table)") ==
        "(holding table) cannot become true: the actions that add `holding` do not accept these objects");
  CHECK(why_not(domain, "(and (holding cup1) (holding cup2))").find("exclude each other") != std::string::npos);
  CHECK(why_not(domain, "(not (movable cup1))") ==
        "(not (movable cup1)) cannot become true: it holds from the start and no possible action removes "
        "`movable`");
}

TEST_CASE("a spent budget is said to be one") {
  const Domain domain = test::kitchen();
  PlanLimits limits;
  limits.expansions = 1;
  const PlanOutcome outcome =
      solve(domain, test::kitchen_problem(domain, "(forall (?x - cup) (inside ?x chest--drawer))"), limits);
  CHECK_FALSE(outcome.solved);
  CHECK(outcome.explanation.starts_with("no plan within the limit of 1 expansions"));
}
