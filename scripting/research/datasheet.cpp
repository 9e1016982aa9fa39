#include "scripting/research/datasheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scripting/research/computed_tables.h"

namespace stampede::research {
namespace {

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? "–" : text;
}

const char* type_name(AnswerType type) {
  return type == AnswerType::integer ? "integer" : type == AnswerType::real ? "real" : "text";
}

std::string tables_text(const std::vector<TableUse>& uses, const ResearchProblem& problem) {
  const std::string unit = problem.unit == Unit::piece ? "piece" : "episode";
  std::string text = fmt::format(
      "| table | of | what |\n|---|---|---|\n| `{0}s` | all | number, split (train, validation or "
      "test), frames, frames a second |\n| `dataset` | – | id, problem and split |\n",
      unit);
  for (const TableUse& use : uses) {
    const char* part = use.part == Part::all ? "all" : use.part == Part::train ? "train, validation" : "test";
    text += fmt::format("| `{}` | {} | {} |\n", use.table(), part, describe_table(use.select));
  }
  return text;
}

std::string answer_text(const ResearchProblem& problem) {
  std::string text =
      "JSON (`answers.example.json`) or, where there are rows alone, CSV whose first line is `# dataset: ID`, "
      "then a header.\n\n| column | type | what |\n|---|---|---|\n";
  for (const AnswerColumn& column : problem.answer)
    text += fmt::format("| `{}` | {}{} | {} |\n", column.name, type_name(column.type),
                        column.optional ? ", optional" : "", column.about);
  for (const AnswerColumn& column : problem.answer_texts)
    text += fmt::format("| `{}`, beside the rows | {} | {} |\n", column.name, type_name(column.type), column.about);
  if (problem.every_unit)
    text += "\nEvery one of the test split must be answered; answers for others are not looked at.\n";
  return text;
}

std::string counts_text(const ResearchProblem& problem, const DatasetReport& report) {
  return fmt::format("{} {}s: {} train, {} validation, {} test.", report.train + report.validation + report.test,
                     problem.unit == Unit::piece ? "piece" : "episode", report.train, report.validation, report.test);
}

const char* pictures_text(const ResearchProblem& problem, const DatasheetFacts& facts) {
  if (std::none_of(problem.given.begin(), problem.given.end(),
                   [](const TableUse& use) { return use.table() == "images"; }))
    return "not of this problem";
  if (!facts.pictures) return "none (they are of catalogues made with `stampede run --images all` or `keyframes`)";
  return "yes, in table `images`";
}

}  // namespace

DatasheetFacts datasheet_facts(const Catalogue& catalogue, const std::vector<SplitEpisode>& episodes,
                               const Split& split, const SplitRule& rule) {
  DatasheetFacts facts;
  facts.split = rule.text();
  facts.held_out = split.held_out;
  std::set<std::string> tasks, versions, numerics;
  const auto pictures = catalogue.query("SELECT DISTINCT episode FROM images");
  std::set<std::int64_t> seen;
  for (std::size_t i = 0; i < pictures.size(); ++i) seen.insert(pictures.integer(i, "episode"));
  for (const SplitEpisode& episode : episodes) {
    const Rows rows =
        catalogue.query("SELECT task, outcome, undone, engine_version, numerics FROM episodes WHERE episode = ?1",
                        {.parameters = {episode.id}});
    tasks.insert(rows.text(0, "task")), versions.insert(rows.text(0, "engine_version"));
    numerics.insert(rows.text(0, "numerics"));
    ++(rows.text(0, "outcome") == "success" ? facts.successes : facts.failures);
    facts.tries_undone += rows.integer(0, "undone");
    facts.pictures = facts.pictures || seen.contains(episode.id);
  }
  facts.tasks.assign(tasks.begin(), tasks.end());
  facts.versions.assign(versions.begin(), versions.end());
  facts.numerics.assign(numerics.begin(), numerics.end());
  return facts;
}

std::string given_sheet(const ResearchProblem& problem, const DatasheetFacts& facts, const DatasetReport& report) {
  std::string text = fmt::format("# {}: {}\n\nThe given part of a data set of Stampede. Id: `{}`.\n\n", problem.name,
                                 problem.title, report.id);
  text += fmt::format(
      "## Why\nFor research on **{}**. Learners read this folder alone; what they are scored against is in the "
      "hidden part, which is kept from them.\n\n",
      problem.serves);
  text += fmt::format(
      "## What is in it\n{} Made of {} successful and {} failed simulated episodes of a robot arm. Pictures: {}. No "
      "person "
      "is in it, and nothing about one.\n\n`given.db` is a plain SQLite file. Times are frames; lengths m, angles rad, "
      "forces "
      "N, quaternions xyzw, spans half-open. Numbers are new and in no order: nothing here names seed, variation or "
      "source of "
      "an episode.\n\n{}\n",
      counts_text(problem, report), facts.successes, facts.failures, pictures_text(problem, facts),
      tables_text(problem.given, problem));
  const bool acts = std::any_of(problem.given.begin(), problem.given.end(), [](const TableUse& use) {
    return use.table() == "instructions" || use.table() == "tasks";
  });
  if (acts) text += fmt::format("Tasks: {}.\n\n", listed(facts.tasks));  // policies are tried in them
  text += fmt::format(
      "## Splits\nRule: `{}`. The column `split` says which: learn from train, choose with validation; what is "
      "scored is test.\n\n",
      facts.split);
  text += fmt::format(
      "## How it was made\nPhysics and demonstrations by Stampede {} (numerics {}), labels by the simulator "
      "as it ran, never by people. Tries that failed and were undone ({}) are not in it. Known weakness: "
      "who has the engine and the tasks can make the same episodes again with their labels; a fair learner "
      "does not.\n\n",
      listed(facts.versions), listed(facts.numerics), facts.tries_undone);
  text += fmt::format(
      "## Answers\n{}\n## How it is scored\n{}\n\n`stampede score {} answers.json --hidden DIR`\n\n"
      "## Licence\nMIT, as Stampede.\n",
      answer_text(problem), problem.scoring, problem.name);
  return text;
}

std::string hidden_sheet(const ResearchProblem& problem, const DatasheetFacts& facts, const DatasetReport& report) {
  std::string text = fmt::format(
      "# {}: hidden part\n\nWhat answers to the data set `{}` are scored against: keep it from learners.\n\n{} Tasks: "
      "{}.\n\n"
      "Split: `{}`.\n\n{}\n",
      problem.name, report.id, counts_text(problem, report), listed(facts.tasks), facts.split,
      tables_text(problem.hidden, problem));
  if (!facts.held_out.empty()) {
    text += "## Held out of training\n\n| kind | what | after it |\n|---|---|---|\n";
    for (const HeldOut& one : facts.held_out)
      text += fmt::format("| {} | {} | {} |\n", one.kind, one.first, one.second);
    text += "\n";
  }
  text += fmt::format("## How it is scored\n{}\n\n`stampede score {} ANSWERS --hidden DIR`: the folder of this page.\n",
                      problem.scoring, problem.name);
  return text;
}

}  // namespace stampede::research
