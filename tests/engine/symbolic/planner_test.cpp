#include <catch2/catch.hpp>

#include "engine/base/random.h"
#include "kitchen.h"

using namespace stampede;

namespace {

// Plans, and has the plain semantics of `validate` check the result: the two share no code for states.
PlanOutcome planned(const Domain& domain, const Problem& problem, const std::set<PlanStep>& forbidden = {}) {
  const PlanOutcome outcome = solve(domain, problem, {}, forbidden);
  INFO(outcome.explanation);
  REQUIRE(outcome.solved);
  const Validation verdict = validate(domain, problem, outcome.plan);
  INFO(verdict.explanation);
  CHECK(verdict.valid);
  return outcome;
}

}  // namespace

TEST_CASE("the drawer is opened before the cup is in the hand") {
  const Domain domain = test::kitchen();
  const PlanOutcome outcome = planned(domain, test::kitchen_problem(domain, "(inside cup1 chest--drawer)"));
  CHECK(to_text(outcome.plan) == "(open chest.drawer)\n(pick cup1 cup2)\n(put_in cup1 chest.drawer)\n");
}

TEST_CASE("quantified, disjunctive and negated goals are planned for") {
  const Domain domain = test::kitchen();
  const auto steps = [&](const char* goal) { return planned(domain, test::kitchen_problem(domain, goal)).plan.size(); };
  CHECK(steps("(forall (?x - cup) (inside ?x chest--drawer))") == 5);
  CHECK(steps("(or (holding cup2) (open chest--drawer))") == 1);  // the cheaper half
  CHECK(steps("(exists (?x - cup) (holding ?x))") == 1);
  CHECK(steps("(not (on cup1 cup2))") == 1);
  CHECK(steps("(clear cup2)") == 1);
  CHECK(steps("(not (clear cup1))") == 4);  // cup2 must go on top of cup1, which must be put down first
  CHECK(steps("(on cup1 cup2)") == 0);
  CHECK(steps("(imply (closed chest--drawer) (holding cup1))") == 1);
}

TEST_CASE("a part that is needed in order is a fluent that conditional effects advance") {
  const Domain domain = domain_from_pddl(
      "(define (domain buttons) (:types button) (:predicates (stage0) (stage1) (stage2) (first ?b - button) "
      "(second ?b - button) (wrong)) (:action press :parameters (?b - button) :precondition (not (wrong)) :effect (and "
      "(when (and (stage0) (first ?b)) (and (stage1) (not (stage0)))) (when (and (stage1) (second ?b)) (and (stage2) "
      "(not (stage1)))) (when (and (stage0) (second ?b)) (wrong)))))",
      "buttons.pddl");
  const Problem problem = problem_from_pddl(
      "(define (problem two) (:domain buttons) (:objects a b - button) (:init (stage0) (first b) (second a)) "
      "(:goal (and (stage2) (not (wrong)))))",
      "two.pddl", domain);
  CHECK(to_text(planned(domain, problem).plan) == "(press b)\n(press a)\n");
}

TEST_CASE("forbidden ground actions are not used") {
  const Domain domain = test::kitchen();
  const Problem problem = test::kitchen_problem(domain, "(not (on cup1 cup2))");
  CHECK(planned(domain, problem).plan == Plan{{"pick", {"cup1", "cup2"}}});
  const PlanOutcome outcome = solve(domain, problem, {}, {{"pick", {"cup1", "cup2"}}});
  CHECK_FALSE(outcome.solved);
}

TEST_CASE("shortening carries two balls at a time") {
  const Domain domain = domain_from_pddl(
      "(define (domain carry) (:types room ball hand) (:predicates (here ?r - room) (at ?b - ball ?r - room) (free ?h "
      "- "
      "hand) (carry ?b - ball ?h - hand)) (:action move :parameters (?a ?b - room) :precondition (here ?a) :effect "
      "(and "
      "(here ?b) (not (here ?a)))) (:action take :parameters (?b - ball ?r - room ?h - hand) :precondition (and (at ?b "
      "?r) (here ?r) (free ?h)) :effect (and (carry ?b ?h) (not (at ?b ?r)) (not (free ?h)))) (:action drop "
      ":parameters "
      "(?b - ball ?r - room ?h - hand) :precondition (and (carry ?b ?h) (here ?r)) :effect (and (at ?b ?r) (free ?h) "
      "(not (carry ?b ?h)))))",
      "carry.pddl");
  const Problem problem = problem_from_pddl(
      "(define (problem four) (:domain carry) (:objects r s - room l m - hand a b c d - ball) (:init (here r) (free l) "
      "(free m) (at a r) (at b r) (at c r) (at d r)) (:goal (and (at a s) (at b s) (at c s) (at d s))))",
      "four.pddl", domain);
  PlanLimits none;
  none.improve = 0;
  const std::size_t shortened = planned(domain, problem).plan.size();
  CHECK(shortened == 11);  // two trips of four hand moves, and three moves between the rooms
  CHECK(shortened <= solve(domain, problem, none).plan.size());
}

TEST_CASE("the same problem gives the same plan, expansions and all") {
  const Domain domain = test::kitchen();
  const Problem problem = test::kitchen_problem(domain, "(forall (?x - cup) (inside ?x chest--drawer))");
  const PlanOutcome first = solve(domain, problem), second = solve(domain, problem);
  CHECK(first.plan == second.plan);
  CHECK(first.expanded == second.expanded);
}

TEST_CASE("random towers of blocks are rebuilt, and every plan validates") {
  const Domain domain = domain_from_pddl(
      "(define (domain blocks) (:types block) (:predicates (on ?x ?y - block) (ontable ?x - block) (holding ?x - "
      "block) (clear ?x - block) (handempty)) (:derived (clear ?x - block) (and (not (holding ?x)) (forall (?y - "
      "block) "
      "(not (on ?y ?x))))) (:derived (handempty) (not (exists (?x - block) (holding ?x)))) (:action take :parameters "
      "(?x - block) :precondition (and (clear ?x) (ontable ?x) (handempty)) :effect (and (holding ?x) (not (ontable "
      "?x)))) (:action drop :parameters (?x - block) :precondition (holding ?x) :effect (and (ontable ?x) (not "
      "(holding "
      "?x)))) (:action stack :parameters (?x ?y - block) :precondition (and (not (= ?x ?y)) (holding ?x) (clear ?y)) "
      ":effect (and (on ?x ?y) (not (holding ?x)))) (:action unstack :parameters (?x ?y - block) :precondition (and "
      "(on "
      "?x ?y) (clear ?x) (handempty)) :effect (and (holding ?x) (not (on ?x ?y)))))",
      "blocks.pddl");
  for (int seed = 0; seed < 20; ++seed) {
    Random random(RandomKey("blocks").with(seed));
    const auto towers = [&](Facts& facts, std::vector<Formula>* goal) {
      std::vector<std::string> names = {"a", "b", "c", "d", "e", "f"};
      std::string below;
      while (!names.empty()) {
        const auto at = names.begin() + random.below(static_cast<std::int64_t>(names.size()));
        const std::string name = *at;
        names.erase(at);
        const bool on_table = below.empty() || random.below(3) == 0;
        facts.insert(on_table ? Fact{"ontable", {name}} : Fact{"on", {name, below}});
        if (goal != nullptr && !on_table) goal->push_back(atom("on", {{false, name}, {false, below}}));
        below = name;
      }
    };
    Problem problem;
    for (const char* name : {"a", "b", "c", "d", "e", "f"}) problem.objects.push_back({name, "block"});
    Facts wanted;
    std::vector<Formula> goal;
    towers(problem.init, nullptr);
    towers(wanted, &goal);
    problem.goal = conjunction(goal);
    CHECK(planned(domain, problem).plan.size() <= 4 * 6);  // unstack and stack each block at most twice
  }
}

TEST_CASE("validate names the first step and precondition that fail, or the goal") {
  const Domain domain = test::kitchen();
  const Problem problem = test::kitchen_problem(domain, "(inside cup1 chest--drawer)");
  const auto verdict = [&](const char* text) { return validate(domain, problem, plan_from_text(text, "plan")); };
  Validation bad = verdict("(pick cup1 cup2)\n(put_in cup1 chest--drawer)\n");
  CHECK_FALSE(bad.valid);
  CHECK(bad.failed_step == 1);
  CHECK(bad.explanation == "step 2 (put_in cup1 chest.drawer): needs (open chest.drawer)");
  bad = verdict("(open chest--drawer)");
  CHECK(bad.failed_step == -1);
  CHECK(bad.explanation == "the plan ends without (inside cup1 chest.drawer)");
  CHECK(verdict("(pik cup1 cup2)").explanation == "step 1 (pik cup1 cup2): unknown action; did you mean 'pick'?");
  CHECK(verdict("(open cup1)").explanation == "step 1 (open cup1): cup1 is a cup, but ?d must be a drawer");
  CHECK(verdict("(pick table cup1)").explanation == "step 1 (pick table cup1): table is not movable, which ?o must be");
}
