#include <filesystem>
#include <fstream>
#include <ostream>

#include "scripting/commands/commands.h"
#include "scripting/library/fields.h"
#include "scripting/program/help.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

struct Document {
  fs::path path;
  std::string text;
};

void write(const Document& document) {
  fs::create_directories(document.path.parent_path());
  std::ofstream file(document.path, std::ios::binary);
  file << document.text;
  file.close();
  if (!file) throw Error(document.path.string(), "it could not be written");
}

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Document> documents(const fs::path& root) {
  return {{root / "scripting/library/stampede.lua", luals_annotations()},
          {root / "scripting/commands/reference.md", command_reference(all_commands())},
          {root / "scripting/commands/completion.bash", bash_completion(all_commands())}};
}

ExitCode run(const Arguments& arguments, Console& console) {
  const bool check = arguments.flag("--check");
  bool fresh = true;
  JsonText json;
  json.object().key("documents").array();
  for (const Document& document : documents(roots_of(arguments).folders.front())) {
    const bool same = read(document.path) == document.text;
    fresh = fresh && same;
    if (!check && !same) write(document);
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
          "All are generated from the tables that the program itself uses. With --check nothing is written, and the "
          "exit code is 1 when one is stale.",
          {},
          {{"--check", "", "only say whether they are fresh", Takes::flag, "", {}, false}},
          {"stampede doc", "stampede doc --check"},
          run};
}

}  // namespace stampede::program
