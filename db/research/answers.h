// Answers to a research problem, as JSON or CSV.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "db/plain_file.h"
#include "db/research/problem.h"

namespace stampede::research {

// JSON: {"dataset": ID, "problem": NAME, "answers": [{"episode": 1, …}, …], "domain": "(define …"}; CSV: a first line
// `# dataset: ID`, a header, rows. Rows are sorted as they stand in the file.
struct Answers {
  std::string dataset, problem;
  Rows rows;  // columns as the problem's row says, in its order; optional ones may be NULL
  std::map<std::string, std::string> texts;  // beside the rows, by name
  std::string where;                         // the file, for complaints
};

// Throws Error with file and line or row for text that is neither, missing and unknown columns, values of another type,
// numbers that are not finite.
Answers read_answers(const std::filesystem::path& file, const ResearchProblem& problem);
std::string answers_text(const Answers& answers);  // as JSON

// A small example that read_answers() takes.
std::string example_answers(const ResearchProblem& problem, const std::string& dataset,
                            const std::vector<std::int64_t>& units);

}  // namespace stampede::research
