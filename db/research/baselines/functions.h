// The baselines, for the table in baselines.cpp. Each reads the given part alone.
#pragma once

#include "db/research/baseline.h"

namespace stampede::research {

// segments.cpp
Answers one_segment(const ResearchProblem& problem, const PlainFile& given);
Answers equal_parts(const ResearchProblem& problem, const PlainFile& given);
Answers keyframe_segments(const ResearchProblem& problem, const PlainFile& given);
Answers change_points(const ResearchProblem& problem, const PlainFile& given);
// hmm.cpp
Answers hidden_markov(const ResearchProblem& problem, const PlainFile& given);
// numbers.cpp
Answers motion_clusters(const ResearchProblem& problem, const PlainFile& given);
Answers one_cluster(const ResearchProblem& problem, const PlainFile& given);
Answers stay_there(const ResearchProblem& problem, const PlainFile& given);
Answers nearest_action(const ResearchProblem& problem, const PlainFile& given);
Answers linear_action(const ResearchProblem& problem, const PlainFile& given);
// rewards.cpp
Answers random_values(const ResearchProblem& problem, const PlainFile& given);
Answers elapsed_time(const ResearchProblem& problem, const PlainFile& given);
Answers learned_value(const ResearchProblem& problem, const PlainFile& given);
Answers goal_relations(const ResearchProblem& problem, const PlainFile& given);
// predictions.cpp
Answers nothing_moves(const ResearchProblem& problem, const PlainFile& given);
Answers constant_velocity(const ResearchProblem& problem, const PlainFile& given);
Answers linear_tip(const ResearchProblem& problem, const PlainFile& given);
// facts.cpp
Answers geometry_facts(const ResearchProblem& problem, const PlainFile& given);
Answers geometry_symbols(const ResearchProblem& problem, const PlainFile& given);
Answers invented_predicates(const ResearchProblem& problem, const PlainFile& given);  // inventions.cpp

Answers operators_with_labels(const ResearchProblem& problem, const PlainFile& given);     // operators.cpp
Answers operators_without_labels(const ResearchProblem& problem, const PlainFile& given);  // operators.cpp
Answers actions_of_plans(const ResearchProblem& problem, const PlainFile& given);          // operators.cpp

}  // namespace stampede::research
