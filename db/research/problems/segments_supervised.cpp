#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem segments_supervised_problem() {
  return {.name = "segments_supervised",
          .serves = "skill segments, supervised",
          .title = "which skill runs when, learned from labelled episodes",
          .given = kProprioception + Uses{{"skills", Part::train}},
          .hidden = Uses{{"skills"}, {"joints"}, {"hands"}} + kSources,
          .needs = {{"joints"}, {"skills"}},
          .answer = {kEpisode, kFirst, kEnd, {"skill", AnswerType::text, "its name, as in table skills", "pick"}},
          .scoring = kSegmentScore,
          .scorer = "segments"};
}

}  // namespace stampede::research
