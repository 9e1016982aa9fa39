#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem conditions_problem() {
  return {.name = "conditions",
          .serves = "skill preconditions and effects, unsupervised",
          .title = "operators of labelled skills, from what happens",
          .demos_only = false,
          .given = kObservations + kFacts + Uses{{"skills"}},
          .hidden = Uses{{"skills"}} + kConditions + kPlanning + kSources,
          .needs = kPlanned,
          .answer_texts = {kDomain},
          .every_unit = false,
          .scoring = kOperatorScore,
          .scorer = "operators"};
}

}  // namespace stampede::research
