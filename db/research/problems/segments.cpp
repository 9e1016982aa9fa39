#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem segments_problem() {
  return {.name = "segments",
          .serves = "skill segments, unsupervised",
          .title = "where skills begin and end, without labels",
          .given = kProprioception,
          .hidden = Uses{{"skills"}, {"joints"}, {"hands"}} + kSources,
          .needs = {{"joints"}, {"skills"}},
          .answer = {kEpisode,
                     kFirst,
                     kEnd,
                     {"skill", AnswerType::text, "any name: the same for the same skill", "a", true}},
          .scoring = kSegmentScore + kAnyLabels,
          .scorer = "segments"};
}

}  // namespace stampede::research
