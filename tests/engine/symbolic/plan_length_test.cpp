// Lengths of plans where the shortest is known by counting.
#include <catch2/catch.hpp>

#include "engine/symbolic/pddl.h"
#include "engine/symbolic/search.h"

using namespace stampede;

namespace {

Domain blocks() {
  return domain_from_pddl(
      "(define (domain blocks) (:types block) (:predicates (on ?x ?y - block) (ontable ?x - block) (clear ?x - block) "
      "(handempty) (holding ?x - block))"
      "(:action pick-up :parameters (?x - block) :precondition (and (clear ?x) (ontable ?x) (handempty))"
      "  :effect (and (not (ontable ?x)) (not (clear ?x)) (not (handempty)) (holding ?x)))"
      "(:action put-down :parameters (?x - block) :precondition (holding ?x)"
      "  :effect (and (not (holding ?x)) (clear ?x) (handempty) (ontable ?x)))"
      "(:action stack :parameters (?x ?y - block) :precondition (and (holding ?x) (clear ?y))"
      "  :effect (and (not (holding ?x)) (not (clear ?y)) (clear ?x) (handempty) (on ?x ?y)))"
      "(:action unstack :parameters (?x ?y - block) :precondition (and (on ?x ?y) (clear ?x) (handempty))"
      "  :effect (and (holding ?x) (clear ?y) (not (clear ?x)) (not (handempty)) (not (on ?x ?y)))))",
      "blocks.pddl");
}

using Tower = std::vector<std::string>;  // from the bottom

Problem rebuild(const Domain& domain, const std::vector<Tower>& from, const std::vector<Tower>& to) {
  std::string names, init = "(handempty)", goal;
  for (const Tower& tower : from) {
    for (std::size_t i = 0; i < tower.size(); ++i) {
      names += tower[i] + " ";
      init += i == 0 ? " (ontable " + tower[i] + ")" : " (on " + tower[i] + " " + tower[i - 1] + ")";
    }
    init += " (clear " + tower.back() + ")";
  }
  for (const Tower& tower : to) {
    for (std::size_t i = 1; i < tower.size(); ++i) goal += " (on " + tower[i] + " " + tower[i - 1] + ")";
  }
  return problem_from_pddl("(define (problem p) (:domain blocks) (:objects " + names + "- block) (:init " + init +
                               ") (:goal (and" + goal + ")))",
                           "p.pddl", domain);
}

Tower tower(int count) {
  Tower names;
  for (int i = 0; i < count; ++i) names.push_back("b" + std::to_string(i));
  return names;
}

std::size_t steps(const Domain& domain, const Problem& problem) {
  const PlanOutcome outcome = solve(domain, problem);
  REQUIRE(outcome.solved);
  const Validation validation = validate(domain, problem, outcome.plan);
  INFO(validation.explanation);
  CHECK(validation.valid);
  return outcome.plan.size();
}

}  // namespace

TEST_CASE("a tower is turned over with each block moved once") {
  const Domain domain = blocks();
  for (const int count : {3, 8, 20}) {
    const Tower up = tower(count);
    CHECK(steps(domain, rebuild(domain, {up}, {Tower(up.rbegin(), up.rend())})) == 2 * up.size());
  }
}

TEST_CASE("a tower whose bottom must move is taken apart and built again, and no block is moved a third time") {
  const Domain domain = blocks();
  for (const int count : {2, 5, 9, 15}) {  // all but the bottom block hold their goals too early: two moves each
    Tower onto = tower(count);
    onto.insert(onto.begin(), "base");
    CHECK(steps(domain, rebuild(domain, {tower(count), {"base"}}, {onto})) == 2 * (2 * (onto.size() - 2) + 1));
  }
}

TEST_CASE("what is set aside early and fetched late is moved once") {
  const Domain domain = blocks();
  std::vector<Tower> from = {{"y", "x"}, {"z"}}, to = {{"z", "x"}};
  Plan wasteful = {{"unstack", {"x", "y"}}, {"put-down", {"x"}}};
  for (int i = 0; i < 15; ++i) {  // more steps between than any stretch that is planned anew
    const std::string n = std::to_string(i), u = "u" + n, v = "v" + n, w = "w" + n;
    from.insert(from.end(), {{v, u}, {w}});
    to.push_back({w, u});
    wasteful.insert(wasteful.end(), {{"unstack", {u, v}}, {"stack", {u, w}}});
  }
  wasteful.insert(wasteful.end(), {{"pick-up", {"x"}}, {"stack", {"x", "z"}}});
  const Problem problem = rebuild(domain, from, to);
  REQUIRE(validate(domain, problem, wasteful).valid);

  const symbolic::GroundTask task = symbolic::ground(symbolic::lift(domain, problem), {});
  const symbolic::Semantics semantics(task);
  symbolic::Heuristic heuristic(task);
  std::vector<int> plan;
  for (const PlanStep& step : wasteful) {
    int op = 0;
    while (task.step(op) != step) ++op;
    plan.push_back(op);
  }
  Plan shortened;
  for (const int op : shorten(task, semantics, heuristic, plan, 20'000)) shortened.push_back(task.step(op));
  CHECK(validate(domain, problem, shortened).valid);
  CHECK(shortened.size() == 32);  // sixteen blocks, one move each
  CHECK(shorten(task, semantics, heuristic, plan, 0) == plan);
}
