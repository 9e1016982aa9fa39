#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem symbols_problem() {
  return {.name = "symbols",
          .serves = "portable representations (symbols and operators)",
          .title = "symbols learned from transitions of known skills",
          .unit = Unit::piece,
          .demos_only = false,
          .given = Uses{{"piece_skill", Part::all, "skills"},
                        {"piece_poses", Part::all, "poses"},
                        {"piece_joints_around", Part::all, "joints"},
                        {"piece_hands_around", Part::all, "hands"},
                        {"objects"}},
          .hidden = Uses{{"piece_facts", Part::all, "facts"}} + kSources,
          .needs = {{"facts"}},
          .answer = {kPiece,
                     {"moment", AnswerType::text, "before or after", "before"},
                     {"symbol", AnswerType::text, "one that holds, with its objects; left out: none does",
                      "(s1 block1)", true}},
          .every_unit = false,
          .scoring =
              "Each true predicate is matched with one of the learned symbols of as many arguments, such that the mean "
              "F1 over predicates is greatest (Kuhn 1955); F1 counts ground symbols of all test moments. Each of them "
              "must be answered; a symbol that is not said does not hold.",
          .scorer = "symbols"};
}

}  // namespace stampede::research
