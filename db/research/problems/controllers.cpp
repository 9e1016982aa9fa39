#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem controllers_problem() {
  return {.name = "controllers",
          .serves = "composition of controllers by priority",
          .title = "which controller acts when, and policies that choose",
          .given = kObservations + Uses{{"instructions"}, {"controls", Part::train}},
          .hidden = Uses{{"controls"}, {"tasks"}} + kSources,
          .needs = {{"controls"}},
          .answer = {kEpisode,
                     kFirst,
                     kEnd,
                     {"motion", AnswerType::text, "what moves the arm, as in table controls", "approach"}},
          .scoring = kSegmentScore +
                     "Success is measured with the policy in the loop: `stampede evaluate TASK --policy \"…\"`, whose "
                     "actions may call skills with controllers of its choice.",
          .scorer = "segments"};
}

}  // namespace stampede::research
