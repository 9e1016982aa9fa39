#include <algorithm>
#include <filesystem>
#include <ostream>

#include "engine/base/naming.h"
#include "engine/base/text_file.h"
#include "scripting/commands/commands.h"
#include "scripting/library/editor_files.h"
#include "scripting/library/library.h"
#include "scripting/library/new_robot.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

struct Kind {
  const char *name, *folder;
  DefinitionKind kind;
};

constexpr Kind kKinds[] = {{"task", "tasks", DefinitionKind::task},
                           {"skill", "skills", DefinitionKind::skill},
                           {"predicate", "worlds/predicates", DefinitionKind::predicate},
                           {"object", "worlds/objects", DefinitionKind::object},
                           {"world", "worlds", DefinitionKind::world},
                           {"robot", "worlds/robots", DefinitionKind::robot}};

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
  const std::vector<std::string>& traits = library.domain().traits;
  if (std::binary_search(traits.begin(), traits.end(), name)) {
    throw UsageError("the name '" + name + "' is taken by a trait", "take " + name + "_2");
  }
}

// A line more in the worlds/types.lua of that root; it adds to the types and traits of the roots before it.
void add_word(const fs::path& path, const std::string& kind, const std::string& name) {
  const std::string table = kind + "s = {";
  std::string text =
      "-- Types and traits of our own: they add to the library's.\nreturn {\n  types = {\n  },\n  traits = {\n  "
      "},\n}\n";
  if (fs::exists(path)) text = read_text_file(path);
  const std::size_t at = text.find(table);
  const std::string line =
      kind == "type" ? name + " = { parent = \"thing\" }," : name + " = \"what can be done with it\",";
  if (at == std::string::npos)
    throw UsageError("'" + path.string() + "' has no '" + table + "'", "add the line yourself: " + line);
  text.insert(at + table.size(), "\n    " + line);
  write_text_file(path, text);
}

// A URDF of that name is read; where there is none, a small arm's is written first.
std::string robot_beside(const fs::path& path, const std::string& name) {
  const fs::path urdf = fs::path(path).replace_extension(".urdf");
  if (!fs::exists(urdf)) write_text_file(urdf, small_arm_urdf(name));
  return robot_file(urdf);
}

ExitCode do_new(const Arguments& arguments, Console& console) {
  const std::string kind_name = arguments.text("KIND"), name = arguments.text("NAME");
  const auto* kind =
      std::find_if(std::begin(kKinds), std::end(kKinds), [&](const Kind& k) { return k.name == kind_name; });
  const bool word = kind_name == "type" || kind_name == "trait";
  if (kind == std::end(kKinds) && !word) {
    throw UsageError("there is no kind of file '" + kind_name + "'",
                     "it is one of task, skill, predicate, object, world, robot, type, trait");
  }
  check_name(name);
  make_own_folder(arguments);
  check_unused(*words_of(arguments), name);  // mistakes of other files are no reason not to write this one
  const fs::path root = roots_of(arguments).folders.back();
  const fs::path path = word ? root / "worlds" / "types.lua" : root / kind->folder / (name + ".lua");
  if (word) {
    add_word(path, kind_name, name);
  } else {
    if (fs::exists(path)) throw UsageError("'" + path.string() + "' exists already", "take another name");
    const bool robot = kind->kind == DefinitionKind::robot;
    write_text_file(path, robot ? robot_beside(path, name) : new_file(kind->kind, name));
  }
  if (!arguments.list("--path").empty()) {
    write_editor_files(root, *words_of(arguments));
  }
  if (arguments.flag("--json")) {
    console.out << JsonText().object().field("path", path.string()).end().text();
  } else {
    console.out << path.string() << "\n";
  }
  return kDone;
}

}  // namespace

CommandRow new_command() {
  return {
      "new",
      "Write the smallest file of a kind that passes `stampede check`",
      "The file goes to its place under the last --path, or under --root where there is none. A type or trait becomes "
      "a "
      "line of worlds/types.lua there, which adds to the library's. A robot's file is made from the URDF of that name "
      "beside "
      "it (worlds/robots/NAME.urdf): its arm, fingers, tip and a pose to start from; where there is none, a small "
      "six-axis arm's is written. Names that are "
      "taken, are words of Lua or PDDL, or do not match [a-z][a-z0-9_]* are refused, with a proposal. Under a --path, "
      "what editors read (LuaLS: .luarc.json, .stampede/) is kept current as `stampede doc --path` does.",
      {{"KIND", "task, skill, predicate, object, world, robot, type or trait", true, false},
       {"NAME", "its name", true, false}},
      {},
      {"stampede new task sort_cups", "stampede new predicate upright --path ~/my_tasks",
       "stampede new robot my_arm --path ~/my_tasks"},
      do_new};
}

}  // namespace stampede::program
