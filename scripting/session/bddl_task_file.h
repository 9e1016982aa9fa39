// A BDDL problem as a task file of ours, which keeps the problem it came from, so that its episodes can be judged by
// it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scripting/session/bddl_verdict.h"

namespace stampede {

struct ImportedTask {
  std::string text;     // of tasks/NAME.lua
  std::string refusal;  // not empty: why it cannot be a task here, and the cure; then there is no text
  std::vector<std::string> warnings;
  std::vector<BddlNote> notes;
};

// `world`: the world's name; `scene`: of any of its tasks: which fixtures stand there already, and where.
// `mapping_source`: the Lua file that the mapping comes from, empty for the one built in; kept in the task's file.
ImportedTask task_file_from(const BddlProblem& problem, const BddlMapping& mapping, const std::string& mapping_source,
                            const std::string& world, const Scene& scene, const std::string& origin);

// What a task file was imported from; nothing for others. Throws Error where the file was damaged.
std::optional<ImportedProblem> imported_problem(const std::string& task_source, const std::string& place);

}  // namespace stampede
