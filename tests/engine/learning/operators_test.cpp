#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/learning/operators.h"
#include "engine/learning/plan_score.h"
#include "walks.h"

using namespace stampede;
using namespace stampede::learning;

TEST_CASE("operators are learned from labelled transitions") {
  const Domain truth = test::table_domain();
  const test::Walk walk = test::walk(truth, 30, 60, 1);
  const LearnedOperators learned = learn_operators(walk.experience);
  printf("%s", to_pddl(learned.domain).c_str());
  const auto matches = match_actions(learned.domain, truth, test::all_actions(truth));
  const OperatorScore score = score_operators(learned.domain, truth, matches, test::all_actions(truth), walk.samples);
  for (const auto& one : score.literals) {
    printf("%s -> %s %.2f pre %.2f %.2f eff %.2f %.2f held %.2f %.2f\n", one.match.learned.c_str(), one.match.truth.c_str(), one.match.likeness,
      one.preconditions.precision(), one.preconditions.recall(), one.effects.precision(), one.effects.recall(), one.held.precision(), one.held.recall());
    for (auto& t : one.extra) printf("   + %s\n", t.c_str());
    for (auto& t : one.missing) printf("   - %s\n", t.c_str());
  }
  for (const auto& one : score.calls)
    printf("%s cases %d app %.2f %.2f chg %.2f %.2f\n", one.action.c_str(), one.cases, one.applicable.precision(), one.applicable.recall(), one.changes.precision(), one.changes.recall());
  printf("transitions %d unused %d failures %d explained %d\n", learned.transitions, learned.unused, learned.failures, learned.explained);
}
