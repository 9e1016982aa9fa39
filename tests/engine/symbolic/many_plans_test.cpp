#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "engine/base/error.h"
#include "engine/symbolic/drawn_choice.h"
#include "engine/symbolic/external_planner.h"
#include "kitchen.h"

using namespace stampede;

namespace {

// Two roads from a to c: straight, dear; by way of b, cheap.
const char* const kRoads =
    "(define (domain roads) (:types place) (:predicates (at ?p - place) (road ?a ?b - place)) (:functions (total-cost) "
    "- "
    "number (length ?a ?b - place) - number) (:action go :parameters (?a ?b - place) :precondition (and (at ?a) (road "
    "?a ?b)) :effect (and (at ?b) (not (at ?a)) (increase (total-cost) (length ?a ?b)))))";

std::string trip(const std::string& straight) {
  return "(define (problem trip) (:domain roads) (:objects a b c - place) (:init (at a) (road a b) (road b c) (road a "
         "c) "
         "(= (total-cost) 0) (= (length a b) 2) (= (length b c) 3) " +
         straight + ") (:goal (at c)) (:metric minimize (total-cost)))";
}

std::set<PlanStep> steps(const Plan& plan) { return {plan.begin(), plan.end()}; }

}  // namespace

TEST_CASE("costs by functions: the cheap way round is taken, an undefined cost is no way, and both are validated") {
  const Domain domain = domain_from_pddl(kRoads, "roads");
  const auto plan_of = [&](const std::string& straight) {
    const Problem problem = problem_from_pddl(trip(straight), "trip", domain);
    CHECK(problem_from_pddl(to_pddl(problem, domain), "again", domain) == problem);
    const PlanOutcome outcome = solve(domain, problem);
    CHECK(validate(domain, problem, outcome.plan).valid);
    CHECK(plan_cost(domain, problem, outcome.plan) == outcome.cost);
    return outcome;
  };
  CHECK(plan_of("(= (length a c) 9)").cost == 5);
  CHECK(plan_of("(= (length a c) 4)").cost == 4);
  CHECK(plan_of("").plan.size() == 2);
  const Problem without = problem_from_pddl(trip(""), "trip", domain);
  CHECK(validate(domain, without, {{"go", {"a", "c"}}}).explanation ==
        "step 1 (go a c): its cost (length a c) has no value");
  CHECK(domain_from_pddl(to_pddl(domain), "again") == domain);
}

TEST_CASE("several plans: no two of the same steps, all valid, the first the usual one, no more than there are") {
  const Domain domain = domain_from_pddl(
      "(define (domain doors) (:predicates (at ?a) (door ?a ?b)) (:action go :parameters (?a ?b) :precondition (and "
      "(at "
      "?a) (door ?a ?b)) :effect (and (at ?b) (not (at ?a)))))",
      "doors");
  const Problem problem = problem_from_pddl(  // four ways from a to z, one of them straight
      "(define (problem p) (:domain doors) (:objects a b c d z) (:init (at a) (door a z) (door a b) (door b z) (door a "
      "c) "
      "(door c z) (door c d) (door d z)) (:goal (at z)))",
      "p", domain);
  const std::vector<Plan> plans = solve_many(domain, problem, 4);
  REQUIRE(plans.size() == 4);
  CHECK(plans.front() == Plan{{"go", {"a", "z"}}});
  CHECK(solve_many(domain, problem, 9).size() == 4);
  CHECK(solve_many(domain, problem, 2).size() == 2);
  std::set<std::set<PlanStep>> distinct;
  for (const Plan& plan : plans) {
    CHECK(validate(domain, problem, plan).valid);
    distinct.insert(steps(plan));
  }
  CHECK(distinct.size() == 4);
  CHECK(solve_many(domain, problem, 4) == plans);
  const Domain roads = domain_from_pddl(kRoads, "roads");
  CHECK(solve_many(roads, problem_from_pddl(trip("(= (length a c) 9)"), "trip", roads), 10).size() == 2);
}

TEST_CASE("how a search ended: solved, proved unsolvable, given up at either limit") {
  const Domain domain = test::kitchen();
  const auto end = [&](const char* goal, const PlanLimits& limits = {}) {
    const PlanOutcome outcome = solve(domain, test::kitchen_problem(domain, goal), limits);
    CHECK(outcome.solved == (outcome.end == PlanEnd::solved));
    CHECK(outcome.explanation.empty() == outcome.solved);
    return outcome.end;
  };
  CHECK(end("(holding cup1)") == PlanEnd::solved);
  CHECK(end("(on cup1 cup2)") == PlanEnd::solved);  // already true: the empty plan
  CHECK(end("(and)") == PlanEnd::solved);
  CHECK(end("(holding table)") == PlanEnd::unsolvable);
  CHECK(end("(and (holding cup1) (holding cup2))") == PlanEnd::unsolvable);
  PlanLimits few, small;
  few.expansions = 1;
  small.memory_bytes = 100;
  CHECK(end("(inside cup1 chest--drawer)", few) == PlanEnd::expansion_limit);
  CHECK(end("(inside cup1 chest--drawer)", small) == PlanEnd::memory_limit);
  CHECK(to_text(PlanEnd::unsolvable) == "unsolvable (proved)");
}

TEST_CASE("useless steps go, with conditional effects and axioms too") {
  const Domain domain = domain_from_pddl(
      "(define (domain lamps) (:types lamp) (:predicates (lit ?l - lamp) (bright) (seen)) (:derived (bright) (forall "
      "(?l "
      "- lamp) (lit ?l))) (:action press :parameters (?l - lamp) :effect (and (when (not (lit ?l)) (lit ?l)) (when "
      "(lit "
      "?l) (not (lit ?l))))) (:action look :precondition (bright) :effect (seen)))",
      "lamps");
  const Problem problem = problem_from_pddl(
      "(define (problem p) (:domain lamps) (:objects a b c d - lamp) (:init (lit a)) (:goal (seen)))", "p", domain);
  const PlanOutcome outcome = solve(domain, problem);
  CHECK(validate(domain, problem, outcome.plan).valid);
  CHECK(outcome.plan.size() == 4);  // three lamps to press, one look
}

TEST_CASE("another planner's program: its plan is read and checked, its failures are told") {
  const Domain domain = test::kitchen();
  const Problem problem = test::kitchen_problem(domain, "(open chest--drawer)");
  const auto answer = [&](const std::string& command) { return solve_externally(command, domain, problem); };
  const PlanOutcome good = answer(
      "grep -q '(:goal' {problem} && grep -q '(:action' {domain} && printf '0.0: (OPEN chest--drawer)\\n; cost = 1\\n' "
      "> {plan}");
  CHECK(good.solved);
  CHECK(good.plan == Plan{{"open", {"chest.drawer"}}});
  CHECK(answer("printf '(open x)' > {plan}; printf '(open chest--drawer)' > {plan}.1 # {domain} {problem}").solved);
  const PlanOutcome none = answer("echo 'no solution' # {domain} {problem} {plan}\nexit 11");
  CHECK(none.end == PlanEnd::unsolvable);
  const PlanOutcome own = answer("cat {domain} {problem} > /dev/null; echo lost > {plan}.log; exit 1");
  CHECK(own.end == PlanEnd::no_answer);
  CHECK(to_text(own.end) == "the planner ended without an answer");
  CHECK(own.explanation.find("ended with code 1 and wrote no plan") != std::string::npos);
  CHECK(none.explanation.find("ended with code 11 and wrote no plan:\nno solution") != std::string::npos);
  CHECK_THROWS_WITH(answer("planner {domain} {problem}"), Catch::Contains("the command has no {plan}"));
  CHECK_THROWS_WITH(answer("/nowhere/planner {domain} {problem} {plan}"), Catch::Contains("could not be started"));
  CHECK_THROWS_WITH(answer("echo '(open cup1)' > {plan} # {domain} {problem}"), Catch::Contains("must be a drawer"));
  CHECK_THROWS_WITH(answer("echo 'nonsense' > {plan} # {domain} {problem}"), Catch::Contains("expected one (action"));
}

TEST_CASE("of equal things a plan takes any, in any order, and is as long as before") {
  const Domain domain = domain_from_pddl(
      "(define (domain trays) (:types block) (:predicates (loose ?b - block) (stored ?b - block) (red ?b - block)) "
      "(:action store :parameters (?b - block) :precondition (loose ?b) :effect (and (stored ?b) (not (loose ?b)))))",
      "trays.pddl");
  const Problem problem = problem_from_pddl(
      "(define (problem two) (:domain trays) (:objects a b c d e - block) (:init (loose a) (loose b) (loose c) "
      "(loose d) (loose e) (red e)) (:goal (exists (?x ?y - block) (and (not (= ?x ?y)) (stored ?x) (stored ?y) "
      "(not (red ?x)) (not (red ?y))))))",
      "two.pddl", domain);
  std::set<std::string> plans, first;
  for (int seed = 0; seed < 40; ++seed) {
    const RandomKey key = RandomKey("plan").with(seed);
    const PlanOutcome outcome = solve_drawn(domain, problem, {}, key);
    REQUIRE(outcome.solved);
    CHECK(outcome.plan.size() == 2);
    CHECK(validate(domain, problem, outcome.plan).valid);
    CHECK(solve_drawn(domain, problem, {}, key).plan == outcome.plan);
    plans.insert(to_text(outcome.plan));
    first.insert(outcome.plan.front().arguments[0]);
  }
  CHECK(first == std::set<std::string>{"a", "b", "c", "d"});
  CHECK(plans.size() > 6);
  CHECK_FALSE(
      solve_drawn(domain, problem, {{"store", {"a"}}, {"store", {"b"}}, {"store", {"c"}}}, RandomKey("x")).solved);
}
