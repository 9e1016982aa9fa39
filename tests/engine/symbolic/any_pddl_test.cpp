#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "kitchen.h"

using namespace stampede;

namespace {

template <typename Read>
std::string complaint_of(Read&& read) {
  try {
    read();
  } catch (const Error& error) {
    return error.what();
  }
  return "no complaint";
}

std::string domain_complaint(const std::string& text) {
  return complaint_of([&] { domain_from_pddl("(define (domain d) " + text + ")", "d.pddl"); });
}

const char* const kRooms =
    "(:types room thing) (:constants hall - room) (:predicates (in ?t - thing ?r - room) (lit ?r - room) (busy))";

std::string problem_complaint(const std::string& text) {
  const Domain domain =
      domain_from_pddl(std::string("(define (domain d) ") + kRooms + " (:derived (busy) (lit hall)))", "d");
  return complaint_of([&] { problem_from_pddl("(define (problem p) (:domain d) " + text + ")", "p.pddl", domain); });
}

std::string nested(int depth) {
  std::string text;
  for (int i = 0; i < depth; ++i) text += "(not ";
  return text + "(p)" + std::string(static_cast<std::size_t>(depth), ')');
}

}  // namespace

TEST_CASE("PDDL of other authors: any order of sections, capitals, comments, missing fields, synonyms") {
  const Domain domain = domain_from_pddl(
      "; by others\n(DEFINE (DOMAIN Trip) (:action Go :parameters (?A ?b - Place) :precondition (At ?a) :effect (and "
      "(at ?B) (not (at ?a)))) (:action wait) (:requirements :adl :quantified-preconditions) (:predicates (at ?p - "
      "place)) (:types place))",
      "trip.pddl");
  REQUIRE(domain.actions.size() == 2);
  CHECK(domain.action("go")->parameters[1].name == "b");
  CHECK(domain.action("wait")->effects.empty());
  const std::string text = to_pddl(domain);
  CHECK(domain_from_pddl(text, "again") == domain);
  CHECK(text.find(":requirements :strips :typing)") != std::string::npos);  // not :adl: exactly those used
}

TEST_CASE("nested when and forall become one level, and a variable that hides another keeps its meaning") {
  const Domain domain = domain_from_pddl(
      "(define (domain d) (:predicates (p ?x) (q ?x) (r ?x)) (:action a :parameters (?x) :effect (when (p ?x) (forall "
      "(?x) (when (q ?x) (r ?x))))))",
      "d");
  REQUIRE(domain.actions[0].effects.size() == 1);
  const std::vector<TypedObject> objects = {{"a", "object"}, {"b", "object"}};
  const Fact seen{"r", {"b"}};
  CHECK(apply(domain.actions[0], {"a"}, {{"p", {"a"}}, {"q", {"b"}}}, domain, objects).contains(seen));
  CHECK_FALSE(apply(domain.actions[0], {"a"}, {{"p", {"b"}}, {"q", {"b"}}}, domain, objects).contains(seen));
}

TEST_CASE("what is quantified over too many objects is refused, in goals, conditions and effects alike") {
  std::string objects;
  for (int i = 0; i < 60; ++i) objects += " o" + std::to_string(i);
  const std::string five = "(forall (?a ?b ?c ?d ?e) ", two = "(forall (?a ?b ?c) ";
  const auto said = [&](const std::string& action, const std::string& goal, const std::string& derived = "") {
    const Domain domain = domain_from_pddl(
        "(define (domain d) (:requirements :adl :derived-predicates) (:predicates (p ?x) (q ?x ?y) (r))" + derived +
            "(:action a " + action + "))",
        "d");
    const Problem problem = problem_from_pddl(
        "(define (problem p) (:domain d) (:objects" + objects + ") (:init (p o1)) (:goal " + goal + "))", "p", domain);
    const PlanOutcome outcome = solve(domain, problem);
    CHECK_FALSE(outcome.solved);
    CHECK(outcome.end == PlanEnd::memory_limit);
    return outcome.explanation;
  };
  const std::string many = "more than 1000000 ground instances",
                    usual = ":parameters (?x) :precondition (p ?x) :effect (not (p ?x))";
  const std::string body = "(or (q ?a ?b) (q ?c ?d) (p ?e)))", goal = "(not (p o1))";
  CHECK_THAT(said(usual, five + body), Catch::Contains(many));
  CHECK_THAT(said(usual, "(r)", "(:derived (r) " + five + body + ")"), Catch::Contains(many));
  for (const std::string inside :
       {"(and (q ?a ?b) (q ?c ?d) (p ?e))", "(when (q ?a ?b) (and (q ?c ?d) (not (q ?e ?a))))",
        "(when (exists (?f) (q ?f ?e)) (q ?a ?b))"})
    CHECK_THAT(said(":parameters (?x) :precondition (p ?x) :effect " + five + inside + ")", goal),
               Catch::Contains(many));
  CHECK_THAT(said(":parameters (?x ?y ?z) :effect " + two + "(when (q ?a ?b) (q ?b ?c)))", goal),
             Catch::Contains("of the action `a` over 6 variables"));
}

TEST_CASE("domains that cannot be read say where and why") {
  CHECK(domain_complaint("(:requirements :stirps)").find("did you mean ':strips'?") != std::string::npos);
  CHECK(domain_complaint("(:action a :parameters (?x ?X))").find("`?x` is declared twice") != std::string::npos);
  CHECK(domain_complaint("(:constants Cup cup)").find("constant `cup` is declared twice") != std::string::npos);
  CHECK(domain_complaint("(:predicates (p)) (:action a) (:action A)").find("is defined twice") != std::string::npos);
  CHECK(domain_complaint("(:types a b) (:predicates (p ?x - a)) (:action go :parameters (?y - b) :precondition (p ?y))")
            .find("?y is a b, but ?x of `p` must be a a") != std::string::npos);
  CHECK(domain_complaint("(:predicates (p) (q)) (:derived (p) (q)) (:action a :effect (p))").find("is derived") !=
        std::string::npos);
  const std::string costs = "(:functions (total-cost) - number (far ?a)) (:action a :parameters (?x) :effect ";
  CHECK(domain_complaint(costs + "(and (increase (total-cost) 1) (increase (total-cost) 2)))")
            .find("a second (increase") != std::string::npos);
  CHECK(domain_complaint(costs + "(when (and) (increase (total-cost) -1)))").find("whole number, got `-1`") !=
        std::string::npos);
  CHECK(domain_complaint(costs + "(increase (total-cost) (near ?x)))").find("did you mean 'far'?") !=
        std::string::npos);
}

TEST_CASE("problems that cannot be read say where and why") {
  CHECK(problem_complaint("(:objects a - thing) (:init (in a hal)) (:goal (and))") ==
        "p.pddl:1:67: unknown object `hal`\n    did you mean 'hall'?");
  CHECK(problem_complaint("(:objects a - thing) (:init (in hall hall)) (:goal (and))")
            .find("hall is a room, but ?t of `in` must be a thing") != std::string::npos);
  CHECK(problem_complaint("(:objects a - thing A - thing) (:goal (and))").find("declared twice") != std::string::npos);
  CHECK(problem_complaint("(:init (busy)) (:goal (and))").find("is derived") != std::string::npos);
  CHECK(problem_complaint("(:init)").find("the problem has no goal") != std::string::npos);
  CHECK(problem_complaint("(:goal)").find("the goal is empty") != std::string::npos);
  CHECK(problem_complaint("(:goal ())").find("the goal is empty") != std::string::npos);
  CHECK(problem_complaint("(:goal (and)) (:metric maximize (total-cost))").find("only (:metric minimize") !=
        std::string::npos);
  CHECK(problem_complaint("(:goal (and) (and))").find("a goal is one formula\n    join the parts") !=
        std::string::npos);
  CHECK(problem_complaint("(:goal (and)) (:goal (and))").find("a second goal\n    join the two") != std::string::npos);
  CHECK(problem_complaint("(:goal (and))") == "no complaint");
  const Domain priced = domain_from_pddl("(define (domain d) (:functions (total-cost) - number (far)))", "d");
  const auto costly = [&](const std::string& init) {
    return problem_from_pddl("(define (problem p) (:domain d) (:init " + init + ") (:goal (and)))", "p.pddl", priced);
  };
  CHECK(costly("(= (far) 3) (= (far) 3)").values == std::map<Fact, int>{{{"far", {}}, 3}});
  CHECK_THROWS_WITH(costly("(= (far) 3) (= (far) 4)"), Catch::Contains("p.pddl:1:52: a second value of (far)"));
  CHECK_THROWS_WITH(problem_from_pddl("(define)", "p", priced), Catch::Contains("expected (define (problem NAME)"));
}

TEST_CASE("plans that cannot be read say where and why") {
  CHECK(plan_from_text("; first\n0.0: (pick cup table) ; then\n\n(wait)", "p") ==
        Plan{{"pick", {"cup", "table"}}, {"wait", {}}});
  CHECK_THROWS_WITH(plan_from_text("(wait)\n(pick cup", "p"), Catch::Contains("p:2:1: expected one (action argument"));
  CHECK_THROWS_WITH(plan_from_text("pick cup)", "p"), Catch::Contains("p:1:1: expected one (action argument"));
  CHECK_THROWS_WITH(plan_from_text("now (wait)", "p"), Catch::Contains("only a time may stand before a step"));
}

TEST_CASE("deep nesting is read up to a limit and refused beyond it, never a crash") {
  const auto goal = [&](int depth) {
    return "(:predicates (p)) (:action a :precondition " + nested(depth) + " :effect (p))";
  };
  CHECK(domain_complaint(goal(400)) == "no complaint");
  CHECK(domain_complaint(goal(1000)).find("nested deeper than 500") != std::string::npos);
  CHECK(domain_complaint(goal(1'000'000)).find("nested deeper than 500") != std::string::npos);
  const Domain domain = domain_from_pddl("(define (domain d) " + goal(400) + ")", "d");
  CHECK(domain_from_pddl(to_pddl(domain), "again") == domain);
  const Problem problem = problem_from_pddl("(define (problem p) (:domain d) (:goal (p)))", "p", domain);
  CHECK(solve(domain, problem).end == PlanEnd::unsolvable);  // an even number of negations: (p) is needed for (p)
}

TEST_CASE("what Fast Downward or VAL reject is not written") {
  Domain domain;
  domain.name = "d";
  domain.predicates = {{"p", {}, PredicateKind::basic, {}, ""}};
  Action action;
  action.name = "a";
  action.precondition = disjunction({atom("p", {}), conjunction({atom("p", {}), Formula{}})});
  action.effects = {{{}, disjunction({}), "p", {}, false}};
  domain.actions = {action};
  const std::string text = to_pddl(domain);
  CHECK(text.find("(and)") == std::string::npos);  // VAL takes none inside a formula
  CHECK(text.find("(or)") == std::string::npos);
  CHECK(domain_from_pddl(text, "again") == domain);
  domain.actions[0].name = "when";
  CHECK_THROWS_WITH(to_pddl(domain), Catch::Contains("PDDL keeps for itself"));
  domain.actions[0].name = "2nd";
  CHECK_THROWS_WITH(to_pddl(domain), Catch::Contains("is not a name in PDDL"));
  domain.actions = {action, action};
  domain.actions[1].name = "A";
  CHECK_THROWS_WITH(to_pddl(domain), Catch::Contains("capital letters"));
}

TEST_CASE("a goal with a further test says so, on one line before the goal") {
  const Domain domain = test::kitchen();
  const Problem problem = test::kitchen_problem(domain, "(holding cup1)");
  const std::string text = to_pddl(problem, domain, "the cup\nis upright");
  CHECK(text.find("  ; not complete: the cup is upright\n  (:goal (holding cup1))") != std::string::npos);
  CHECK(problem_from_pddl(text, "again", domain) == problem);
}

TEST_CASE("a domain named by its content: equal domains, equal bytes") {
  Domain domain = test::kitchen();
  const Domain named = named_by_content(domain);
  domain.name = "another";
  CHECK(to_pddl(named_by_content(domain)) == to_pddl(named));
  CHECK(named.name.size() == std::string("stampede-").size() + 16);
  domain.actions[0].cost = 7;
  CHECK(named_by_content(domain).name != named.name);
  CHECK(domain_from_pddl(to_pddl(named), "again") == named);
}

TEST_CASE("a task-sized domain has what the task needs and gives the same plan") {
  Domain domain = test::kitchen();
  domain.types["brush"] = "thing";
  domain.predicates.push_back({"painted", {{"b", "brush", {}}}, PredicateKind::basic, {}, ""});
  Action paint;
  paint.name = "paint";
  paint.parameters = {{"b", "brush", {}}};
  paint.effects = {{{}, {}, "painted", {{true, "b"}}, false}};
  domain.actions.push_back(paint);  // there is no brush, and no one asks for paint
  const Problem problem = test::kitchen_problem(domain, "(open chest--drawer)");
  const Domain small = task_sized(domain, problem);
  CHECK(small.action("open") != nullptr);
  CHECK(small.action("paint") == nullptr);
  CHECK(small.predicate("painted") == nullptr);
  CHECK_FALSE(small.types.contains("brush"));
  CHECK(small.types.contains("cup"));
  CHECK(small.types.contains("drawer"));  // which `clear` and the actions quantify over
  CHECK(solve(small, restricted(problem, small)).plan == solve(domain, problem).plan);
  const std::string text = to_pddl(restricted(problem, small), small);
  CHECK(problem_from_pddl(text, "again", domain_from_pddl(to_pddl(small), "small")) == restricted(problem, small));
}
