#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem conditions_supervised_problem() {
  return by_a_domain({.name = "conditions_supervised",
                      .serves = "skill preconditions and effects, supervised",
                      .title = "operators of labelled skills, with examples of conditions",
                      .demos_only = false,
                      .given = kObservations + kFacts + Uses{{"skills"}} + kTrainedConditions});
}

}  // namespace stampede::research
