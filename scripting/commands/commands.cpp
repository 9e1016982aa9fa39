#include "scripting/commands/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "db/catalogue.h"
#include "engine/base/processor.h"
#include "engine/sim/numerics.h"
#include "scripting/library/roots.h"

namespace stampede::program {

// A new command is one file in this folder and one line here.
const std::vector<CommandRow>& all_commands() {
  static const std::vector<CommandRow> commands = {
      list_command(),   check_command(),      run_command(),       evaluate_command(), show_command(),
      plan_command(),   validate_command(),   query_command(),     index_command(),    merge_command(),
      lock_command(),   make_command(),       verify_command(),    cluster_command(),  export_command(),
      import_command(), paraphrase_command(), questions_command(), dataset_command(),  baseline_command(),
      score_command(),  replay_command(),     render_command(),    new_command(),      doc_command(),
  };
  return commands;
}

Roots roots_of(const Arguments& arguments) {
  std::vector<std::filesystem::path> paths;
  for (const std::string& path : arguments.list("--path")) paths.emplace_back(path);
  return make_roots(arguments.text("--root"), paths);
}

EngineInfo this_engine() { return {STAMPEDE_VERSION, numerics_probe()}; }

OutputRules output_rules(const Arguments& arguments, const Console& console) {
  return {arguments.inputs(), arguments.flag("--force"), console.data};
}

void make_own_folder(const Arguments& arguments) {
  const std::vector<std::string> paths = arguments.list("--path");
  std::error_code error;  // roots_of says what is wrong
  if (!paths.empty()) std::filesystem::create_directories(paths.back(), error);
}

std::int64_t in_range(const Arguments& arguments, const char* option, std::int64_t least, std::int64_t most) {
  const std::int64_t value = *arguments.integer(option);
  if (value < least) throw UsageError(fmt::format("{} is at least {}, not {}", option, least, value));
  if (value > most) throw UsageError(fmt::format("{} is at most {}, not {}", option, most, value));
  return value;
}

int workers_of(const Arguments& arguments) {
  if (arguments.has("--workers")) return static_cast<int>(in_range(arguments, "--workers", 1, kMostWorkers));
  return std::min(usable_cores(), static_cast<int>(kMostWorkers));
}

std::shared_ptr<const Library> words_of(const Arguments& arguments) { return Library::load_words(roots_of(arguments)); }

std::shared_ptr<const Library> load_library(const Arguments& arguments, const std::vector<std::string>& tasks) {
  return Library::load(roots_of(arguments), tasks);
}

void tell_left_out(const Library& library, const std::vector<const ScriptFile*>& told, Console& console) {
  for (const ScriptFile& file : library.left_out())
    if (std::ranges::find(told, &file) == told.end())
      console.err << fmt::format("{} has mistakes, so nothing here uses it; `stampede check {}` names them\n",
                                 file.shown_path, file.name);
}

}  // namespace stampede::program
