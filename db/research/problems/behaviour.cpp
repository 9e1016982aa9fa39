#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem behaviour_problem() {
  return {.name = "behaviour",
          .serves = "behaviour (imitation)",
          .title = "what to do next, from demonstrations and parts of logical programs",
          .given = kObservationsAsked + Uses{{"actions", Part::train},
                                             {"facts", Part::train},
                                             {"skills", Part::train},
                                             {"problems"},
                                             {"plans", Part::train},
                                             {"instructions"}},
          .hidden = Uses{{"asked_actions", Part::test, "actions"}, {"tasks"}} + kSources,
          .needs = {{"actions", "action_j1"}},
          .answer = action_columns(),
          .scoring = kActionScore,
          .scorer = "actions"};
}

}  // namespace stampede::research
