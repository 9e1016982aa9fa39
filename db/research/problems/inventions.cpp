#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem inventions_problem() {
  return {
      .name = "inventions",
      .serves = "portable representations (symbols and operators)",
      .title = "predicates and operators of one's own, from observations and labelled skills",
      .demos_only = false,
      .given = kObservations + Uses{{"skills"}},
      .hidden = kFacts + Uses{{"skills"}} + kConditions + kPlanning + kSources,
      .needs = kPlanned,
      .answer = {kEpisode,
                 kFrame,
                 {"fact", AnswerType::text, "an atom of a predicate (or type) of the domain", "(grasped block1)"},
                 {"holds", AnswerType::integer, "1 or 0; left out: 1", "1", true}},
      .answer_texts = {kDomain},
      .every_unit = false,
      .scoring =
          std::string("Learned predicates are mapped to true ones by agreement (MCC) at the frames answered, arguments "
                      "in any order, denied or not, one to one (Kuhn 1955), two at once where one does not do; types "
                      "by their objects. Of each test episode the frames before and after skills must be answered, and "
                      "others may be: what is said of one of them must be said of all. Then, in true words: ") +
          kOperatorScore,
      .scorer = "abstractions"};
}

}  // namespace stampede::research
