#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "db/table_text.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/object_sheet.h"
#include "scripting/commands/render_output.h"
#include "scripting/library/naming.h"
#include "scripting/session/episode_job.h"

namespace stampede::program {
namespace {

struct Listing {
  const char* name;
  DefinitionKind kind;
};
constexpr Listing kShelves[] = {
    {"tasks", DefinitionKind::task},     {"skills", DefinitionKind::skill}, {"predicates", DefinitionKind::predicate},
    {"objects", DefinitionKind::object}, {"worlds", DefinitionKind::world}, {"robots", DefinitionKind::robot},
};

const Listing* shelf_named(const std::string& name) {
  const auto* found =
      std::find_if(std::begin(kShelves), std::end(kShelves), [&](const Listing& s) { return s.name == name; });
  return found == std::end(kShelves) ? nullptr : found;
}

QueryResult shelf_table(const Library& library, const Listing& shelf) {
  const bool tasks = shelf.kind == DefinitionKind::task;
  QueryResult table;
  table.columns = {"name"};
  if (tasks) table.columns.insert(table.columns.end(), {"variations", "world"});
  table.columns.insert(table.columns.end(), {"description", "file"});
  for (const ScriptFile* file : library.files(shelf.kind)) {
    std::vector<SqlValue> row = {file->name};
    if (tasks) {
      const Library::TaskInfo& task = task_info(library, file->name);
      row.emplace_back(static_cast<std::int64_t>(task.variation_texts.size()));
      row.emplace_back(task.world);
    }
    row.emplace_back(file->description);
    row.emplace_back(file->shown_path);
    table.rows.push_back(std::move(row));
  }
  return table;
}

// Of the first variation, and all others: objects that only some of them have count too.
std::string hash_of(const std::shared_ptr<const Library>& library, const Library::TaskInfo& task) {
  std::vector<DefinitionRecord> all;
  for (const std::string& variation : task.variation_texts)
    for (DefinitionRecord& one : EpisodeScripts(library, task.name, variation, 0).definitions())
      all.push_back(std::move(one));
  return definitions_hash(all);
}

ExitCode list_task(const Library::TaskInfo& task, const Arguments& arguments, Console& console) {
  QueryResult table;
  table.columns = {"variation"};
  for (const std::string& text : task.variation_texts) table.rows.push_back({text});
  if (arguments.flag("--json")) {
    console.out << to_json(table);
    return kDone;
  }
  console.out << task.name << ": " << task.description << "\n";
  for (const std::string& instruction : task.instructions) console.out << "  “" << instruction << "”\n";
  console.out << "\n" << to_table(table);
  return kDone;
}

ExitCode do_list(const Arguments& arguments, Console& console) {
  const auto library = load_library(arguments);
  const std::string what = arguments.text("WHAT").empty() ? "tasks" : arguments.text("WHAT");
  if (const Listing* shelf = shelf_named(what)) {
    if (const std::string sheet = arguments.text("--sheet"); !sheet.empty()) {
      if (shelf->kind != DefinitionKind::object)
        throw UsageError("--sheet shows objects", "stampede list objects --sheet F");
      const OutputRules rules = output_rules(arguments, console);
      check_output(sheet, sheet_kind(), rules);
      draw_objects(library, sheet, rules);
    }
    const QueryResult table = shelf_table(*library, *shelf);
    console.out << (arguments.flag("--json") ? to_json(table) : to_table(table));
    return kDone;
  }
  if (const Library::TaskInfo* task = library->task(what)) {
    if (!arguments.flag("--hash")) return list_task(*task, arguments, console);
    console.out << hash_of(library, *task) << "\n";
    return kDone;
  }
  std::vector<std::string> names;
  for (const Listing& shelf : kShelves) names.emplace_back(shelf.name);
  for (const ScriptFile* file : library->files(DefinitionKind::task)) names.push_back(file->name);
  throw UsageError("there is nothing to list by the name '" + what + "'", did_you_mean(what, names));
}

}  // namespace

CommandRow list_command() {
  return {
      "list",
      "List tasks, skills, predicates, objects, worlds or robots, or the variations of a task",
      "Without WHAT it lists the tasks. With the name of a task it lists the task's variations.",
      {{"WHAT", "tasks, skills, predicates, objects, worlds, robots, or the name of a task", false, false}},
      {{"--sheet", "FILE", "objects only: a page of pictures of them all (PNG)", Takes::output, "", {}, false},
       {"--hash", "", "of a task: the hash of all files that its episodes are made of", Takes::flag, "", {}, false}},
      {"stampede list", "stampede list skills", "stampede list stack_blocks",
       "stampede list objects --sheet objects.png"},
      do_list};
}

}  // namespace stampede::program
