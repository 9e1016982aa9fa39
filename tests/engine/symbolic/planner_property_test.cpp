// Random domains: the planner's ground task against the plain semantics, which share no code for states.
#include <catch2/catch.hpp>
#include <deque>

#include "engine/symbolic/evaluation.h"
#include "engine/symbolic/state.h"
#include "random_worlds.h"

using namespace stampede;

namespace {

// Truth by its definition: every binding tried.
bool plainly_holds(const Formula& formula, const symbolic::View& view, Binding& binding) {
  using Kind = Formula::Kind;
  const auto part = [&](const Formula& one) { return plainly_holds(one, view, binding); };
  switch (formula.kind) {
    case Kind::negation:
      return !part(formula.parts.at(0));
    case Kind::conjunction:
      return std::all_of(formula.parts.begin(), formula.parts.end(), part);
    case Kind::disjunction:
      return std::any_of(formula.parts.begin(), formula.parts.end(), part);
    case Kind::exists:
      return !symbolic::for_each_binding(formula.variables, view, binding, [&] { return !part(formula.parts.at(0)); });
    case Kind::forall:
      return symbolic::for_each_binding(formula.variables, view, binding, [&] { return part(formula.parts.at(0)); });
    default:
      return symbolic::evaluate(formula, view, binding);
  }
}

// All ground steps that can be taken, by the plain semantics.
std::vector<PlanStep> possible_steps(const test::RandomWorld& world, const Facts& facts) {
  std::vector<PlanStep> steps;
  const Facts derived = with_derived(facts, world.domain, world.problem.objects);
  const symbolic::View view{derived, world.domain, world.problem.objects};
  for (const Action& action : world.domain.actions) {
    Binding binding;
    symbolic::for_each_binding(action.parameters, view, binding, [&] {
      const std::string &a = binding.at("a"), &b = binding.at("b");
      if (!(action.distinct && a == b) && plainly_holds(action.precondition, view, binding)) {
        steps.push_back({action.name, {a, b}});
      }
      return true;
    });
  }
  return steps;
}

struct Exhausted {
  bool reached = false, complete = true;
  std::size_t length = 0;
};

// Breadth first, up to so many states.
Exhausted breadth_first(const test::RandomWorld& world, std::size_t most) {
  const auto is_goal = [&](const Facts& facts) {
    const Facts derived = with_derived(facts, world.domain, world.problem.objects);
    Binding none;
    return plainly_holds(world.problem.goal, {derived, world.domain, world.problem.objects}, none);
  };
  std::set<Facts> seen = {world.problem.init};
  std::deque<std::pair<Facts, std::size_t>> queue = {{world.problem.init, 0}};
  while (!queue.empty()) {
    const auto [facts, depth] = std::move(queue.front());
    queue.pop_front();
    if (is_goal(facts)) return {true, true, depth};
    if (seen.size() > most) return {false, false, 0};
    for (const PlanStep& step : possible_steps(world, facts)) {
      Facts next = apply(*world.domain.action(step.action), step.arguments, facts, world.domain, world.problem.objects);
      if (seen.insert(next).second) queue.emplace_back(std::move(next), depth + 1);
    }
  }
  return {};
}

}  // namespace

TEST_CASE("formulas hold by joins over facts exactly where they hold by trying every binding") {
  for (int seed = 0; seed < 300; ++seed) {
    Random random(RandomKey("joins").with(seed));
    test::RandomWorld world(random);
    const Facts facts = with_derived(world.problem.init, world.domain, world.problem.objects);
    const symbolic::View view{facts, world.domain, world.problem.objects};
    for (int i = 0; i < 10; ++i) {
      const Formula formula = world.formula({"a"}, 5, 3);
      for (const TypedObject& object : world.problem.objects) {
        Binding binding = {{"a", object.name}}, same = binding;
        INFO("seed " << seed);
        REQUIRE(symbolic::evaluate(formula, view, binding) == plainly_holds(formula, view, same));
        REQUIRE(binding == same);
      }
    }
  }
}

TEST_CASE(
    "derived facts follow the changes of a random walk exactly as the plain semantics derives them from nothing") {
  std::size_t compared = 0;
  for (int seed = 0; seed < 60; ++seed) {
    Random random(RandomKey("walks").with(seed));
    test::RandomWorld world(random);
    const symbolic::GroundTask task = symbolic::ground(symbolic::lift(world.domain, world.problem), {});
    const symbolic::Semantics semantics(task);
    symbolic::Words state = semantics.initial(), next;
    Facts facts = world.problem.init;
    for (int step = 0; step < 12; ++step) {
      const Facts derived = with_derived(facts, world.domain, world.problem.objects);
      for (int fact = 0; fact < task.facts; ++fact) {
        const Fact one = task.fact(task.atoms[fact]);
        if (one.predicate.starts_with("one of ")) continue;  // auxiliary
        INFO("seed " << seed << ", step " << step << ", " << to_text(one));
        REQUIRE(symbolic::test(state.data(), fact) == derived.contains(one));
        ++compared;
      }
      std::vector<int> possible;
      std::set<PlanStep> steps;
      for (int op = 0; op < static_cast<int>(task.operators.size()); ++op) {
        if (!semantics.applicable(state, op)) continue;
        possible.push_back(op);
        steps.insert(task.step(op));
      }
      for (const PlanStep& one : possible_steps(world, facts)) {
        const Facts after =
            apply(*world.domain.action(one.action), one.arguments, facts, world.domain, world.problem.objects);
        INFO("seed " << seed << ", step " << step << ", " << to_text(Fact{one.action, one.arguments}));
        REQUIRE((after == facts || steps.contains(one)));  // steps that can change nothing are no operators
      }
      if (possible.empty()) break;
      const int taken = possible[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(possible.size())))];
      const PlanStep chosen = task.step(taken);
      semantics.apply(state, taken, next);
      state.swap(next);
      facts = apply(*world.domain.action(chosen.action), chosen.arguments, facts, world.domain, world.problem.objects);
    }
  }
  CHECK(compared > 5000);
}

TEST_CASE("random problems: solved where breadth-first search reaches the goal, with plans that validate") {
  int solved = 0, unsolvable = 0;
  for (int seed = 0; seed < 150; ++seed) {
    Random random(RandomKey("random problems").with(seed));
    test::RandomWorld world(random);
    PlanLimits limits;  // a million states are possible: an unsolvable problem would be searched through
    limits.expansions = 2000;
    limits.improve = 200;
    const PlanOutcome outcome = solve(world.domain, world.problem, limits);
    const Exhausted all = breadth_first(world, 40);
    INFO("seed " << seed << ": " << outcome.explanation);
    if (outcome.solved) {
      const Validation verdict = validate(world.domain, world.problem, outcome.plan);
      INFO(verdict.explanation);
      REQUIRE(verdict.valid);
      if (all.reached) CHECK(outcome.plan.size() >= all.length);
    }
    if (all.reached) REQUIRE(outcome.end != PlanEnd::unsolvable);
    if (all.complete && !all.reached) REQUIRE(outcome.end == PlanEnd::unsolvable);
    solved += outcome.solved ? 1 : 0;
    unsolvable += all.complete && !all.reached ? 1 : 0;
  }
  CHECK(solved > 30);
  CHECK(unsolvable > 10);
}
