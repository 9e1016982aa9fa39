#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem segments_and_conditions_problem() {
  return {
      .name = "segments_and_conditions",
      .serves = "segments and conditions together, unsupervised",
      .title = "skills and their operators, from observations alone",
      .given = kObservations + kFacts,
      .hidden = Uses{{"skills"}, {"joints"}, {"hands"}} + kConditions + kPlanning + kSources,
      .needs = kPlanned,
      .answer = {kEpisode, kFirst, kEnd, {"skill", AnswerType::text, "name of an action of the domain", "a1", true}},
      .answer_texts = {kDomain},
      .scoring = kSegmentScore + kAnyLabels + " " + kOperatorScore,
      .scorer = "segments_and_operators"};
}

}  // namespace stampede::research
