#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem abstractions_problem() {
  return by_a_domain({.name = "abstractions",
                      .serves = "state and action abstractions (SAT)",
                      .title = "which of a planning problem's objects, predicates and actions matter",
                      .given = Uses{{"problems"}, {"plans", Part::train}}});
}

}  // namespace stampede::research
