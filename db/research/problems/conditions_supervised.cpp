#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem conditions_supervised_problem() {
  return {.name = "conditions_supervised",
          .serves = "skill preconditions and effects, supervised",
          .title = "operators of labelled skills, with examples of conditions",
          .demos_only = false,
          .given = kObservations + kFacts + Uses{{"skills"}} + kTrainedConditions,
          .hidden = Uses{{"skills"}} + kConditions + kPlanning + kSources,
          .needs = kPlanned,
          .answer_texts = {kDomain},
          .every_unit = false,
          .scoring = kOperatorScore,
          .scorer = "operators"};
}

}  // namespace stampede::research
