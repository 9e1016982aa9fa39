#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem motions_problem() {
  return {
      .name = "motions",
      .serves = "motions from demos (VAE, GAN)",
      .title = "which skill made a piece of motion",
      .unit = Unit::piece,
      .given = Uses{{"piece_joints", Part::all, "joints"}, {"piece_hands", Part::all, "hands"}},
      .hidden = Uses{{"piece_skill", Part::all, "skills"}} + kSources,
      .needs = {{"joints"}, {"skills"}},
      .answer = {kPiece, {"cluster", AnswerType::text, "any name: the same for the same skill", "a"}},
      .scoring = "Clusters against skills: purity, NMI, adjusted Rand index, and accuracy after matching one to one.",
      .scorer = "clusters"};
}

}  // namespace stampede::research
