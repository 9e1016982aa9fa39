#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "db/research/arm_joints.h"
#include "db/research/check_dataset.h"
#include "db/research/dataset.h"
#include "db/research/scorer.h"
#include "db/research/scorers/functions.h"
#include "engine/base/error.h"

namespace stampede::research {
namespace {

const char* number_column(const ResearchProblem& problem) { return problem.unit == Unit::piece ? "piece" : "episode"; }

std::vector<std::int64_t> test_units(const PlainFile& hidden, const std::string& unit) {
  const Rows rows = hidden.query("SELECT " + unit + " AS number FROM " + unit + "s WHERE split = 'test' ORDER BY 1");
  std::vector<std::int64_t> units;
  for (std::size_t i = 0; i < rows.size(); ++i) units.push_back(rows.integer(i, "number"));
  return units;
}

void check_identity(const Answers& answers, const ResearchProblem& problem, const std::string& id) {
  if (answers.dataset.empty())
    throw Error(answers.where, "it does not say which data set it answers",
                "put \"dataset\": \"" + id + "\" into it (CSV: a first line `# dataset: " + id + "`)");
  if (answers.dataset != id)
    throw Error(answers.where, "these are answers for another data set: " + answers.dataset + ", not " + id,
                "name the hidden folder that was made with the given part they answer");
  if (!answers.problem.empty() && answers.problem != problem.name)
    throw Error(answers.where, "these are answers to " + answers.problem + ", and the data set is of " + problem.name);
}

// Every unit that rows name is in the data set, and of the test split each is named.
void check_units(const Answers& answers, const ResearchProblem& problem, const PlainFile& hidden,
                 const std::vector<std::int64_t>& tests) {
  if (problem.answer.empty()) return;
  const std::string unit = number_column(problem);
  const Rows rows = hidden.query("SELECT " + unit + " AS number FROM " + unit + "s");
  std::set<std::int64_t> all, answered;
  for (std::size_t i = 0; i < rows.size(); ++i) all.insert(rows.integer(i, "number"));
  for (std::size_t i = 0; i < answers.rows.size(); ++i) {
    const std::int64_t number = answers.rows.integer(i, unit);
    if (!all.contains(number))
      throw Error(answers.where + ", answer " + std::to_string(i + 1),
                  "the data set has no " + unit + " " + std::to_string(number),
                  "its numbers are 1 to " + std::to_string(all.size()));
    answered.insert(number);
  }
  if (!problem.every_unit) return;
  std::vector<std::int64_t> missing;
  std::copy_if(tests.begin(), tests.end(), std::back_inserter(missing),
               [&](std::int64_t number) { return !answered.contains(number); });
  if (!missing.empty())
    throw Error(answers.where,
                "there is no answer for " + std::to_string(missing.size()) + " of the " + std::to_string(tests.size()) +
                    " " + unit + "s of the test split, the first: " + std::to_string(missing.front()),
                "answer each of `SELECT " + unit + " FROM " + unit + "s WHERE split = 'test'`");
}

void check_texts(const Answers& answers, const ResearchProblem& problem) {
  for (const AnswerColumn& column : problem.answer_texts)
    if (!column.optional && !answers.texts.contains(column.name))
      throw Error(answers.where, "'" + column.name + "' is missing", "it is: " + column.about);
  for (const auto& [name, text] : answers.texts)
    if (std::none_of(problem.answer_texts.begin(), problem.answer_texts.end(),
                     [&, &wanted = name](const AnswerColumn& column) { return column.name == wanted; }))
      throw Error(answers.where, "there is no field '" + name + "'", "compare it with answers.example.json");
}

}  // namespace

const std::vector<Scorer>& all_scorers() {
  static const std::vector<Scorer> scorers = {
      {"segments", "boundaries and labels of segments", score_segments},
      {"facts", "named predicates", score_facts},
      {"symbols", "learned symbols, matched with predicates", score_symbols},
      {"clusters", "names of pieces", score_clusters},
      {"actions", "what to command", score_actions},
      {"rewards", "values of frames", score_rewards},
      {"predictions", "positions to come", score_predictions},
      {"operators", "literals of operators, calls that they allow, plans made with them", score_operators},
      {"segments_and_operators", "both", score_segments_and_operators},
      {"abstractions", "predicates and operators of one's own, by what they mean", score_abstractions},
  };
  return scorers;
}

bool draws_timelines(const ResearchProblem& problem) {
  const bool joints = std::any_of(problem.hidden.begin(), problem.hidden.end(),
                                  [](const TableUse& use) { return use.table() == "joints"; });
  return joints && problem.scorer.starts_with("segments");
}

bool makes_plans(const ResearchProblem& problem) { return !problem.answer_texts.empty(); }  // a domain

Scored score(const std::filesystem::path& answers_file, const std::filesystem::path& hidden_folder,
             const ScoreOptions& options) {
  const PlainFile hidden = open_dataset(hidden_folder / kHiddenFile);
  const std::string id = dataset_id(hidden);
  const ResearchProblem problem = with_arm_joints(find_problem(dataset_problem(hidden)), arm_joints_of(hidden));
  const Answers answers = read_answers(answers_file, problem);
  check_identity(answers, problem, id);
  check_texts(answers, problem);
  const std::vector<std::int64_t> tests = test_units(hidden, number_column(problem));
  check_units(answers, problem, hidden, tests);
  for (const Scorer& scorer : all_scorers()) {
    if (scorer.name != problem.scorer) continue;
    Scored scored{id, problem.name, static_cast<std::int64_t>(tests.size()), {}};
    scored.figures = fitting(hidden, [&] { return scorer.score({problem, answers, hidden, tests, options}); });
    for (const Figure& figure : scored.figures)
      if (!std::isfinite(figure.value)) throw Error(answers.where, "its " + figure.name + " is not a finite number");
    return scored;
  }
  throw Error("problem", "nothing scores " + problem.name + " yet");
}

}  // namespace stampede::research
