// Task planning, whole: lifting, grounding, search, shortening. Counters: plan length and expansions.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "engine/base/random.h"
#include "engine/symbolic/pddl.h"

namespace {

using namespace stampede;

const char* const kBlocks = R"((define (domain blocks) (:requirements :strips :typing) (:types block)
  (:predicates (on ?x ?y - block) (ontable ?x - block) (clear ?x - block) (handempty) (holding ?x - block))
  (:action pick_up :parameters (?x - block) :precondition (and (clear ?x) (ontable ?x) (handempty))
    :effect (and (not (ontable ?x)) (not (clear ?x)) (not (handempty)) (holding ?x)))
  (:action put_down :parameters (?x - block) :precondition (holding ?x)
    :effect (and (not (holding ?x)) (clear ?x) (handempty) (ontable ?x)))
  (:action stack :parameters (?x ?y - block) :precondition (and (holding ?x) (clear ?y))
    :effect (and (not (holding ?x)) (not (clear ?y)) (clear ?x) (handempty) (on ?x ?y)))
  (:action unstack :parameters (?x ?y - block) :precondition (and (on ?x ?y) (clear ?x) (handempty))
    :effect (and (holding ?x) (clear ?y) (not (clear ?x)) (not (handempty)) (not (on ?x ?y))))))";

const char* const kTabletop = R"((define (domain tabletop) (:requirements :strips :typing)
  (:types movable place - object region drawer - place)
  (:predicates (handempty) (holding ?o - movable) (at ?o - movable ?p - place) (flat ?o - movable)
    (on ?o ?b - movable) (clear ?o - movable) (accessible ?p - place) (closed ?d - drawer))
  (:action pick :parameters (?o - movable ?p - place)
    :precondition (and (handempty) (at ?o ?p) (flat ?o) (clear ?o) (accessible ?p))
    :effect (and (holding ?o) (not (handempty)) (not (at ?o ?p)) (not (flat ?o)) (not (clear ?o))))
  (:action place :parameters (?o - movable ?p - place) :precondition (and (holding ?o) (accessible ?p))
    :effect (and (handempty) (not (holding ?o)) (at ?o ?p) (flat ?o) (clear ?o)))
  (:action stack :parameters (?o ?b - movable ?p - region)
    :precondition (and (holding ?o) (clear ?b) (at ?b ?p))
    :effect (and (handempty) (not (holding ?o)) (on ?o ?b) (at ?o ?p) (clear ?o) (not (clear ?b))))
  (:action unstack :parameters (?o ?b - movable ?p - region)
    :precondition (and (handempty) (on ?o ?b) (clear ?o) (at ?o ?p))
    :effect (and (holding ?o) (not (handempty)) (not (on ?o ?b)) (not (at ?o ?p)) (not (clear ?o)) (clear ?b)))
  (:action open_drawer :parameters (?d - drawer) :precondition (and (handempty) (closed ?d))
    :effect (and (accessible ?d) (not (closed ?d))))
  (:action close_drawer :parameters (?d - drawer) :precondition (and (handempty) (accessible ?d))
    :effect (and (closed ?d) (not (accessible ?d))))))";

std::vector<std::string> shuffled(const std::string& stem, std::int64_t count, Random& random) {
  std::vector<std::string> names;
  for (std::int64_t i = 0; i < count; ++i) names.push_back(stem + std::to_string(i));
  for (std::int64_t i = count - 1; i > 0; --i) std::swap(names[i], names[random.below(i + 1)]);
  return names;
}

std::string towers(std::int64_t count, Random& random, bool goal) {
  std::string text, below;
  for (const std::string& name : shuffled("b", count, random)) {
    const bool on_table = below.empty() || random.below(4) == 0;
    if (!goal && !below.empty() && on_table) text += " (clear " + below + ")";
    if (!on_table) text += " (on " + name + " " + below + ")";
    if (on_table && !goal) text += " (ontable " + name + ")";
    below = name;
  }
  return goal ? text : text + " (clear " + below + ") (handempty)";
}

std::string names_text(const std::string& stem, std::int64_t count, const std::string& type) {
  std::string text;
  for (std::int64_t i = 0; i < count; ++i) text += stem + std::to_string(i) + " ";
  return text + "- " + type + " ";
}

std::string blocks_problem(std::int64_t count) {
  Random random(RandomKey("bench blocks").with(count));
  const std::string init = towers(count, random, false), goal = towers(count, random, true);
  return "(define (problem p) (:domain blocks) (:objects " + names_text("b", count, "block") + ") (:init" + init +
         ") (:goal (and" + goal + ")))";
}

// Objects in regions, stacks of two and drawers; about as many are wanted elsewhere.
std::string layout(std::int64_t count, Random& random, bool goal) {
  std::string text, below, place;
  for (const std::string& name : shuffled("o", count, random)) {
    const bool stacked = !below.empty() && place[0] == 'r' && random.below(3) == 0;
    if (!below.empty() && !stacked && !goal) text += " (clear " + below + ")";
    if (!stacked)
      place = random.below(5) == 0 ? "d" + std::to_string(random.below(3)) : "r" + std::to_string(random.below(8));
    text += " (at " + name + " " + place + ")";
    if (stacked) text += " (on " + name + " " + below + ")";
    if (!stacked && !goal) text += " (flat " + name + ")";
    below = name;
  }
  return goal ? text : text + " (clear " + below + ")";
}

std::string tabletop_problem(std::int64_t count) {
  Random random(RandomKey("bench tabletop").with(count));
  std::string init = layout(count, random, false) + " (handempty)", goal = layout(count, random, true);
  for (int i = 0; i < 8; ++i) init += " (accessible r" + std::to_string(i) + ")";
  for (int i = 0; i < 3; ++i) {
    init += " (closed d" + std::to_string(i) + ")";
    goal += " (closed d" + std::to_string(i) + ")";
  }
  return "(define (problem p) (:domain tabletop) (:objects " + names_text("o", count, "movable") +
         names_text("r", 8, "region") + names_text("d", 3, "drawer") + ") (:init" + init + ") (:goal (and" + goal +
         ")))";
}

void plan_all(benchmark::State& state, const char* domain_text, const std::string& problem_text) {
  const Domain domain = domain_from_pddl(domain_text, "domain");
  const Problem problem = problem_from_pddl(problem_text, "problem", domain);
  PlanOutcome outcome;
  for (auto _ : state) outcome = solve(domain, problem);
  if (!validate(domain, problem, outcome.plan).valid) state.SkipWithError("the plan does not validate");
  state.counters["steps"] = static_cast<double>(outcome.plan.size());
  state.counters["expanded"] = static_cast<double>(outcome.expanded);
}

void blocks(benchmark::State& state) { plan_all(state, kBlocks, blocks_problem(state.range(0))); }
void tabletop(benchmark::State& state) { plan_all(state, kTabletop, tabletop_problem(state.range(0))); }

BENCHMARK(blocks)->Arg(10)->Arg(20)->Arg(40)->Unit(benchmark::kMillisecond);
BENCHMARK(tabletop)->Arg(10)->Arg(20)->Arg(60)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
