#include "engine/learning/operators.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/learning/plan_score.h"
#include "walks.h"

using namespace stampede;
using namespace stampede::learning;

namespace {

struct Judged {
  LearnedOperators learned;
  std::vector<ActionMatch> matches;
  OperatorScore score;
};

Judged judge(const Domain& truth, const Experience& experience, const std::vector<Sample>& samples,
             const LearningOptions& options = {}) {
  Judged result;
  result.learned = learn_operators(experience, options);
  result.matches = match_actions(result.learned.domain, truth, test::all_actions(truth));
  result.score = score_operators(result.learned.domain, truth, result.matches, test::all_actions(truth), samples);
  return result;
}

PlanScore planned(const Judged& judged, const Domain& truth) {
  std::vector<PlannedProblem> problems;
  for (int i = 0; i < 20; ++i) {
    Random random(RandomKey("problem").with(i));
    const char* goal = i % 2 == 0 ? "(and (inside b1 d2) (on b2 b3))" : "(and (on b1 b2) (on b2 b3))";
    problems.push_back(
        plan_with(judged.learned.domain, truth, test::table_problem(truth, 4, random, goal), judged.matches));
  }
  return summary(std::move(problems));
}

bool needs(const Domain& domain, const std::string& action, const std::string& literal) {
  return to_pddl(domain.action(action)->precondition).find(literal) != std::string::npos;
}

// The walk as facts over time: each successful call takes 4 frames in which its changes come one by one, and 30 go by
// before the next.
std::vector<History> filmed(const test::Walk& walk) {
  std::vector<History> histories;
  Facts now;
  std::map<Fact, std::int64_t> since;
  const auto finish = [&] {
    if (histories.empty()) return;
    History& last = histories.back();
    last.frames += 30;
    for (const auto& [fact, first] : since) last.spans.push_back({fact, first, last.frames});
    since.clear();
  };
  for (const Transition& one : walk.experience.transitions) {
    if (histories.empty() || histories.back().objects != one.objects) {
      finish();
      histories.push_back({{}, 1, one.objects});
      for (const Fact& fact : one.before) since[fact] = 0;
    }
    if (!one.success) continue;
    History& film = histories.back();
    std::int64_t frame = film.frames + 30, step = 0;
    for (const Fact& fact : one.before)
      if (!one.after.contains(fact)) {
        film.spans.push_back({fact, since.at(fact), frame + step++ % 4});
        since.erase(fact);
      }
    for (const Fact& fact : one.after)
      if (!one.before.contains(fact)) since[fact] = frame + step++ % 4;
    film.frames = frame + 4;
  }
  finish();
  return histories;
}

}  // namespace

TEST_CASE("operators learned from calls allow what the true ones allow and change what they change") {
  const Domain truth = test::table_domain();
  const test::Walk walk = test::walk(truth, 60, 60, 1), held_out = test::walk(truth, 10, 60, 2);
  const Judged judged = judge(truth, walk.experience, held_out.samples);
  CHECK(judged.score.applicable.f1() == 1);
  CHECK(judged.score.changes.f1() == 1);
  CHECK(judged.score.effects.f1() == 1);
  CHECK(judged.score.held.recall() == 1);  // of the true preconditions none is missing
  CHECK(judged.learned.unused == 0);
  CHECK(judged.learned.failures > 1000);
  CHECK(judged.learned.explained == judged.learned.failures);
  const PlanScore plans = planned(judged, truth);
  CHECK(plans.soundness() == 1);
  CHECK(plans.completeness() == 1);
  CHECK(plans.cost_ratio == Approx(1));
}

TEST_CASE("calls that change different literals are cases of their skill") {
  const Domain truth = test::table_domain();
  const LearnedOperators learned = learn_operators(test::walk(truth, 60, 60, 1).experience);
  // From a block pick also makes it clear, from the table it does not.
  REQUIRE(learned.domain.action("pick_1") != nullptr);
  REQUIRE(learned.domain.action("pick_2") != nullptr);
  CHECK(learned.domain.action("pick_1")->skill == "pick");
  CHECK(learned.domain.action("pick") == nullptr);
  REQUIRE(learned.domain.action("put") != nullptr);
  CHECK(learned.domain.action("put")->parameters[0].type == "block");  // what cubes and cylinders share
  CHECK(learned.domain.action("put")->parameters[1].type == "table");
}

TEST_CASE("what failures have and successes lack becomes a negated precondition, and only with failures") {
  const Domain truth = test::table_domain();
  Experience experience = test::walk(truth, 60, 60, 1).experience;
  CHECK(needs(learn_operators(experience).domain, "open_it", "(not (stuck ?a1))"));
  std::erase_if(experience.transitions, [](const Transition& one) { return !one.success; });
  CHECK_FALSE(needs(learn_operators(experience).domain, "open_it", "stuck"));
}

TEST_CASE("facts that are missing now and then cost no precondition where some tolerance is asked for") {
  const Domain truth = test::table_domain();
  test::Walk walk = test::walk(truth, 80, 60, 3);
  Random random(RandomKey("blind"));
  for (Transition& one : walk.experience.transitions)
    for (const Fact& fact : Facts(one.before))
      if (fact.predicate == "movable" && random.below(40) == 0) {
        one.before.erase(fact);
        one.after.erase(fact);
      }
  const LearnedOperators strict = learn_operators(walk.experience);
  const LearnedOperators tolerant = learn_operators(walk.experience, {.tolerance = 0.1});
  CHECK_FALSE(needs(strict.domain, "pick_1", "(movable ?a1)"));
  CHECK(needs(tolerant.domain, "pick_1", "(movable ?a1)"));
}

TEST_CASE("accidents are no cases where they are rare") {
  const Domain truth = test::table_domain();
  Experience experience = test::walk(truth, 60, 60, 1).experience;
  int spoilt = 0;
  for (Transition& one : experience.transitions)
    if (one.success && one.skill == "put" && spoilt < 2) {
      one.after.erase({"closed", {"d2"}});
      spoilt += one.before.contains({"closed", {"d2"}});
    }
  REQUIRE(spoilt == 2);
  CHECK(learn_operators(experience).domain.action("put_2") != nullptr);
  const LearnedOperators learned = learn_operators(experience, {.share = 0.1});
  CHECK(learned.domain.action("put") != nullptr);
  CHECK(learned.unused == 2);
}

TEST_CASE("without labels events are clustered, and the hand is found where nothing of it changes") {
  const Domain truth = test::table_domain();
  const test::Walk walk = test::walk(truth, 60, 60, 1), held_out = test::walk(truth, 10, 60, 2);
  const std::vector<History> histories = filmed(walk);
  const std::int64_t gap = natural_gap(histories);
  CHECK(gap >= 1);
  CHECK(gap < 27);
  Experience unlabelled;
  unlabelled.types = truth.types;
  for (const History& one : histories)
    for (Transition& event : events(one, gap)) unlabelled.transitions.push_back(std::move(event));
  const auto calls = std::count_if(walk.experience.transitions.begin(), walk.experience.transitions.end(),
                                   [](const Transition& one) { return one.success; });
  CHECK(static_cast<std::int64_t>(unlabelled.transitions.size()) == calls);

  const Judged judged = judge(truth, unlabelled, held_out.samples);
  CHECK(judged.learned.domain.action("op1") != nullptr);
  CHECK(judged.score.effects.f1() == 1);
  CHECK(judged.score.changes.f1() == 1);
  CHECK(judged.score.applicable.recall() == 1);
  CHECK(judged.score.applicable.precision() > 0.8);  // that a drawer is stuck only failures would tell
  for (const CallScore& one : judged.score.calls) {
    INFO(one.action);
    CHECK(one.cases >= 1);
  }
  const PlanScore plans = planned(judged, truth);
  CHECK(plans.completeness() == 1);  // goals use the drawer that is never stuck
}

TEST_CASE("learning the same twice gives the same bytes") {
  const Experience experience = test::walk(test::table_domain(), 20, 60, 9).experience;
  CHECK(to_pddl(learn_operators(experience).domain) == to_pddl(learn_operators(experience).domain));
  const Domain learned = learn_operators(experience).domain;
  CHECK(to_pddl(domain_from_pddl(to_pddl(learned), "learned.pddl")) == to_pddl(learned));
}

TEST_CASE("there is nothing to be learned from nothing, nor from calls of different lengths") {
  CHECK_THROWS_AS(learn_operators({}), Error);
  Experience experience;
  experience.transitions = {{"pick", {"a"}, {}, {}, true, {}}, {"pick", {"a", "b"}, {}, {}, true, {}}};
  CHECK_THROWS_WITH(learn_operators(experience), Catch::Contains("1 arguments and 2"));
}

TEST_CASE("an event is like the action whose effects it has") {
  const Domain truth = test::table_domain();
  const Experience experience = test::walk(truth, 40, 60, 4).experience;
  const Domain learned = learn_operators(experience).domain;
  int named = 0;
  for (const Transition& one : experience.transitions) {
    if (!one.success) continue;
    const std::string name = like_action(one, learned);
    ++named;
    // Put and put-on-a-block differ in what is clear; both are told from each other.
    CHECK(learned.action(name)->skill == one.skill);
  }
  CHECK(named > 50);
  CHECK(like_action({"", {}, {}, {{"odd", {"b1"}}}, true, {}}, learned).empty());
}
