#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem concepts_problem() {
  return {
      .name = "concepts",
      .serves = "concepts (with pre-trained models)",
      .title = "named predicates, from observations and language",
      .given = kObservations + Uses{{"descriptions"}, {"vocabulary"}},
      .hidden = kFacts + Uses{{"objects"}} + kSources,
      .needs = {{"vocabulary"}, {"facts", "predicate_kind"}},
      .answer = {kEpisode,
                 kFrame,
                 {"fact", AnswerType::text, "one that holds there; left out: none does", "(on block1 table)", true}},
      .every_unit = false,
      .scoring =
          "Agreement with the facts at every 20th frame: precision, recall, F1 and MCC (over all ground atoms of the "
          "vocabulary), and the mean F1 over predicates. Each of these frames must be answered; a fact that is not "
          "said does not hold.",
      .scorer = "facts"};
}

}  // namespace stampede::research
