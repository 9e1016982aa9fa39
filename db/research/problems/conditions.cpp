#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem conditions_problem() {
  return by_a_domain({.name = "conditions",
                      .serves = "skill preconditions and effects, unsupervised",
                      .title = "operators of labelled skills, from what happens",
                      .demos_only = false,
                      .given = kObservations + kFacts + Uses{{"skills"}}});
}

}  // namespace stampede::research
