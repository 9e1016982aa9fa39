#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>

#include "scripting/commands/commands.h"
#include "scripting/library/naming.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

struct Kind {
  const char *name, *folder, *text;  // NAME in the text is replaced
};

// The smallest files that pass `stampede check` in a library with our worlds and predicates.
constexpr Kind kKinds[] = {
    {"task", "tasks",
     "-- Lift a cube: say here in one line what is to be done.\n"
     "return task {\n"
     "  world = \"tabletop\",\n"
     "  objects = { item = { \"cube\", colour = \"red\" } },\n"
     "  init = { is.on(\"item\", \"table\") },\n"
     "  goal = is.holding(\"item\"),\n"
     "  instructions = { \"pick up the cube\" },\n"
     "}\n"},
    {"skill", "skills",
     "-- Wait a moment: say here in one line what the arm does.\n"
     "return skill {\n"
     "  params = { \"NAME_obj: movable\" },\n"
     "  precondition = { is.hand_empty() },\n"
     "  effect = {},\n"
     "  continuous = { seconds = { 0.5, min = 0.1, max = 5, unit = \"s\" } },\n"
     "  label = \"wait beside the {NAME_obj}\",\n"
     "  run = function(robot, p, c)\n"
     "    robot:wait(c.seconds)\n"
     "  end,\n"
     "}\n"},
    {"predicate", "worlds/predicates",
     "-- The object is higher than 1 m above the floor: say here in one line when the fact holds.\n"
     "return predicate {\n"
     "  params = { \"obj: movable\" },\n"
     "  label = \"the {obj} is NAME\",\n"
     "  settle = 0.1,\n"
     "  holds = function(w, obj)\n"
     "    return w:position(obj)[3] > 1.0\n"
     "  end,\n"
     "}\n"},
    {"object", "worlds/objects",
     "-- A small block: say here in one line what it is.\n"
     "return object {\n"
     "  type = \"block\",\n"
     "  traits = { \"movable\" },\n"
     "  shape = { \"box\", size = { 0.04, 0.04, 0.04 } },\n"
     "  mass = 0.05,\n"
     "}\n"},
};

void check_name(const std::string& name) {
  if (const auto fault = name_fault(name)) {
    throw UsageError("'" + name + "' cannot be a name: it " + *fault, "take " + proposed_name(name));
  }
}

void check_unused(const Library& library, const std::string& name) {
  for (const ScriptFile* file : library.all_files()) {
    if (file->name != name || file->kind == DefinitionKind::module) continue;
    throw UsageError("the name '" + name + "' is taken by " + file->shown_path, "take " + name + "_2");
  }
  if (library.domain().types.contains(name)) {
    throw UsageError("the name '" + name + "' is taken by a type", "take " + name + "_2");
  }
}

ExitCode run(const Arguments& arguments, Console& console) {
  const std::string kind_name = arguments.text("KIND"), name = arguments.text("NAME");
  const auto* kind =
      std::find_if(std::begin(kKinds), std::end(kKinds), [&](const Kind& k) { return k.name == kind_name; });
  if (kind == std::end(kKinds)) {
    throw UsageError("there is no kind of file '" + kind_name + "'", "it is one of task, skill, predicate, object");
  }
  check_name(name);
  std::vector<Error> complaints;  // of other files: no reason not to write this one
  check_unused(*Library::load(roots_of(arguments), complaints), name);
  const fs::path root = roots_of(arguments).folders.back();
  const fs::path path = root / kind->folder / (name + ".lua");
  if (fs::exists(path)) throw UsageError("'" + path.string() + "' exists already", "take another name");
  std::string text = kind->text;
  for (std::size_t at = text.find("NAME"); at != std::string::npos; at = text.find("NAME")) {
    const std::string replacement = text.compare(at, 8, "NAME_obj") == 0 ? "obj" : name;
    text.replace(at, replacement == "obj" ? 8 : 4, replacement);
  }
  fs::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw Error(path.string(), "it could not be written");
  if (arguments.flag("--json")) {
    console.out << JsonText().object().field("path", path.string()).end().text();
  } else {
    console.out << path.string() << "\n";
  }
  return kDone;
}

}  // namespace

CommandRow new_command() {
  return {"new",
          "Write the smallest task, skill, predicate or object that passes `stampede check`",
          "The file goes to its place under the last --path, or under --root where there is none. Names that are "
          "taken, are words of Lua or PDDL, or do not match [a-z][a-z0-9_]* are refused, with a proposal.",
          {{"KIND", "task, skill, predicate or object", true, false}, {"NAME", "its name", true, false}},
          {},
          {"stampede new task sort_cups", "stampede new predicate upright --path ~/my_tasks"},
          run};
}

}  // namespace stampede::program
