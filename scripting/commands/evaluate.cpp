#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <utility>

#include "db/catalogue_writer.h"
#include "db/table_text.h"
#include "engine/base/text.h"
#include "engine/start/perturbation.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/job_request.h"
#include "scripting/commands/picture_options.h"
#include "scripting/commands/policy_options.h"
#include "scripting/commands/symbol_options.h"
#include "scripting/program/json_text.h"
#include "scripting/program/progress.h"
#include "scripting/session/evaluation.h"

namespace stampede::program {
namespace {

// Each part of the list by itself; `all` is every axis.
std::vector<std::string> trials(const Arguments& arguments) {
  if (!arguments.has("--perturb")) return {};
  std::vector<std::string> parts;
  for (const std::string& part : split(arguments.text("--perturb"), ',')) {
    if (part == "all") {
      for (const PerturbationAxis axis : kPerturbationAxes) parts.emplace_back(to_string(axis));
      continue;
    }
    try {
      perturbation_from(part, "--perturb");
    } catch (const Error& error) {
      throw UsageError(error.where() + ": " + error.message(), error.hint());
    }
    parts.push_back(part);
  }
  return parts;
}

std::string reasons_of(const EvaluationRow& row) {
  std::string text;
  for (const auto& [reason, count] : row.reasons)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, reason);
  return text;
}

std::string percent(double share) { return fmt::format("{:.1f}", 100 * share); }

std::string task_name(const EvaluationRow& row) { return row.task.empty() ? "all tasks" : row.task; }

// What was not disturbed, with its axes.
Rows success_table(const std::vector<EvaluationRow>& rows) {
  Rows table;
  table.columns = {"task", "variations", "episodes", "success %", "95 % interval", "mean return", "mean s", "failures"};
  for (const EvaluationRow& row : rows) {
    if (row.perturbation != kUndisturbed) continue;
    table.rows.push_back({task_name(row), row.axis.empty() ? std::string() : row.axis + "=" + row.value, row.episodes,
                          percent(row.success), percent(row.lower) + " … " + percent(row.upper),
                          fmt::format("{:.3f}", row.mean_return), fmt::format("{:.1f}", row.mean_length_s),
                          reasons_of(row)});
  }
  return table;
}

// A row a task, a column a perturbation: success in percent with its interval.
Rows robustness_table(const std::vector<EvaluationRow>& rows) {
  Rows table;
  table.columns = {"success %"};
  for (const EvaluationRow& row : rows) {
    if (!row.axis.empty()) continue;
    const auto column = std::find(table.columns.begin() + 1, table.columns.end(), row.perturbation);
    const auto place = static_cast<std::size_t>(column - table.columns.begin());
    if (column == table.columns.end()) table.columns.push_back(row.perturbation);
    auto line = std::find_if(table.rows.begin(), table.rows.end(), [&](const std::vector<SqlValue>& values) {
      return std::get<std::string>(values[0]) == task_name(row);
    });
    if (line == table.rows.end()) line = table.rows.insert(line, {task_name(row)});
    line->resize(std::max(line->size(), place + 1));
    line->at(place) = fmt::format("{} ({:.0f}-{:.0f})", percent(row.success), 100 * row.lower, 100 * row.upper);
  }
  for (std::vector<SqlValue>& line : table.rows) line.resize(table.columns.size());
  return table;
}

std::string as_json(const Evaluation& evaluation, const std::string& out) {
  JsonText text;
  text.object().field("out", out).field("interrupted", evaluation.interrupted).key("rows").array();
  for (const EvaluationRow& row : evaluation.rows) {
    text.object().field("task", row.task).field("perturbation", row.perturbation);
    text.field("axis", row.axis).field("value", row.value);
    text.field("episodes", row.episodes).field("succeeded", row.succeeded).field("success", row.success);
    text.field("lower", row.lower).field("upper", row.upper);
    text.field("mean_return", row.mean_return).field("mean_length_s", row.mean_length_s).key("reasons").object();
    for (const auto& [reason, count] : row.reasons) text.field(reason, count);
    text.end().end();
  }
  return text.end().end().text();
}

ExitCode do_evaluate(const Arguments& arguments, Console& console) {
  EvaluationSettings settings;
  RunOptions& options = settings.run.options;
  options.split = *split_from(arguments.text("--split"));
  options.observation = picture_choice(arguments, PictureUse::run);
  settings.perturb = trials(arguments);
  const JobRequest request = job_request(arguments, options.split);
  settings.run.workers = workers_of(arguments);
  settings.run.stop = console.stop;
  const std::optional<PolicySettings> acting = policy_settings(arguments, options.observation);
  const auto library = load_library(arguments, request.tasks);
  const JobList jobs(*library, request);
  settings.run.cameras = cameras_by_task(library, jobs, arguments);
  const std::string out = arguments.text("--out");
  Progress progress(console);
  settings.run.progress = [&](const EpisodeRecord& episode, const RunTally& tally) {
    const auto perturb = episode.made.options.find("perturb");
    const std::string trial = perturb == episode.made.options.end() ? "" : perturb->second + ", ";
    progress.update({tally.total, tally.done(), tally.finished, tally.succeeded, 0}, trial + episode_line(episode));
  };
  std::optional<PolicyRun> policy;
  if (acting) {
    settings.run.helpers = std::exchange(settings.run.workers, 1) - 1;  // one program acts
    policy.emplace(*acting, console.stop);
    settings.run.act = [&](PreparedEpisode& prepared) { return policy->act(prepared); };
  }
  const Evaluation evaluation = evaluate(library, jobs, settings, [&] {
    CatalogueWriterOptions writing;
    writing.engine = this_engine();
    writing.queue_bytes = queue_bytes(settings.run);
    return std::make_unique<CatalogueWriter>(out, std::move(writing));
  });
  policy.reset();
  progress.finish();
  if (arguments.flag("--json")) {
    console.out << as_json(evaluation, out);
  } else {
    console.out << to_table(success_table(evaluation.rows));
    if (!settings.perturb.empty()) console.out << "\n" << to_table(robustness_table(evaluation.rows));
  }
  if (!evaluation.interrupted) return kDone;
  console.err << "interrupted: what had ended is in the table and in " << out << "\n";
  return kInterrupted;
}

}  // namespace

CommandRow evaluate_command() {
  CommandRow row{
      "evaluate",
      "Say how often tasks succeed, and how well that stands up to disturbances",
      "Runs episodes of each task with a policy of yours, or with the planner, whose success says what can be done, "
      "and "
      "tells the share of successes with its 95 % interval (Wilson), the mean sum of rewards and the mean length, for "
      "each task and for each value of its variations, and why the others failed. With --perturb the same variations "
      "and seeds are run once more for each axis, one disturbed at a time: layout (three further things stand about), "
      "camera (5 cm and 5 degrees off), start (each joint of the arm up to 0.2 rad elsewhere), sentence (other words), "
      "light, texture, noise (of pictures and joint torques); `camera=2` is twice as much. Every episode is run anew "
      "and stored; `perturb` in column `options` of view `episodes` tells them apart.",
      {{"TASK", "names of tasks", true, true}},
      {{"--perturb",
        "AXES",
        "layout, camera, start, sentence, light, texture, noise, each with =STRENGTH; or all",
        Takes::text,
        "",
        {},
        false},
       {"--episodes",
        "N",
        "episodes per task, and as many for each axis of --perturb",
        Takes::integer,
        "20",
        {},
        false},
       {"--variation", "TEXT", "only this variation, or those with some axes: colour=red", Takes::text, "", {}, false},
       {"--seed", "S", "the first seed; default: 1000000, or 0 in the train split", Takes::integer, "", {}, false},
       {"--split", "NAME", "seeds from 1000000 up are the test split's", Takes::text, "test", {"train", "test"}, false},
       {"--workers", "W", "cores to use, default: all; they do not change the answer", Takes::integer, "", {}, false},
       {"--out", "FILE", "the catalogue", Takes::path, "evaluation.db", {}, false},
       {"--shard",
        "I/N",
        "only the I-th of N parts, each into a file of its own: `query` asks them as one, by success_by_perturbation",
        Takes::text,
        "",
        {},
        false}},
      {"stampede evaluate reach_target --policy \"sh policy.sh\" --observe gripper_pose,object_pose",
       "stampede evaluate pick_and_lift stack_blocks --episodes 50 --workers 2",
       "stampede evaluate push_buttons --perturb layout,start=2,noise --json",
       "stampede evaluate push_buttons --perturb all --shard 1/8 --out part1.db"},
      do_evaluate};
  add_options(row.options, policy_options());
  for (OptionRow& option : picture_options(PictureUse::run)) row.options.push_back(std::move(option));
  return row;
}

}  // namespace stampede::program
