#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include "db/table_text.h"
#include "scripting/commands/check_built.h"
#include "scripting/commands/check_failures.h"
#include "scripting/commands/commands.h"
#include "scripting/program/json_text.h"
#include "scripting/program/progress.h"
#include "scripting/runtime/episode_scripts.h"
#include "scripting/sentences/sentence_file.h"
#include "scripting/session/run_job.h"

namespace stampede::program {
namespace {

// How many variations of a task are built: all that a person would wait for.
constexpr std::size_t kBuiltOfNamed = 240, kBuiltOfAll = 2;

// All files of these names, also those with mistakes.
std::vector<const ScriptFile*> named_files(const Library& library, const std::vector<std::string>& names) {
  std::vector<const ScriptFile*> files = library.all_files();
  for (const ScriptFile& file : library.left_out()) files.push_back(&file);
  if (names.empty()) return files;
  std::erase_if(files, [&](const ScriptFile* file) { return std::ranges::find(names, file->name) == names.end(); });
  return files;
}

// NAMES given: only complaints about these files, about what they use, and about no file at all.
std::vector<Error> wanted_complaints(const Library& library, const std::vector<Error>& all,
                                     const std::vector<std::string>& names,
                                     const std::vector<const ScriptFile*>& used) {
  if (names.empty()) return all;
  const std::vector<const ScriptFile*> known = named_files(library, {});
  const auto about = [](const std::vector<const ScriptFile*>& files, const Error& error) {
    return std::any_of(files.begin(), files.end(), [&](const ScriptFile* file) { return is_about(error, *file); });
  };
  std::vector<Error> wanted;
  for (const Error& error : all) {
    bool meant = about(used, error) || !about(known, error);
    for (const std::string& name : names) meant = meant || error.where().find("/" + name + ".lua") != std::string::npos;
    if (meant) wanted.push_back(error);
  }
  return wanted;
}

void check_names(const Library& library, const std::vector<std::string>& names, const std::vector<Error>& complaints) {
  for (const std::string& name : names) {
    bool known = false;
    for (const ScriptFile* file : library.all_files()) known = known || file->name == name;
    for (const Error& error : complaints) known = known || error.where().find("/" + name + ".lua") != std::string::npos;
    if (!known) throw UsageError("there is no file of the name '" + name + "'", "stampede list names what there is");
  }
}

void print_complaints(const std::vector<Error>& complaints, std::size_t files, bool json, Console& console) {
  if (json) {
    JsonText text;
    text.object().field("files", static_cast<std::int64_t>(files)).key("errors").array();
    for (const Error& error : complaints) {
      text.object().field("where", error.where()).field("message", error.message()).field("hint", error.hint()).end();
    }
    console.out << text.end().end().text();
    return;
  }
  for (const Error& error : complaints) console.out << error.what() << "\n";
  console.out << fmt::format("{} file{}, {} mistake{}\n", files, files == 1 ? "" : "s", complaints.size(),
                             complaints.size() == 1 ? "" : "s");
}

std::vector<std::string> tasks_to_run(const Library& library, const std::vector<std::string>& names) {
  std::vector<std::string> tasks;
  for (const ScriptFile* file : library.files(DefinitionKind::task)) {
    if (names.empty() || std::find(names.begin(), names.end(), file->name) != names.end()) tasks.push_back(file->name);
  }
  return tasks;
}

// What was seen of one variation.
struct Seen {
  std::int64_t episodes = 0, succeeded = 0, undone = 0;
  double simulated_s = 0;
  std::map<std::string, std::pair<double, std::int64_t>> skills;  // seconds and number of kept segments
  std::map<std::string, std::int64_t> reasons;                    // of failed episodes and undone tries

  void add(const EpisodeRecord& episode) {
    ++episodes;
    succeeded += episode.outcome == Outcome::success;
    undone += static_cast<std::int64_t>(episode.labels.attempts.size());
    simulated_s += episode.duration_s();
    for (const SegmentRecord& segment : episode.labels.segments) {
      if (segment.kind != SegmentKind::skill) continue;
      auto& [seconds, count] = skills[segment.skill];
      seconds += static_cast<double>(segment.span.end_step - segment.span.start_step) / episode.physics_hz;
      ++count;
    }
    for (const AttemptRecord& attempt : episode.labels.attempts)
      if (attempt.segment.reason != Reason::none) ++reasons[std::string(to_string(attempt.segment.reason))];
    if (episode.reason != Reason::none) ++reasons[std::string(to_string(episode.reason))];
  }

  SqlValue slowest_step() const {  // `place 3.1 s`
    const auto mean = [](const auto& one) { return one.second.first / static_cast<double>(one.second.second); };
    const auto slowest =
        std::max_element(skills.begin(), skills.end(), [&](const auto& a, const auto& b) { return mean(a) < mean(b); });
    if (slowest == skills.end()) return std::monostate{};
    return fmt::format("{} {:.1f} s", slowest->first, mean(*slowest));
  }
  SqlValue commonest_reason() const {  // `no_grasp 4`
    const auto most = std::max_element(reasons.begin(), reasons.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == reasons.end()) return std::monostate{};
    return fmt::format("{} {}", most->first, most->second);
  }
};

using SeenVariations = std::map<std::pair<std::string, std::string>, Seen>;

QueryResult table_of(const SeenVariations& variations) {
  QueryResult table;
  table.columns = {"task",   "variation",     "episodes",     "success_percent",
                   "undone", "mean_length_s", "slowest_step", "commonest_failure"};
  for (const auto& [name, seen] : variations) {
    const auto count = static_cast<double>(seen.episodes);
    table.rows.push_back({name.first, name.second, seen.episodes, 100.0 * static_cast<double>(seen.succeeded) / count,
                          seen.undone, std::round(10 * seen.simulated_s / count) / 10, seen.slowest_step(),
                          seen.commonest_reason()});
  }
  return table;
}

ExitCode check_physics(std::shared_ptr<const Library> library, const Arguments& arguments, Console& console) {
  const std::vector<std::string> tasks = tasks_to_run(*library, arguments.list("NAMES"));
  JobRequest request{tasks, in_range(arguments, "--episodes", 1, kMostEpisodes),
                     in_range(arguments, "--seed", 0, kLargestSeed), ""};
  RunSettings settings;
  settings.workers = workers_of(arguments);
  settings.stop = console.stop;
  const std::string pictures = arguments.text("--pictures");
  const bool why = arguments.flag("--why") || !pictures.empty();
  FailedSteps failed_steps;
  settings.options.services.explain = why;
  if (why) settings.options.services.witness = [&](const Impasse& impasse) { failed_steps.add(impasse); };
  if (arguments.flag("--randomise")) settings.options.randomise = default_randomisation();
  settings.options.observation.images = WhichFrames::none;  // nobody would see them
  Progress progress(console);
  std::vector<std::string> failures;
  SeenVariations seen;
  settings.progress = [&](const EpisodeRecord& episode, const RunTally& tally) {
    const bool good = episode.outcome == Outcome::success;
    const std::string line = fmt::format("{} {} seed {}: {}", episode.task, episode.variation, episode.seed,
                                         good ? "success" : to_string(episode.reason));
    seen[{episode.task, episode.variation}].add(episode);
    if (why) failed_steps.add(episode);
    if (!good) failures.push_back(line + (episode.detail.empty() ? "" : ": " + episode.detail));
    progress.update({tally.total, tally.done(), tally.finished, tally.succeeded, 0}, line);
  };
  const RunTally tally = run_jobs(library, JobList(*library, request), settings, nullptr);
  progress.finish();
  for (const std::string& failure : failures) console.err << failure << "\n";
  if (!pictures.empty()) failed_steps.draw(pictures, output_rules(arguments, console));
  if (why) console.err << to_table(failed_steps.table());
  console.out << (arguments.flag("--json") ? to_json(table_of(seen)) : to_table(table_of(seen)));
  return tally.succeeded == tally.total ? kDone : kNo;
}

// Files of sentences beside tasks; only a sound library says what they have to mean.
std::vector<Error> sentence_mistakes(const std::shared_ptr<const Library>& library,
                                     const std::vector<std::string>& names) {
  std::vector<Error> mistakes;
  for (const std::filesystem::path& root : library->roots().folders) {
    std::vector<std::filesystem::path> files;
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator(root / "tasks", code))
      if (entry.path().filename().string().ends_with(".sentences.json")) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& file : files) {
      const std::string task = file.stem().stem().string(), shown = "tasks/" + file.filename().string();
      if (!names.empty() && std::find(names.begin(), names.end(), task) == names.end()) continue;
      try {
        SentenceFile read = read_sentence_file(file, shown);
        if (read.task != task)
          throw Error(shown + ":1", "it is of task '" + read.task + "'",
                      "call it tasks/" + read.task + ".sentences.json");
        for (Error& one : mistakes_in(read, shown, library)) mistakes.push_back(std::move(one));
      } catch (const Error& error) {
        mistakes.push_back(error);
      }
    }
  }
  return mistakes;
}

ExitCode do_check(const Arguments& arguments, Console& console) {
  std::vector<Error> all;
  const std::vector<std::string>& names = arguments.list("NAMES");
  auto library = Library::check(roots_of(arguments), all, names);
  check_names(*library, names, all);
  std::vector<Error> shared;  // mistakes in what all files share
  try {
    if (!all.empty()) library = load_library(arguments);
  } catch (const LibraryError& errors) {
    shared = errors.errors();
  }
  std::vector<const ScriptFile*> used;
  if (!names.empty()) used = library->used_by(named_files(*library, names));
  std::vector<Error> complaints = wanted_complaints(*library, all, names, used);
  if (!shared.empty() && !names.empty()) complaints = shared;  // as a run says
  if (shared.empty()) {
    BuiltCheck built{named_files(*library, names), names.empty() ? kBuiltOfAll : kBuiltOfNamed, console.stop};
    std::erase_if(built.files, [&](const ScriptFile* file) { return library->file(file->kind, file->name) != file; });
    if (!names.empty())
      for (const ScriptFile* skill : library->files(DefinitionKind::skill)) used.push_back(skill);  // any plan's
    std::vector<Error> remarks = wanted_complaints(*library, library->remarks(), names, used);
    for (Error& remark : check_built(library, built, complaints)) remarks.push_back(std::move(remark));
    for (const Error& remark : remarks) console.err << remark.what() << "\n";
    if (!names.empty()) tell_left_out(*library, used, console);
  }
  if (complaints.empty()) complaints = sentence_mistakes(library, names);
  const bool physics = arguments.flag("--physics");
  if (!physics || !complaints.empty()) {
    const std::size_t files = names.empty() ? library->all_files().size() : names.size();
    print_complaints(complaints, files, arguments.flag("--json"), console);
  }
  if (!complaints.empty()) return kBadInput;
  return physics ? check_physics(library, arguments, console) : kDone;
}

}  // namespace

CommandRow check_command() {
  return {
      "check",
      "Check scripts, and with --physics that tasks can be done",
      "Reads every file, builds every object, robot, world and task as a run would, and reports every mistake at once, "
      "each with its place, the complaint and the cure; remarks on what is no mistake go to stderr. With NAMES only "
      "what these files use counts, and tasks are built in all their variations, up to 240. "
      "With --physics it settles the start of each task, verifies that init holds and the goal does not, plans, "
      "runs, and prints for each variation that was met: the success rate, undone tries, the mean length, the slowest "
      "step, and the commonest reason why a try or an episode failed. With --why it also tells how often each step "
      "failed, undone tries included, and of what: how many grasps and places were out of reach or touched what, and "
      "how near the nearest of them came. With --pictures it draws them too: one picture a step that found no grasp, "
      "place or start, as ghosts of the hand or of the object in the scene of that moment; red ones touch something, "
      "grey ones are out of reach, orange ones fail otherwise, green ones would do.",
      {{"NAMES", "names of files; default: all", false, true}},
      {{"--physics", "", "run the tasks too", Takes::flag, "", {}, false},
       {"--why",
        "",
        "with --physics: of each failed step the causes, counted, and the nearest miss",
        Takes::flag,
        "",
        {},
        false},
       {"--pictures",
        "DIR",
        "with --physics: --why, and pictures of what was turned down into DIR (PNG)",
        Takes::output,
        "",
        {},
        false},
       {"--episodes", "N", "episodes per task with --physics", Takes::integer, "10", {}, false},
       {"--seed", "S", "the first seed", Takes::integer, "0", {}, false},
       {"--randomise", "", "with drawn looks, light and dynamics, as `run --randomise`", Takes::flag, "", {}, false},
       {"--workers", "W", "cores to use, default: all", Takes::integer, "", {}, false}},
      {"stampede check", "stampede check stack_blocks --physics --episodes 20",
       "stampede check stack_blocks --physics --episodes 1 --pictures why"},
      do_check};
}

}  // namespace stampede::program
