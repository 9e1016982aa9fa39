#include <filesystem>
#include <ostream>

#include "engine/base/text_file.h"
#include "scripting/commands/commands.h"
#include "scripting/library/annotations.h"
#include "scripting/library/editor_files.h"
#include "scripting/program/help.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

// Of the last --path, or of the project.
std::vector<TextFile> documents(const Arguments& arguments) {
  const Roots roots = roots_of(arguments);
  const auto library = Library::load_words(roots);  // `stampede check` tells of mistakes
  if (roots.folders.size() > 1) return editor_files(roots.folders.back(), *library);
  const fs::path& root = roots.folders.front();
  if (!fs::is_directory(root / "scripting")) {
    throw UsageError("'" + root.string() + "' is not the project's own folder",
                     "for a folder of your tasks: stampede doc --path FOLDER");
  }
  return {{root / "scripting/library/stampede.lua", field_annotations()},
          {root / "scripting/library/names.lua", name_annotations(*library)},
          {root / "scripting/commands/reference.md", command_reference(all_commands())},
          {root / "scripting/commands/completion.bash", bash_completion(all_commands())}};
}

ExitCode do_doc(const Arguments& arguments, Console& console) {
  const bool check = arguments.flag("--check");
  bool fresh = true;
  JsonText json;
  json.object().key("documents").array();
  for (const TextFile& document : documents(arguments)) {
    const bool same = holds_text(document.path, document.text);
    fresh = fresh && same;
    if (!check && !same) write_text_file(document.path, document.text);
    const char* state = same ? "fresh" : check ? "stale" : "written";
    json.object().field("path", document.path.string()).field("state", state).end();
    if (!arguments.flag("--json")) console.out << document.path.string() << ": " << state << "\n";
  }
  if (arguments.flag("--json")) console.out << json.end().end().text();
  return check && !fresh ? kNo : kDone;
}

}  // namespace

CommandRow doc_command() {
  return {"doc",
          "Write the reference, the editor annotations and the shell completion anew",
          "All are generated from the tables that the program itself uses. With --path only what an editor's Lua "
          "language server (LuaLS) needs in that folder is written: .luarc.json, unless there is one, and .stampede/; "
          "`stampede new` does so too. With --check nothing is written, and the exit code is 1 when one is stale.",
          {},
          {{"--check", "", "only say whether they are fresh", Takes::flag, "", {}, false}},
          {"stampede doc", "stampede doc --check", "stampede doc --path ~/my_tasks"},
          do_doc};
}

}  // namespace stampede::program
