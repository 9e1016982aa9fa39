// Domains with known mistakes: each figure falls where it should, and only there.
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/learning/plan_score.h"
#include "walks.h"

using namespace stampede;
using namespace stampede::learning;

namespace {

Action& action_in(Domain& domain, const std::string& name) {
  for (Action& one : domain.actions)
    if (one.name == name) return one;
  throw Error("test", "no action " + name);
}

OperatorScore scored(const Domain& learned, const Domain& truth) {
  const auto all = test::all_actions(truth);
  return score_operators(learned, truth, match_actions(learned, truth, all), all, test::walk(truth, 10, 60, 2).samples);
}

void drop_condition(Action& action, const std::string& predicate) {
  std::erase_if(action.precondition.parts, [&](const Formula& one) {
    return one.predicate == predicate || (!one.parts.empty() && one.parts[0].predicate == predicate);
  });
}

}  // namespace

TEST_CASE("the true domain has full marks") {
  const Domain truth = test::table_domain();
  const OperatorScore score = scored(truth, truth);
  for (const Counts& counts : {score.preconditions, score.effects, score.held, score.applicable, score.changes}) {
    CHECK(counts.right > 0);
    CHECK(counts.f1() == 1);
  }
}

TEST_CASE("a missing precondition allows too much, an extra one too little") {
  const Domain truth = test::table_domain();
  Domain learned = truth;
  drop_condition(action_in(learned, "put_in"), "open");
  OperatorScore score = scored(learned, truth);
  CHECK(score.applicable.precision() < 1);
  CHECK(score.applicable.recall() == 1);
  CHECK(score.preconditions.missed == 1);
  CHECK(score.held.missed == 1);
  CHECK(score.changes.f1() == 1);

  learned = truth;
  Action& put = action_in(learned, "put");
  put.precondition = conjunction({put.precondition, atom("open", {{false, "d1"}})});
  score = scored(learned, truth);
  CHECK(score.applicable.precision() == 1);
  CHECK(score.applicable.recall() < 1);
  CHECK(score.preconditions.wrong == 1);
}

TEST_CASE("literals that follow anyway are no mistakes, and are told apart") {
  const Domain truth = test::table_domain();
  Domain learned = truth;
  Action& put = action_in(learned, "put");
  put.precondition = conjunction({put.precondition, atom("movable", {{true, "b"}})});  // what is held is movable
  const OperatorScore score = scored(learned, truth);
  CHECK(score.preconditions.wrong == 1);
  CHECK(score.held.wrong == 0);
  for (const LiteralScore& one : score.literals)
    if (one.match.truth == "put") CHECK(one.extra == std::vector<std::string>{"[(movable ?b)]"});
}

TEST_CASE("a missing removal is seen in what calls change, in plans, and in their validity") {
  const Domain truth = test::table_domain();
  Domain learned = truth;
  std::erase_if(action_in(learned, "pick").effects, [](const Effect& one) { return one.predicate == "empty"; });
  const OperatorScore score = scored(learned, truth);
  CHECK(score.changes.recall() < 1);
  CHECK(score.changes.precision() == 1);
  CHECK(score.effects.missed == 1);
  Random random(RandomKey("problem"));
  const Problem problem = test::table_problem(truth, 3, random, "(and (holding hand b1) (inside b2 d2))");
  const auto matches = match_actions(learned, truth, test::all_actions(truth));
  const PlannedProblem result = plan_with(learned, truth, problem, matches);
  CHECK(result.solvable);
  CHECK(result.planned);
  CHECK_FALSE(result.valid);
  CHECK(result.reason.find("needs (empty hand)") != std::string::npos);
  const PlanScore plans = summary({result});
  CHECK(plans.soundness() == 0);
  CHECK(plans.completeness() == 0);
}

TEST_CASE("actions under other names, with their parameters in another order, are found by what they do") {
  const Domain truth = test::table_domain();
  Domain learned = truth;
  for (Action& one : learned.actions) {
    one.name = "x_" + std::string(1, static_cast<char>('a' + one.name.size())) + one.name.substr(0, 1);
    one.skill.clear();
    std::reverse(one.parameters.begin(), one.parameters.end());
  }
  const auto matches = match_actions(learned, truth, test::all_actions(truth));
  std::set<std::string> found;
  for (const ActionMatch& one : matches) {
    CHECK(one.likeness == Approx(1));
    CHECK_FALSE(one.by_name);
    found.insert(one.truth);
    const auto count = static_cast<int>(one.slot_of.size());
    for (int i = 0; i < count; ++i) CHECK(one.slot_of[static_cast<std::size_t>(i)] == count - 1 - i);
  }
  CHECK(found == test::all_actions(truth));
  const OperatorScore score =
      score_operators(learned, truth, matches, test::all_actions(truth), test::walk(truth, 4, 60, 2).samples);
  CHECK(score.applicable.f1() == 1);
}

TEST_CASE("an action that is like none stands for none, and its steps are left out of plans") {
  const Domain truth = test::table_domain();
  Domain learned = truth;
  Action odd;
  odd.name = "dance";
  odd.parameters = {{"d", "drawer", {}}};
  odd.effects = {{{}, {}, "stuck", {{true, "d"}}, false}};
  learned.actions.insert(learned.actions.begin(), odd);
  const auto matches = match_actions(learned, truth, test::all_actions(truth));
  CHECK(matches[0].truth.empty());
  CHECK(match_of(matches, "dance") == nullptr);
  Random random(RandomKey("problem"));
  const Problem problem = test::table_problem(truth, 3, random);
  CHECK(in_true_actions({{"dance", {"d1"}}}, learned, truth, problem, matches).empty());
  CHECK_THROWS_AS(in_true_actions({{"sing", {}}}, learned, truth, problem, matches), Error);
}

TEST_CASE("an argument that a learned action does not have is bound by the true precondition") {
  const Domain truth = test::table_domain();
  const Domain learned = domain_from_pddl(
      "(define (domain handless) (:types block table drawer) (:predicates (on ?b ?t) (held ?b) (empty ?h) (closed ?d) "
      "(open ?d)) (:action open_it :parameters (?d - drawer) :precondition (closed ?d) :effect (and (open ?d) (not "
      "(closed ?d)))))",
      "handless.pddl");
  const auto matches = match_actions(learned, truth, test::all_actions(truth));
  REQUIRE(matches.size() == 1);
  CHECK(matches[0].slot_of == std::vector<int>{0, -1});
  Random random(RandomKey("problem"));
  const Problem problem = test::table_problem(truth, 3, random, "(open d2)");
  const PlannedProblem result = plan_with(learned, truth, problem, matches);
  CHECK(result.valid);
  CHECK(result.plan == Plan{{"open_it", {"d2", "hand"}}});
}

TEST_CASE("a goal that a learned domain has no words for has no plan, and that is the reason") {
  const Domain truth = test::table_domain();
  const Domain learned = domain_from_pddl(
      "(define (domain small) (:predicates (closed ?d) (open ?d)) (:action open_it :parameters (?d) :precondition "
      "(closed ?d) :effect (open ?d)))",
      "small.pddl");
  Random random(RandomKey("problem"));
  const PlannedProblem result = plan_with(learned, truth, test::table_problem(truth, 3, random, "(inside b1 d2)"),
                                          match_actions(learned, truth, test::all_actions(truth)));
  CHECK(result.solvable);
  CHECK_FALSE(result.planned);
  CHECK(result.reason.find("`inside`") != std::string::npos);
}
