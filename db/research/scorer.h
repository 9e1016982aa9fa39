// How answers become figures: one function a scorer, and the table that names them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "db/plain_file.h"
#include "db/research/answers.h"
#include "db/research/physics.h"
#include "db/research/problem.h"
#include "engine/base/output_file.h"

namespace stampede::research {

// One number of a score. `better` says which way is good, for tables and people.
struct Figure {
  std::string name;   // `f1_within_5`
  double value = 0;   // finite
  std::string about;  // what it is, in words
  bool higher_is_better = true;
};

// What whoever asks for a score may say.
struct ScoreOptions {
  RunHeldOut run = {};                // runs plans, for scorers that try them
  std::int64_t physics = 0;           // plans to run, at most; 0: none
  std::int64_t figure_episode = 0;    // of the data set; 0: the first of the test split
  std::filesystem::path figure = {};  // where to draw one, for scorers that can; empty: nowhere
  OutputRules rules = {};             // of the figure
};

// What a scorer reads. The answers fit the problem's columns, name this data set and each test unit of it (checked
// before), and hold no NaN.
struct ScoringJob {
  const ResearchProblem& problem;
  const Answers& answers;
  const PlainFile& hidden;
  const std::vector<std::int64_t>& test_units;  // numbers of the episodes or pieces that count
  const ScoreOptions& options;
};

struct Scorer {
  std::string name, about;
  // Throws Error{answers' file, what, cure} for answers that cannot be scored.
  std::vector<Figure> (*score)(const ScoringJob& job) = nullptr;
};

const std::vector<Scorer>& all_scorers();  // a new one is a function and a line in scorers.cpp

// What score() can do for a problem beside figures.
bool draws_timelines(const ResearchProblem& problem);
bool makes_plans(const ResearchProblem& problem);

// Reads and checks both, then scores. Throws Error for answers for another data set, missing units, unknown columns.
struct Scored {
  std::string dataset, problem;
  std::int64_t units = 0;  // that counted
  std::vector<Figure> figures;
};
Scored score(const std::filesystem::path& answers, const std::filesystem::path& hidden_folder,
             const ScoreOptions& options = {});

}  // namespace stampede::research
