// A BDDL problem as a task file of ours, which keeps the problem it came from, so that its episodes can be judged by
// it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scripting/library/library.h"
#include "scripting/session/bddl_verdict.h"

namespace stampede {

struct ImportedTask {
  std::string text;     // of tasks/NAME.lua
  std::string refusal;  // not empty: why it cannot be a task here, and the cure; then there is no text
  std::vector<std::string> warnings;
  std::vector<BddlNote> notes;
};

// What a mapping names and where it comes from.
struct NamedMapping {
  BddlMapping mapping;
  std::string file;  // of worlds/bddl, by name; empty: that of the dialect
};

// `scene`: of any task of the world: which fixtures stand there already, and where.
ImportedTask task_file_from(const std::shared_ptr<const Library>& library, const BddlProblem& problem,
                            const NamedMapping& mapping, const Scene& scene, const std::string& origin);

// What a task was imported from, by its field `problem`; nothing for others. Throws Error where the file was damaged.
std::optional<ImportedProblem> imported_problem(const std::shared_ptr<const Library>& library, const std::string& task);

}  // namespace stampede
