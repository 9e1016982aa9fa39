// The scorers, for the table in scorers.cpp: each in a file of its own, and each says there what its figures are.
#pragma once

#include "scripting/research/scorer.h"

namespace stampede::research {

std::vector<Figure> score_segments(const ScoringJob& job);  // score_segments.cpp

}  // namespace stampede::research
