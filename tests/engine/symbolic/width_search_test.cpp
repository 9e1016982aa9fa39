// Best-first width search by itself: `solve` turns to it only when the greedy search has found nothing for long.
#include <catch2/catch.hpp>

#include "engine/symbolic/ground.h"
#include "engine/symbolic/pddl.h"
#include "engine/symbolic/search.h"

using namespace stampede;

namespace {

const char* const kTiles =
    "(define (domain tiles) (:types tile cell)"
    " (:predicates (at ?t - tile ?c - cell) (empty ?c - cell) (next ?a ?b - cell))"
    " (:action slide :parameters (?t - tile ?from ?to - cell)"
    " :precondition (and (at ?t ?from) (empty ?to) (next ?from ?to))"
    " :effect (and (at ?t ?to) (empty ?from) (not (at ?t ?from)) (not (empty ?to)))))";

// Eight tiles in three rows; `start[i]` is the tile in cell i, 0: none. The goal: tile i in cell i.
Problem puzzle(const Domain& domain, const std::string& start) {
  std::string objects = "t1 t2 t3 t4 t5 t6 t7 t8 - tile", init, goal;
  for (int cell = 0; cell < 9; ++cell) {
    const auto named = [](int number) { return " c" + std::to_string(number); };
    const auto next = [&](int other) { init += "(next" + named(cell) + named(other) + ")"; };
    objects += named(cell);
    const char tile = start[static_cast<std::size_t>(cell)];
    init += tile == '0' ? "(empty" + named(cell) + ")" : std::string("(at t") + tile + named(cell) + ")";
    if (cell > 0) goal += "(at t" + std::to_string(cell) + named(cell) + ")";
    if (cell % 3 > 0) next(cell - 1);
    if (cell % 3 < 2) next(cell + 1);
    if (cell > 2) next(cell - 3);
    if (cell < 6) next(cell + 3);
  }
  return problem_from_pddl("(define (problem p) (:domain tiles) (:objects " + objects + " - cell) (:init " + init +
                               ") (:goal (and " + goal + ")))",
                           "p", domain);
}

struct Outcome {
  symbolic::SearchResult result;
  Plan plan;
};

Outcome searched(const Domain& domain, const Problem& problem, const PlanLimits& limits = {}) {
  const symbolic::GroundTask task = symbolic::ground(symbolic::lift(domain, problem), {});
  const symbolic::Semantics semantics(task);
  symbolic::Heuristic heuristic(task);
  Outcome outcome{width_search(task, semantics, heuristic, limits, {semantics.initial(), task.goal}), {}};
  for (const int op : outcome.result.plan) outcome.plan.push_back(task.step(op));
  return outcome;
}

}  // namespace

TEST_CASE("width search slides eight tiles into place, and sees a small part of all states") {
  const Domain domain = domain_from_pddl(kTiles, "tiles");
  for (const std::string start : {"123450678", "724506831", "876543021"}) {
    const Problem problem = puzzle(domain, start);
    const Outcome outcome = searched(domain, problem);
    INFO(start);
    REQUIRE(outcome.result.solved);
    CHECK(validate(domain, problem, outcome.plan).valid);
    CHECK(outcome.result.evaluated < 20'000);  // of 181,440
  }
}

TEST_CASE("width search proves that two tiles cannot be exchanged, and keeps to its limits") {
  const Domain domain = domain_from_pddl(kTiles, "tiles");
  const Problem swapped = puzzle(domain, "012345687");
  const Outcome all = searched(domain, swapped);
  CHECK_FALSE(all.result.solved);
  CHECK(all.result.exhausted);
  CHECK(all.result.evaluated == 181'440);
  PlanLimits limits;
  limits.expansions = 1000;
  const Outcome some = searched(domain, swapped, limits);
  CHECK_FALSE(some.result.exhausted);
  CHECK(some.result.evaluated < 1010);
}

TEST_CASE("width search has nothing to do where the goal holds") {
  const Domain domain = domain_from_pddl(kTiles, "tiles");
  const Outcome outcome = searched(domain, puzzle(domain, "012345678"));
  CHECK(outcome.result.solved);
  CHECK(outcome.plan.empty());
}
