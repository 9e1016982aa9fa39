#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "scripting/research/baseline.h"
#include "scripting/research/baseline_functions.h"
#include "scripting/research/dataset.h"

namespace stampede::research {

const std::vector<Baseline>& all_baselines() {
  static const std::vector<Baseline> baselines = {
      {"one_segment", {"segments", "segments_supervised"}, "the whole episode is one segment", one_segment},
  };
  return baselines;
}

const Baseline& find_baseline(std::string_view name) {
  std::vector<std::string> names;
  for (const Baseline& baseline : all_baselines()) {
    if (baseline.name == name) return baseline;
    names.push_back(baseline.name);
  }
  const std::string meant = did_you_mean(name, names);
  throw Error("baseline", "there is no baseline '" + std::string(name) + "'",
              (meant.empty() ? "" : meant + " ") + "`stampede baseline --list` names all");
}

Answers answer_by(const Baseline& baseline, const std::filesystem::path& given_folder) {
  const PlainFile given = PlainFile::open(given_folder / kGivenFile);
  const std::string name = dataset_problem(given);
  if (std::find(baseline.problems.begin(), baseline.problems.end(), name) == baseline.problems.end()) {
    std::string served;
    for (const std::string& problem : baseline.problems) served += (served.empty() ? "" : ", ") + problem;
    throw Error("baseline", baseline.name + " does not answer " + name, "it answers " + served);
  }
  const ResearchProblem& problem = find_problem(name);
  Answers answers = baseline.answer(problem, given);
  answers.dataset = dataset_id(given);
  answers.problem = name;
  if (answers.rows.columns.empty())
    for (const AnswerColumn& column : problem.answer) answers.rows.columns.push_back(column.name);
  return answers;
}

}  // namespace stampede::research
