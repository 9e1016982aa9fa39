#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem transfer_problem() {
  return {.name = "transfer",
          .serves = "task transfer; efficient exploration (RL)",
          .title = "a policy for what was held out, from what was seen, with rewards",
          .demos_only = false,
          .given = kObservationsAsked + Uses{{"actions", Part::train}, {"rewards", Part::train}, {"tasks"}},
          .hidden = Uses{{"asked_actions", Part::test, "actions"}} + kSources,
          .needs = {{"actions", "action_j1"}},
          .answer = action_columns(),
          .scoring = kActionScore,
          .scorer = "actions"};
}

}  // namespace stampede::research
