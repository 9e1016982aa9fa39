#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "db/table_text.h"
#include "engine/base/names.h"
#include "engine/base/naming.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/object_sheet.h"
#include "scripting/commands/object_table.h"
#include "scripting/commands/render_output.h"
#include "scripting/runtime/object_scene.h"
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

constexpr const char kNumbers[] = "numbers";

const Listing* shelf_named(const std::string& name) {
  const auto* found =
      std::find_if(std::begin(kShelves), std::end(kShelves), [&](const Listing& s) { return s.name == name; });
  return found == std::end(kShelves) ? nullptr : found;
}

// Of a kind, all but those that have mistakes, or use what has: these it tells of.
std::vector<const ScriptFile*> usable(const Library& library, DefinitionKind kind, Console& console) {
  std::vector<const ScriptFile*> files = library.files(kind);
  std::erase_if(files, [&](const ScriptFile* file) {
    const bool sound = library.complaints_about({file}).empty();
    if (!sound)
      console.err << fmt::format("{} has mistakes, or uses what has; `stampede check {}` names them\n",
                                 file->shown_path, file->name);
    return !sound;
  });
  return files;
}

QueryResult shelf_table(const Library& library, const Listing& shelf, Console& console) {
  const bool tasks = shelf.kind == DefinitionKind::task;
  QueryResult table;
  table.columns = {"name"};
  if (tasks) table.columns.insert(table.columns.end(), {"variations", "world"});
  table.columns.insert(table.columns.end(), {"description", "file"});
  for (const ScriptFile* file : usable(library, shelf.kind, console)) {
    std::vector<SqlValue> row = {file->name};
    if (tasks) {
      const Library::TaskInfo& task = *library.task(file->name);
      row.emplace_back(static_cast<std::int64_t>(task.variation_texts.size()));
      row.emplace_back(task.world);
    }
    row.emplace_back(file->description);
    row.emplace_back(file->shown_path);
    table.rows.push_back(std::move(row));
  }
  return table;
}

// What is read of a thing without it.
SqlValue otherwise_of(const NumberInfo& number) {
  if (number.otherwise) return *number.otherwise;
  return std::string(number.optional ? "nothing" : "a mistake");
}

QueryResult numbers_table(const Numbers& numbers) {
  QueryResult table;
  table.columns = {"name", "unit", "without_it", "trait", "description", "declared_in"};
  for (const auto& [name, number] : numbers)
    table.rows.push_back({name, number.unit, otherwise_of(number), number.trait, number.description, number.place});
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

ExitCode print(const QueryResult& table, const Arguments& arguments, Console& console) {
  console.out << (arguments.flag("--json") ? to_json(table) : to_table(table));
  return kDone;
}

ExitCode list_hashes(const std::shared_ptr<const Library>& library, const std::string& what, Console& console) {
  if (library->file(DefinitionKind::task, what) != nullptr) {
    console.out << hash_of(library, task_info(*library, what)) << "\n";
    return kDone;
  }
  if (what != "tasks") throw UsageError("--hash is of tasks", "stampede list --hash, or stampede list TASK --hash");
  for (const ScriptFile* file : usable(*library, DefinitionKind::task, console))
    console.out << hash_of(library, *library->task(file->name)) << " " << file->name << "\n";
  return kDone;
}

ExitCode list_task(const Library::TaskInfo& task, const Arguments& arguments, Console& console) {
  QueryResult table;
  table.columns = {"variation"};
  for (const std::string& text : task.variation_texts) table.rows.push_back({text});
  if (arguments.flag("--json")) return print(table, arguments, console);
  console.out << task.name << ": " << task.description << "\n";
  for (const std::string& instruction : task.instructions) console.out << "  “" << instruction << "”\n";
  console.out << "\n";
  return print(table, arguments, console);
}

void draw(const std::shared_ptr<const Library>& library, const std::vector<std::string>& names,
          const Arguments& arguments, Console& console) {
  const std::string sheet = arguments.text("--sheet");
  if (sheet.empty()) return;
  const OutputRules rules = output_rules(arguments, console);
  check_output(sheet, sheet_kind(), rules);
  draw_objects(library, names, sheet, rules);
}

ExitCode list_object(const std::shared_ptr<const Library>& library, const ScriptFile& file, const Arguments& arguments,
                     Console& console) {
  library->require_sound({&file});
  const QueryResult table = object_table(object_scene(library, file.name));
  draw(library, {file.name}, arguments, console);
  if (!arguments.flag("--json")) console.out << file.name << ": " << file.description << "\n\n";
  return print(table, arguments, console);
}

ExitCode do_list(const Arguments& arguments, Console& console) {
  const auto library = load_library(arguments);
  tell_left_out(*library, {}, console);
  const std::string what = arguments.text("WHAT").empty() ? "tasks" : arguments.text("WHAT");
  const ScriptFile* object = library->file(DefinitionKind::object, what);
  const bool drawn = what == "objects" || object != nullptr;
  if (arguments.flag("--hash")) return list_hashes(library, what, console);
  if (!arguments.text("--sheet").empty() && !drawn)
    throw UsageError("--sheet shows objects", "stampede list objects --sheet F");
  if (const Listing* shelf = shelf_named(what)) {
    if (drawn) draw(library, names_of(library->files(DefinitionKind::object)), arguments, console);
    return print(shelf_table(*library, *shelf, console), arguments, console);
  }
  if (what == kNumbers) return print(numbers_table(library->numbers()), arguments, console);
  if (library->file(DefinitionKind::task, what) != nullptr)
    return list_task(task_info(*library, what), arguments, console);
  if (object != nullptr) return list_object(library, *object, arguments, console);
  std::vector<std::string> names = names_of(library->files(DefinitionKind::task));
  for (const std::string& name : names_of(library->files(DefinitionKind::object))) names.push_back(name);
  names.emplace_back(kNumbers);
  for (const Listing& shelf : kShelves) names.emplace_back(shelf.name);
  throw UsageError("there is nothing to list by the name '" + what + "'", did_you_mean(what, names));
}

}  // namespace

CommandRow list_command() {
  return {
      "list",
      "List tasks, skills, predicates, objects, worlds, robots or numbers, or what one task or object is made of",
      "Without WHAT it lists the tasks. With the name of a task it lists the task's variations, with that of "
      "an object its parts and regions: what they are called, what can be done with them, how large they are, how they "
      "move and which numbers they have. `numbers` are those "
      "that "
      "objects can have: what they say, and what is read of an object without them.",
      {{"WHAT", "tasks, skills, predicates, objects, worlds, robots, numbers, or the name of a task or object", false,
        false}},
      {{"--sheet", "FILE", "of objects, or of one: a page of pictures (PNG)", Takes::output, "", {}, false},
       {"--hash",
        "",
        "of a task: the hash of all files that its episodes are made of; without WHAT each task's, before its name",
        Takes::flag,
        "",
        {},
        false}},
      {"stampede list", "stampede list skills", "stampede list stack_blocks", "stampede list chest",
       "stampede list objects --sheet objects.png"},
      do_list};
}

}  // namespace stampede::program
