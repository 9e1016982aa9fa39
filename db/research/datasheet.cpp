#include "db/research/datasheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "db/research/computed_tables.h"

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

// `318 by model, 2 by person`
std::string by_whom(const std::map<std::string, std::int64_t>& counts) {
  std::vector<std::string> words;
  for (const auto& [who, count] : counts) words.push_back(fmt::format("{} by {}", count, who));
  return listed(words);
}

void count(const Catalogue& catalogue, const std::string& select, std::int64_t episode,
           std::map<std::string, std::int64_t>& counts) {
  const Rows rows = catalogue.query(select, {.parameters = {episode}});
  for (std::size_t i = 0; i < rows.size(); ++i) counts[rows.text(i, "who")] += rows.integer(i, "n");
}

std::string episodes_text(const DatasheetFacts& facts) {
  const std::int64_t all = facts.successes + facts.failures;
  const std::string outcomes = fmt::format("Made of {} successful and {} failed", facts.successes, facts.failures);
  if (facts.recorded == 0) return outcomes + " simulated episodes of a robot arm.";
  if (facts.recorded == all) return outcomes + " episodes, all recorded of a real robot arm.";
  return fmt::format("{} episodes of a robot arm: {} simulated, {} recorded of a real one.", outcomes,
                     all - facts.recorded, facts.recorded);
}

std::string people_text(const DatasheetFacts& facts) {
  if (facts.recorded == 0) return "No person is in it, and nothing about one.";
  return std::string("Who made the recordings answers for what they show") +
         (facts.pictures ? ": look for people in their pictures before you pass them on." : ".");
}

std::string origin_text(const DatasheetFacts& facts) {
  const bool simulated = facts.recorded < facts.successes + facts.failures;
  std::string text;
  if (simulated)
    text += fmt::format("Physics and demonstrations by Stampede {} (numerics {}). ", listed(facts.versions),
                        listed(facts.numerics));
  if (facts.recorded > 0)
    text += "What was recorded of a real robot was resampled to frames; what was not measured is NULL. ";
  const bool simulator_alone = facts.labels.size() == 1 && facts.labels.begin()->first == "simulator";
  text += simulator_alone ? "Labels by the simulator as it ran, never by people. "
                          : fmt::format("Labels (segments and facts): {}. ", by_whom(facts.labels));
  text += fmt::format("Sentences: {}. Tries that failed and were undone ({}) are not in it.", by_whom(facts.sentences),
                      facts.tries_undone);
  if (simulated)
    text +=
        " Known weakness: who has the engine and the tasks can make the same episodes again with their labels; a fair "
        "learner does not.";
  return text;
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
    const Rows rows = catalogue.query(
        "SELECT task, outcome, undone, engine_version, numerics, source FROM episodes WHERE episode = ?1",
        {.parameters = {episode.id}});
    tasks.insert(rows.text(0, "task")), versions.insert(rows.text(0, "engine_version"));
    numerics.insert(rows.text(0, "numerics"));
    ++(rows.text(0, "outcome") == "success" ? facts.successes : facts.failures);
    facts.tries_undone += rows.integer(0, "undone");
    facts.pictures = facts.pictures || seen.contains(episode.id);
    facts.recorded += rows.text(0, "source") == "real" ? 1 : 0;
    count(
        catalogue,
        "SELECT labelled_by AS who, count(*) AS n FROM (SELECT labelled_by FROM segments WHERE episode = ?1 UNION ALL "
        "SELECT labelled_by FROM facts WHERE episode = ?1) GROUP BY 1",
        episode.id, facts.labels);
    count(catalogue, "SELECT source AS who, count(*) AS n FROM instructions WHERE episode = ?1 GROUP BY 1", episode.id,
          facts.sentences);
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
      "## What is in it\n{} {} Pictures: {}. {}\n\n`given.db` is a plain SQLite file. Times are frames; lengths m, "
      "angles rad, forces N, quaternions xyzw, spans half-open. Numbers are new and in no order: nothing here names "
      "seed, variation or source of an episode.\n\n{}\n",
      counts_text(problem, report), episodes_text(facts), pictures_text(problem, facts), people_text(facts),
      tables_text(problem.given, problem));
  const bool acts = std::any_of(problem.given.begin(), problem.given.end(), [](const TableUse& use) {
    return use.table() == "instructions" || use.table() == "tasks";
  });
  if (acts) text += fmt::format("Tasks: {}.\n\n", listed(facts.tasks));  // policies are tried in them
  text += fmt::format(
      "## Splits\nRule: `{}`. The column `split` says which: learn from train, choose with validation; what is "
      "scored is test.\n\n{}\n",
      facts.split, facts.leaks);
  text += "## How it was made\n" + origin_text(facts) + "\n\n";
  text += fmt::format(
      "## Answers\n{}\n## How it is scored\n{}\n\n`stampede score {} answers.json --hidden DIR`\n\n"
      "## Licence\n{}.\n",
      answer_text(problem), problem.scoring, problem.name,
      facts.recorded == 0 ? "MIT, as Stampede" : "MIT, as Stampede; of the recordings, what their makers say");
  return text;
}

std::string hidden_sheet(const ResearchProblem& problem, const DatasheetFacts& facts, const DatasetReport& report) {
  std::string text = fmt::format(
      "# {}: hidden part\n\nWhat answers to the data set `{}` are scored against: keep it from learners.\n\n{} Tasks: "
      "{}.\n\n"
      "Split: `{}`.\n\n{}\n",
      problem.name, report.id, counts_text(problem, report), listed(facts.tasks), facts.split,
      tables_text(problem.hidden, problem));
  if (!facts.where.empty()) text += "Of the catalogue's episodes those where `" + facts.where + "`.\n\n";
  if (!facts.held_out.empty()) {
    text += "## Held out of training\n\n| kind | what | after it |\n|---|---|---|\n";
    for (const HeldOut& one : facts.held_out)
      text += fmt::format("| {} | {} | {} |\n", one.kind, one.first, one.second);
    text += "\n";
  }
  text += "## What training shows of it\n" + facts.leaks + "\n";
  text += fmt::format("## How it is scored\n{}\n\n`stampede score {} ANSWERS --hidden DIR`: the folder of this page.\n",
                      problem.scoring, problem.name);
  return text;
}

}  // namespace stampede::research
