#include "scripting/commands/commands.h"

#include "scripting/program/roots.h"

namespace stampede::program {

// A new command is one file in this folder and one line here.
const std::vector<CommandRow>& all_commands() {
  static const std::vector<CommandRow> commands = {
      list_command(),  check_command(),  run_command(), show_command(), plan_command(),
      query_command(), replay_command(), new_command(), doc_command(),
  };
  return commands;
}

Roots roots_of(const Arguments& arguments) {
  std::vector<std::filesystem::path> paths;
  for (const std::string& path : arguments.list("--path")) paths.emplace_back(path);
  return make_roots(arguments.text("--root"), paths);
}

std::shared_ptr<const Library> load_library(const Arguments& arguments) { return Library::load(roots_of(arguments)); }

}  // namespace stampede::program
