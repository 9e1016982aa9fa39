// Simple answers to each problem, made from the given part alone: what a learner has to beat.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "db/plain_file.h"
#include "db/research/answers.h"

namespace stampede::research {

struct Baseline {
  std::string name;
  std::vector<std::string> problems;  // that it answers
  std::string about;                  // with its paper
  Answers (*answer)(const ResearchProblem& problem, const PlainFile& given) = nullptr;
};

const std::vector<Baseline>& all_baselines();          // a new one is a function and a line in baselines.cpp
const Baseline& find_baseline(std::string_view name);  // throws Error with the nearest name

// Opens DIR/given.db, finds its problem, answers. Throws Error for a baseline of another problem.
Answers answer_by(const Baseline& baseline, const std::filesystem::path& given_folder);

}  // namespace stampede::research
