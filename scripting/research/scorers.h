// The scorers, for the table in scorers.cpp: each in a file of its own, and each says there what its figures are.
#pragma once

#include "scripting/research/scorer.h"

namespace stampede::research {

std::vector<Figure> score_segments(const ScoringJob& job);     // score_segments.cpp
std::vector<Figure> score_facts(const ScoringJob& job);        // score_facts.cpp
std::vector<Figure> score_symbols(const ScoringJob& job);      // score_facts.cpp
std::vector<Figure> score_clusters(const ScoringJob& job);     // score_clusters.cpp
std::vector<Figure> score_actions(const ScoringJob& job);      // score_actions.cpp
std::vector<Figure> score_rewards(const ScoringJob& job);      // score_rewards.cpp
std::vector<Figure> score_predictions(const ScoringJob& job);  // score_predictions.cpp

std::vector<Figure> score_operators(const ScoringJob& job);               // score_operators.cpp
std::vector<Figure> score_segments_and_operators(const ScoringJob& job);  // score_operators.cpp
std::vector<Figure> score_abstractions(const ScoringJob& job);            // score_abstractions.cpp

}  // namespace stampede::research
