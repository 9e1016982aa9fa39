#include <fmt/format.h>

#include <ostream>

#include "db/research/dataset.h"
#include "db/research/scorer.h"
#include "db/research/timeline_svg.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/held_out_runs.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

std::string score_json(const research::Scored& scored, const std::string& answers) {
  JsonText json;
  json.object().field("problem", scored.problem).field("dataset", scored.dataset).field("answers", answers);
  json.field("scored", scored.units).key("figures").array();
  for (const research::Figure& figure : scored.figures)
    json.object()
        .field("name", figure.name)
        .field("value", figure.value)
        .field("about", figure.about)
        .field("better", figure.higher_is_better ? "higher" : "lower")
        .end();
  return json.end().end().text();
}

std::string problems_that(bool (*can)(const research::ResearchProblem&)) {
  std::string names;
  for (const research::ResearchProblem& problem : research::all_problems())
    if (can(problem)) names += (names.empty() ? "" : ", ") + problem.name;
  return names;
}

// An option that would do nothing is a mistake.
void refuse_idle(const Arguments& arguments, const research::ResearchProblem& problem, std::int64_t physics) {
  if (arguments.has("--figure") && !research::draws_timelines(problem))
    throw UsageError("there is no figure of " + problem.name,
                     "--figure is for " + problems_that(research::draws_timelines));
  if (arguments.has("--episode") && !arguments.has("--figure"))
    throw UsageError("--episode without --figure", "it says which episode is drawn");
  if (physics > 0 && !research::makes_plans(problem))
    throw UsageError("there are no plans of " + problem.name + " to run in physics",
                     "--physics is for " + problems_that(research::makes_plans));
}

ExitCode do_score(const Arguments& arguments, Console& console) {
  const research::ResearchProblem& problem = research::find_problem(arguments.text("PROBLEM"));
  const std::string answers = arguments.text("ANSWERS"), hidden = arguments.text("--hidden");
  if (hidden.empty())
    throw UsageError("stampede score needs --hidden DIR", "the folder that `stampede dataset --hidden` made");
  const std::int64_t physics = in_range(arguments, "--physics", 0, kMostEpisodes);
  refuse_idle(arguments, problem, physics);
  const std::string found =
      research::dataset_problem(PlainFile::open(std::filesystem::path(hidden) / research::kHiddenFile));
  if (found != problem.name)
    throw Error(hidden, "this is a data set of " + found + ", not of " + problem.name,
                "name the problem or the folder that fits");
  research::ScoreOptions options;
  options.run = [roots = roots_of(arguments), workers = workers_of(arguments)](const auto& episodes,
                                                                               const auto& planner) {
    return run_in_physics(episodes, roots, workers, planner);
  };
  options.physics = physics;
  options.figure = arguments.text("--figure");
  const OutputRules rules = options.rules = output_rules(arguments, console);
  const OutputKind kind = marked_kind("a score", "{\n  \"problem\":", "\"scored\":");
  if (arguments.has("--out")) check_output(arguments.text("--out"), kind, rules);
  if (arguments.has("--figure")) check_output(options.figure, research::figure_kind(), rules);
  if (arguments.has("--episode")) options.figure_episode = in_range(arguments, "--episode", 1, kMostEpisodes);
  const research::Scored scored = research::score(answers, hidden, options);
  const std::string json = score_json(scored, answers);
  if (arguments.has("--out")) {
    OutputFile file(arguments.text("--out"), kind, rules);
    file.write(json);
    file.finish();
  }
  if (arguments.flag("--json")) {
    console.out << json;
    return kDone;
  }
  console.out << fmt::format("{} {}: {} scored\n", scored.problem, scored.dataset, scored.units);
  for (const research::Figure& figure : scored.figures)
    console.out << fmt::format("{:24} {:9.4f}{}  {}\n", figure.name, figure.value, figure.higher_is_better ? " " : "v",
                               figure.about);
  return kDone;
}

}  // namespace

CommandRow score_command() {
  return {
      "score",
      "Score answers to a research problem",
      "Against the hidden part of the data set that they answer. Answers are JSON or CSV, as the given part's page "
      "says; answers for another data set, missing ones and numbers that are none are refused (exit code 3). Of "
      "figures marked v less is better.",
      {{"PROBLEM", "which; `stampede dataset --list` names all", true, false},
       {"ANSWERS", "the file with answers", true, false}},
      {{"--hidden", "DIR", "the hidden part", Takes::path, "", {}, false},
       {"--out", "FILE", "write the figures there too, as JSON", Takes::output, "", {}, false},
       {"--figure",
        "FILE",
        "draw an episode's timeline there, as SVG; for segments, segments_supervised, segments_and_conditions",
        Takes::output,
        "",
        {},
        false},
       {"--episode",
        "N",
        "of the figure: an episode of the test split, instead of its first",
        Takes::integer,
        "",
        {},
        false},
       {"--physics",
        "N",
        "where the answer has a domain (conditions, inventions, abstractions …): run at most N of its plans in physics",
        Takes::integer,
        "0",
        {},
        false},
       {"--workers", "W", "threads, instead of one a core", Takes::integer, "", {}, false}},
      {"stampede score segments answers.json --hidden hidden",
       "stampede score segments answers.json --hidden hidden --figure timeline.svg"},
      do_score};
}

}  // namespace stampede::program
