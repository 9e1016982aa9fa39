// The baselines, for the table in baselines.cpp. Each reads the given part alone.
#pragma once

#include "scripting/research/baseline.h"

namespace stampede::research {

Answers one_segment(const ResearchProblem& problem, const PlainFile& given);  // baseline_segments.cpp

}  // namespace stampede::research
