#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <sstream>

#include "db/catalogue_writer.h"
#include "engine/base/names.h"
#include "engine/base/naming.h"
#include "engine/base/nearest.h"
#include "engine/base/temporary_folder.h"
#include "engine/base/text_file.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/import_kinds.h"
#include "scripting/library/editor_files.h"
#include "scripting/program/json_text.h"
#include "scripting/program/progress.h"
#include "scripting/runtime/bddl_mapping_reader.h"
#include "scripting/session/bddl_task_file.h"
#include "scripting/session/episode_job.h"
#include "scripting/session/run_job.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

struct Judged {
  std::int64_t seed = 0;
  Outcome outcome = Outcome::failure;
  std::string reason;
  VerdictRecord verdict;
};

// The scene of any task of that world: what stands there whatever the task.
Scene scene_of_world(const std::shared_ptr<const Library>& library, const std::string& world) {
  for (const ScriptFile* file : library->files(DefinitionKind::task)) {
    const Library::TaskInfo& task = task_info(*library, file->name);
    if (task.world == world) return EpisodeScripts(library, task.name, task.variation_texts.at(0), 0).task()(0).scene;
  }
  throw Error("--world", "no task takes place in a world '" + world + "'",
              did_you_mean(world, names_of(library->files(DefinitionKind::world))));
}

struct NewFile {
  fs::path inside;  // its root
  std::string text;
};

struct Source {
  BddlReading reading;
  NamedMapping mapping;
  std::vector<NewFile> files;  // of a mapping that is in no root yet
};

std::string task_name(const Arguments& arguments, const BddlProblem& problem) {
  if (!arguments.has("--task")) return proposed_name(problem.name);
  const std::string name = arguments.text("--task");
  if (const auto fault = name_fault(name))
    throw UsageError("'" + name + "' cannot be a name: it " + *fault, "take " + proposed_name(name));
  return name;
}

// A mapping from elsewhere goes to worlds/bddl beside the task, under the task's name.
Source read_source(const Arguments& arguments, BddlReading reading, const Library& library, const std::string& name) {
  Source source{std::move(reading), {}, {}};
  if (arguments.has("--mapping")) {
    const std::string file = arguments.text("--mapping");
    source.mapping.mapping = read_bddl_mapping(library, file);
    source.mapping.file = file;
    if (library.module("worlds.bddl." + file) == nullptr) {
      source.mapping.file = name;
      source.files.push_back({fs::path("worlds/bddl") / (name + ".lua"), read_text_file(file)});
    }
  } else {
    source.mapping.mapping = bddl_mapping_of(library, source.reading.problem.dialect);
  }
  source.mapping.mapping.add_namesakes(source.reading.problem, [&](const std::string& class_name) {
    return library.file(DefinitionKind::object, class_name) != nullptr;
  });
  return source;
}

std::string line_at(const std::string& text, int line) {
  std::istringstream lines(text);
  std::string found;
  for (int i = 0; i < line && std::getline(lines, found); ++i) {
  }
  found.erase(0, found.find_first_not_of(' '));
  return found.size() > 100 ? found.substr(0, 100) + "…" : found;
}

// What `stampede check` would say of the task beside all other files, before any of them is written.
std::string checker_says(const Arguments& arguments, const std::string& task, const std::vector<NewFile>& files) {
  const TemporaryFolder scratch;
  Roots roots = roots_of(arguments);
  roots.folders.push_back(scratch.path());
  for (const NewFile& file : files) write_text_file(scratch.path() / file.inside, file.text);
  std::vector<Error> mistakes;
  Library::check(roots, mistakes, {task});
  for (const Error& mistake : mistakes)
    for (const NewFile& file : files) {
      if (!mistake.where().starts_with(file.inside.generic_string())) continue;
      const std::string line = mistake.where().substr(file.inside.generic_string().size());
      const std::string text = line.empty() ? "" : line_at(file.text, std::atoi(line.c_str() + 1));
      return mistake.message() + (text.empty() ? "" : ", in `" + text + "`") +
             (mistake.hint().empty() ? "" : "; " + mistake.hint());
    }
  return {};
}

// Writes the files and loads the task with what it needs; where that has mistakes they do not stay.
std::shared_ptr<const Library> library_with(const Arguments& arguments, const fs::path& root,
                                            const std::vector<NewFile>& files, const std::string& task) {
  std::error_code code;
  for (const NewFile& file : files)
    if (fs::exists(root / file.inside, code) && !holds_text(root / file.inside, file.text))
      throw UsageError("'" + (root / file.inside).string() + "' exists already and is another", "take another --task");
  std::vector<fs::path> written;
  for (const NewFile& file : files) {
    if (fs::exists(root / file.inside, code)) continue;
    write_text_file(root / file.inside, file.text);
    written.push_back(root / file.inside);
  }
  try {
    auto library = load_library(arguments, {task});
    task_info(*library, task);
    return library;
  } catch (const Error&) {
    for (const fs::path& path : written) fs::remove(path, code);
    throw;
  }
}

std::vector<Judged> run_task(const Arguments& arguments, const std::shared_ptr<const Library>& library,
                             const std::string& name, Console& console, bool& interrupted) {
  std::vector<Judged> judged;
  JobRequest request;
  request.tasks = {name};
  request.episodes = in_range(arguments, "--episodes", 0, kMostEpisodes);
  request.first_seed = in_range(arguments, "--seed", 0, kLargestSeed);
  if (request.episodes == 0) return judged;
  check_split(Split::train, request.first_seed, request.first_seed + request.episodes - 1);
  RunSettings settings;
  settings.stop = console.stop;
  CatalogueWriterOptions writing;
  writing.engine = this_engine();
  const std::string out = arguments.text("--out");
  {
    CatalogueWriter writer(out, std::move(writing));
    const RunTally tally = run_jobs(library, JobList(*library, request), settings, &writer);
    writer.finish();
    interrupted = tally.interrupted;
  }
  const Catalogue catalogue = Catalogue::open(out);
  for (const EpisodeSummary& one : catalogue.episodes()) {
    if (one.task != name || one.seed < request.first_seed || one.seed >= request.first_seed + request.episodes)
      continue;
    const EpisodeRecord episode = catalogue.read_episode(one.id);
    Judged result{one.seed, one.outcome, std::string(to_string(one.reason)), {}};
    if (!episode.detail.empty()) result.reason += ", " + episode.detail;
    if (!episode.labels.verdicts.empty()) result.verdict = episode.labels.verdicts[0];
    judged.push_back(std::move(result));
  }
  return judged;
}

void print(const std::vector<Judged>& judged, const fs::path& path, const ImportedTask& imported, bool as_json,
           Console& console) {
  if (!as_json) {
    console.out << path.string() << "\n";
    for (const Judged& one : judged) {
      const bool success = one.outcome == Outcome::success;
      console.out << fmt::format("seed {}: {}", one.seed, success ? "success" : one.reason);
      if (!one.verdict.dialect.empty())
        console.out << fmt::format("; {} says {}, we say {}", one.verdict.dialect, one.verdict.theirs ? "yes" : "no",
                                   one.verdict.ours ? "yes" : "no");
      console.out << "\n";
      for (const std::string& text : one.verdict.disagreements) console.out << "    " << text << "\n";
    }
    return;
  }
  JsonText json;
  json.object().field("path", path.string()).key("warnings").array();
  for (const std::string& text : imported.warnings) json.value(text);
  json.end().key("notes").array();
  for (const BddlNote& note : imported.notes) json.value(to_text(note));
  json.end().key("episodes").array();
  for (const Judged& one : judged) {
    json.object().field("seed", one.seed).field("outcome", std::string(to_string(one.outcome)));
    json.field("reason", one.reason).field("dialect", one.verdict.dialect).field("theirs", one.verdict.theirs);
    json.field("ours", one.verdict.ours).key("disagreements").array();
    for (const std::string& text : one.verdict.disagreements) json.value(text);
    json.end().end();
  }
  console.out << json.end().end().text();
}

ExitCode import_problem(const Arguments& arguments, Console& console) {
  const std::string file = arguments.text("FILE");
  const std::string world = arguments.has("--world") ? arguments.text("--world") : "tabletop";
  BddlReading reading = read_bddl(read_text_file(file), file);
  for (const std::string& warning : reading.warnings) console.err << warning << "\n";
  const std::string name = task_name(arguments, reading.problem);
  make_own_folder(arguments);
  const fs::path root = roots_of(arguments).folders.back(), path = root / "tasks" / (name + ".lua");
  const auto before = words_of(arguments);  // mistakes of other files are no reason not to write this one
  Source source = read_source(arguments, std::move(reading), *before, name);
  ImportedTask imported = task_file_from(before, source.reading.problem, source.mapping, scene_of_world(before, world),
                                         fs::path(file).filename().string());
  for (const std::string& warning : imported.warnings) console.err << warning << "\n";
  for (const BddlNote& note : imported.notes) console.err << to_text(note) << "\n";
  source.files.push_back({fs::path("tasks") / (name + ".lua"), imported.text});
  if (imported.refusal.empty()) imported.refusal = checker_says(arguments, name, source.files);
  if (!imported.refusal.empty()) {
    console.err << file << " cannot be a task here: " << imported.refusal << "\n";
    return kNo;
  }
  const auto library = library_with(arguments, root, source.files, name);
  if (!arguments.list("--path").empty()) write_editor_files(root, *before);
  bool interrupted = false;
  const std::vector<Judged> judged = run_task(arguments, library, name, console, interrupted);
  print(judged, path, imported, arguments.flag("--json"), console);
  const bool none =
      std::none_of(judged.begin(), judged.end(), [](const Judged& one) { return one.outcome == Outcome::success; });
  if (interrupted) return kInterrupted;
  return none && *arguments.integer("--episodes") > 0 ? kNo : kDone;
}

// Options that belong to one kind.
void refuse(const Arguments& arguments, const std::vector<const char*>& options, const std::string& of) {
  for (const char* option : options)
    if (arguments.has(option)) throw UsageError(std::string(option) + " is of import " + of, "leave it out");
}

ExitCode do_import(const Arguments& arguments, Console& console) {
  const std::vector<std::string>& words = arguments.list("FILE");
  if (words[0] == "recording" || words[0] == "labels")
    refuse(arguments, {"--task", "--mapping", "--episodes", "--seed"}, "PROBLEM.bddl");
  if (words[0] == "recording") {
    refuse(arguments, {"--episode"}, "labels");
    return import_recordings(arguments, console);
  }
  refuse(arguments, {"--frame-hz", "--workers"}, "recording");
  if (words[0] == "labels") {
    refuse(arguments, {"--world", "--out"}, "recording");
    return import_labels(arguments, console);
  }
  refuse(arguments, {"--episode"}, "labels");
  if (words.size() > 1 && !fs::exists(words[0]))
    throw UsageError("stampede import knows no kind '" + words[0] + "'",
                     did_you_mean(words[0], {"recording", "labels"}));
  if (words.size() > 1) throw UsageError("one BDDL problem at a time", "name one file");
  if (fs::is_directory(words[0]))
    throw UsageError("'" + words[0] + "' is a folder, and a BDDL problem is a file",
                     "of a recording, write: stampede import recording " + words[0]);
  return import_problem(arguments, console);
}

}  // namespace

CommandRow import_command() {
  return {
      "import",
      "Make recordings of a real robot episodes, or a BDDL problem of LIBERO or BEHAVIOR a task",
      "recording FOLDER…: each folder with a recording.json becomes an episode with source `real` "
      "(db/recording/README.md); one that is there already is not added again. labels FILE CATALOGUE: what "
      "people or models say happens in a real episode takes the place of its labels of the same sort. "
      "PROBLEM.bddl: a task, run, and judged by their rule and by ours. The task's file goes to tasks/ under the last "
      "--path, or under --root where there is none; it keeps the "
      "problem, so `stampede run` judges its episodes too: view `verdicts` has both verdicts and where they "
      "differ. Of LIBERO, every predicate is judged by its own geometry; of BEHAVIOR, the rule for counting and "
      "pairing is theirs and the atoms are ours. What its words mean here, and what could not be kept, is told on "
      "stderr. The exit code is 1 when it cannot be a task here, or no episode succeeded.",
      {{"FILE", "PROBLEM.bddl; or recording FOLDER…; or labels FILE CATALOGUE", true, true}},
      {{"--task", "NAME", "the task's name; default: from the problem's", Takes::text, "", {}, false},
       {"--world",
        "NAME",
        "where it takes place; default: of a problem tabletop, of a recording what it says",
        Takes::text,
        "",
        {},
        false},
       {"--mapping",
        "FILE",
        "a Lua file with our words for theirs, which go before those of worlds/bddl; see worlds/bddl/README.md",
        Takes::path,
        "",
        {},
        false},
       {"--episodes", "N", "how many to run; 0: only write the task", Takes::integer, "1", {}, false},
       {"--seed", "S", "the first seed", Takes::integer, "0", {}, false},
       {"--out", "FILE", "the catalogue", Takes::path, "demos.db", {}, false},
       {"--frame-hz", "N", "recording: frames a second; default: what it says, or 30", Takes::integer, "", {}, false},
       {"--workers",
        "W",
        "recording: threads that check pictures; default: a core each",
        Takes::integer,
        "",
        {},
        false},
       {"--episode", "N", "labels: the episode that they are of", Takes::integer, "", {}, false}},
      {"stampede import recording lab/0001 lab/0002 --out real.db",
       "stampede import labels labels.json real.db --episode 1",
       "stampede import problem0.bddl --task clear_table --path ~/my_tasks --episodes 5"},
      do_import};
}

}  // namespace stampede::program
