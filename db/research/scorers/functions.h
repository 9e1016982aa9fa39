// The scorers, for the table in scorers.cpp: each in a file of its own, and each says there what its figures are.
#pragma once

#include "db/research/scorer.h"

namespace stampede::research {

std::vector<Figure> score_segments(const ScoringJob& job);     // segments.cpp
std::vector<Figure> score_facts(const ScoringJob& job);        // facts.cpp
std::vector<Figure> score_symbols(const ScoringJob& job);      // facts.cpp
std::vector<Figure> score_clusters(const ScoringJob& job);     // clusters.cpp
std::vector<Figure> score_actions(const ScoringJob& job);      // actions.cpp
std::vector<Figure> score_rewards(const ScoringJob& job);      // rewards.cpp
std::vector<Figure> score_predictions(const ScoringJob& job);  // predictions.cpp

std::vector<Figure> score_operators(const ScoringJob& job);               // operators.cpp
std::vector<Figure> score_segments_and_operators(const ScoringJob& job);  // operators.cpp
std::vector<Figure> score_abstractions(const ScoringJob& job);            // abstractions.cpp

}  // namespace stampede::research
