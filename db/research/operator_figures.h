// Figures of a learned domain in true words; what scorers of operators and of abstractions share.
#pragma once

#include "db/research/scorer.h"
#include "db/research/symbols_of.h"

namespace stampede::research {

// The domain that the answers have, under `domain`. Throws Error with line and column for what is no PDDL, and where it
// has no action.
Domain answered_domain(const ScoringJob& job);

// Operators by literals and by calls, plans by the true domain, and `job.options.physics` of them run.
std::vector<Figure> operator_figures(const Domain& learned, const HeldOutProblems& held, const ScoringJob& job);

}  // namespace stampede::research
