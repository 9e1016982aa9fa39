// Plans that rest on what nobody has seen: as much as they need of it, drawn.
#include "engine/rollout/assumptions.h"

#include <catch2/catch.hpp>

#include "engine/symbolic/pddl.h"

using namespace stampede;

namespace {

const char* const kDomain = R"((define (domain finds) (:requirements :strips :typing)
  (:types thing box - object)
  (:predicates (in ?t - thing ?b - box) (open ?b - box) (locked ?b - box) (have ?t - thing))
  (:action open-it :parameters (?b - box) :precondition (not (locked ?b)) :effect (open ?b))
  (:action take :parameters (?t - thing ?b - box) :precondition (and (in ?t ?b) (open ?b)) :effect (have ?t))))";

PlanningTask finds(const std::string& init, const std::string& goal) {
  PlanningTask task;
  task.domain = domain_from_pddl(kDomain, "domain");
  task.problem = problem_from_pddl(
      "(define (problem p) (:domain finds) (:objects key coin cap - thing low high - box)"
      " (:init " +
          init + ") (:goal (and " + goal + ")))",
      "problem", task.domain);
  return task;
}

Facts anywhere(const std::vector<std::string>& things) {
  Facts facts;
  for (const std::string& thing : things)
    for (const char* box : {"low", "high"}) facts.insert({"in", {thing, box}});
  return facts;
}

AssumingPlan find(const PlanningTask& task, const Facts& conceivable, std::int64_t seed) {
  return plan_assuming(task, conceivable, RandomKey("test").with(seed),
                       [](const PlanningTask& one) { return solve(one.domain, one.problem); });
}

}  // namespace

TEST_CASE("a plan assumes one fact of each thing that it needs and nobody has seen, and none of another") {
  const PlanningTask task = finds("", "(have key) (have coin)");
  std::set<Facts> guesses;
  for (std::int64_t seed = 0; seed < 40; ++seed) {
    const AssumingPlan found = find(task, anywhere({"key", "coin", "cap"}), seed);
    REQUIRE(found.outcome.solved);
    REQUIRE(found.assumed.size() == 2);
    CHECK(found.assumed.begin()->arguments[0] == "coin");
    CHECK(found.assumed.rbegin()->arguments[0] == "key");
    PlanningTask assumed = task;
    CHECK_FALSE(validate(assumed.domain, assumed.problem, found.outcome.plan).valid);
    assumed.problem.init.insert(found.assumed.begin(), found.assumed.end());
    CHECK(validate(assumed.domain, assumed.problem, found.outcome.plan).valid);
    guesses.insert(found.assumed);
  }
  CHECK(guesses.size() == 4);  // each of two things in each of two boxes
}

TEST_CASE("what is known goes first, and what makes no plan is not assumed") {
  const AssumingPlan known = find(finds("(in key low)", "(have key)"), anywhere({"coin"}), 1);
  CHECK(known.outcome.solved);
  CHECK(known.assumed.empty());
  for (std::int64_t seed = 0; seed < 10; ++seed) {
    const AssumingPlan high = find(finds("(locked low)", "(have key) (have coin)"), anywhere({"key", "coin"}), seed);
    CHECK(high.assumed == Facts{{"in", {"key", "high"}}, {"in", {"coin", "high"}}});
    const AssumingPlan none = find(finds("(locked low) (locked high)", "(have key)"), anywhere({"key"}), seed);
    CHECK_FALSE(none.outcome.solved);
    CHECK(none.assumed.empty());
    CHECK_FALSE(none.outcome.explanation.empty());
  }
}

TEST_CASE("after 64 guesses there is no plan, and each is asked for once") {
  const auto asked = [](int boxes) {
    Facts conceivable;
    for (int box = 0; box < boxes; ++box) conceivable.insert({"in", {"key", "box" + std::to_string(box)}});
    std::set<Facts> seen;
    int times = 0;
    const AssumingPlan found =
        plan_assuming(finds("", "(have key)"), conceivable, RandomKey("test"), [&](const PlanningTask& task) {
          seen.insert(task.problem.init);
          ++times;
          return PlanOutcome{};
        });
    CHECK_FALSE(found.outcome.solved);
    CHECK(static_cast<int>(seen.size()) == times);
    return times;
  };
  CHECK(asked(0) == 1);
  CHECK(asked(3) == 4);
  CHECK(asked(64) == 65);  // the first without any
  CHECK(asked(100) == 65);
}

TEST_CASE("why a fact that nobody can see is not assumed: something else is known of its thing, and a plan misses it") {
  const std::vector<NotAssumed> facts = {{{"in", {"key", "high"}}, {"on", {"key", "table"}}},
                                         {{"in", {"key", "low"}}, {"on", {"key", "table"}}},
                                         {{"in", {"coin", "low"}}, {"on", {"coin", "table"}}}};
  CHECK(why_not_assumed(facts, "(have key) cannot become true: `take` needs (in key ?b), which nothing achieves") ==
        "; nobody can see whether (in key high), but it is not assumed, for (on key table) is known of 'key': where "
        "nobody can see that either, the task says so in `observable`");
  CHECK(why_not_assumed(facts, "(open low) cannot become true").empty());
  CHECK(why_not_assumed({}, "`take` needs (in key ?b)").empty());
}
