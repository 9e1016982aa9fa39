#include "db/research/problems/parts.h"
#include "engine/base/error.h"
#include "engine/base/nearest.h"

namespace stampede::research {

const std::vector<ResearchProblem>& all_problems() {
  static const std::vector<ResearchProblem> problems = {
      abstractions_problem(),
      inventions_problem(),
      symbols_problem(),
      concepts_problem(),
      segments_supervised_problem(),
      segments_problem(),
      conditions_supervised_problem(),
      conditions_problem(),
      segments_and_conditions_problem(),
      motions_problem(),
      behaviour_problem(),
      controllers_problem(),
      transfer_problem(),
      rewards_problem(),
      transition_models_problem(),
  };
  return problems;
}

const ResearchProblem& find_problem(std::string_view name) {
  std::vector<std::string> names;
  for (const ResearchProblem& problem : all_problems()) {
    if (problem.name == name) return problem;
    names.push_back(problem.name);
  }
  const std::string meant = did_you_mean(name, names);
  throw Error("problem", "there is no research problem '" + std::string(name) + "'",
              (meant.empty() ? "" : meant + " ") + "`stampede dataset --list` names all");
}

}  // namespace stampede::research
