#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem abstractions_problem() {
  return {.name = "abstractions",
          .serves = "state and action abstractions (SAT)",
          .title = "which of a planning problem's objects, predicates and actions matter",
          .given = Uses{{"problems"}, {"plans", Part::train}},
          .hidden = Uses{{"skills"}} + kConditions + kPlanning + kSources,
          .needs = kPlanned,
          .answer_texts = {kDomain},
          .every_unit = false,
          .scoring = kOperatorScore,
          .scorer = "operators"};
}

}  // namespace stampede::research
