#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "kitchen.h"

using namespace stampede;

namespace {

Formula random_formula(Random& random, const std::vector<std::string>& variables, int depth) {
  const auto term = [&]() -> Term {
    if (variables.empty()) return {false, "floor"};
    return {true, variables[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(variables.size())))]};
  };
  const auto some = [&] {
    std::vector<Formula> parts;
    for (int i = 0; i < 2; ++i) parts.push_back(random_formula(random, variables, depth - 1));
    return parts;
  };
  const std::int64_t kind = random.below(depth > 0 ? 8 : 3);
  if (kind <= 1) return atom("on", {term(), term()});
  if (kind == 2) {
    Formula equal;
    equal.kind = Formula::Kind::equal;
    equal.terms = {term(), term()};
    return equal;
  }
  if (kind == 3) return negation(random_formula(random, variables, depth - 1));
  if (kind == 4) return conjunction(some());
  if (kind == 5) return disjunction(some());
  Formula quantified;
  quantified.kind = kind == 6 ? Formula::Kind::exists : Formula::Kind::forall;
  const std::string name = "v" + std::to_string(variables.size());
  quantified.variables = {{name, random.below(2) == 0 ? "block" : "", {}}};
  if (random.below(2) == 0) quantified.variables[0].traits.push_back("movable");
  std::vector<std::string> inner = variables;
  inner.push_back(name);
  quantified.parts.push_back(random_formula(random, inner, depth - 1));
  return quantified;
}

Domain random_domain(Random& random) {
  Domain domain;
  domain.name = "random";
  domain.types = {{"block", "thing"}, {"thing", "object"}};
  domain.traits = {"movable", "surface"};
  domain.constants = {{"floor", "thing"}};
  domain.predicates = {{"high", {{"x", "", {"movable"}}}, PredicateKind::derived, {}, ""},
                       {"near", {{"x", "thing", {}}, {"y", "", {}}}, PredicateKind::fixed, {}, "{x} is near {y}"},
                       {"on", {{"x", "", {}}, {"y", "", {}}}, PredicateKind::basic, {}, ""}};
  domain.predicates[0].derived = random_formula(random, {"x"}, 3);
  for (const char* name : {"lift", "move", "push_far"}) {
    Action action;
    action.name = name;
    action.skill = std::string(name).substr(0, 4);
    if (random.below(2) == 0) action.case_name = "far";
    action.parameters = {{"a", "block", {}}, {"b", "", {"surface"}}};
    if (random.below(2) == 0) action.parameters[0].traits = {"movable", "surface"};
    action.distinct = random.below(2) == 0;
    if (random.below(3) == 0) action.may_equal = {{"a", "b"}};
    action.cost = static_cast<int>(1 + random.below(3));
    action.precondition = random.below(5) == 0 ? Formula{} : random_formula(random, {"a", "b"}, 3);
    Effect plain{{}, {}, "on", {{true, "a"}, {true, "b"}}, random.below(2) == 0};
    Effect rich{{{"z", "block", {"movable"}}},
                random_formula(random, {"a", "z"}, 2),
                "on",
                {{true, "z"}, {false, "floor"}},
                false};
    action.effects = {plain, rich};
    domain.actions.push_back(action);
  }
  return domain;
}

std::string complaint(const std::string& text) {
  try {
    domain_from_pddl(text, "d.pddl");
  } catch (const Error& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace

TEST_CASE("reading what was written gives the same domain, and writing that the same bytes") {
  for (int seed = 0; seed < 200; ++seed) {
    Random random(RandomKey("domains").with(seed));
    const Domain domain = random_domain(random);
    const std::string text = to_pddl(domain);
    INFO(text);
    const Domain again = domain_from_pddl(text, "random.pddl");
    CHECK(again == domain);
    CHECK(to_pddl(again) == text);
  }
}

TEST_CASE("problems and plans survive the round trip, parts with their dots") {
  const Domain domain = test::kitchen();
  const Problem problem = test::kitchen_problem(domain, "(exists (?x - cup) (inside ?x chest--drawer))");
  const std::string text = to_pddl(problem, domain);
  CHECK(text.find("chest--drawer") != std::string::npos);
  CHECK(text.find("chest.drawer") == std::string::npos);
  CHECK(problem_from_pddl(text, "again.pddl", domain) == problem);
  const Plan plan = {{"open", {"chest.drawer"}}};
  CHECK(plan_from_text(to_text(plan), "plan") == plan);
  CHECK(plan_from_text("0.000: (OPEN Chest--Drawer) [1]\n; cost = 1\n", "plan") == plan);
}

TEST_CASE("the requirements are exactly those used") {
  Domain domain;
  domain.name = "small";
  domain.predicates = {{"p", {}, PredicateKind::basic, {}, ""}, {"q", {}, PredicateKind::basic, {}, ""}};
  Action action;
  action.name = "go";
  action.precondition = atom("p", {});
  action.effects = {{{}, {}, "q", {}, false}};
  domain.actions = {action};
  const auto line = [&] {
    const std::string text = to_pddl(domain);
    const std::size_t begin = text.find("(:requirements");
    return text.substr(begin, text.find(')', begin) + 1 - begin);
  };
  CHECK(line() == "(:requirements :strips)");
  domain.actions[0].precondition = negation(atom("p", {}));
  CHECK(line() == "(:requirements :strips :negative-preconditions)");
  domain.actions[0].effects[0].when = atom("p", {});
  domain.actions[0].cost = 3;
  CHECK(line() == "(:requirements :strips :negative-preconditions :conditional-effects :action-costs)");
}

TEST_CASE("malformed PDDL: place, complaint and cure") {
  CHECK(complaint("(define (domain d)\n  (:predicates (p))") ==
        "d.pddl:1:1: this `(` is never closed\n    add the missing `)`");
  CHECK(complaint("(define (domain d)\n  (:predicates (on ?x - blok))\n  (:types block))") ==
        "d.pddl:2:25: unknown type `blok`\n    did you mean 'block'?");
  CHECK(
      complaint("(define (domain d) (:predicates (open ?x))\n (:action a :parameters (?x) :precondition (opne ?x)))") ==
      "d.pddl:2:45: unknown predicate `opne`\n    did you mean 'open'?");
  CHECK(
      complaint("(define (domain d) (:predicates (open ?x))\n (:action a :parameters (?x) :precondition (open ?y)))") ==
      "d.pddl:2:50: unknown variable `?y`\n    did you mean '?x'?");
  CHECK(complaint("(define (domain d) (:predicates (open ?x))\n (:action a :parameters (?x) :precondition (open)))") ==
        "d.pddl:2:44: `open` takes 1 arguments, got 0");
  CHECK(complaint("(define (domain d) (:types a - b b - a))") ==
        "d.pddl:1:20: type `a` descends from itself\n    give one type of the circle another parent");
  CHECK(complaint("(define (domain d) (:predicates (p ?x - (either a b))))") ==
        "d.pddl:1:41: `either` types are not supported\n    give the types a common parent, or use a static predicate");
  CHECK(complaint("(define (domain d) (:requirements :strips :fluents))").find("`:fluents` is not supported") !=
        std::string::npos);
  CHECK(complaint("") == "d.pddl:1:1: the text is empty\n    begin with (define");
}
