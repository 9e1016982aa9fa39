// What only building shows of scripts: URDF and mesh files, sizes of shapes, joints and links that are not there, tips
// off their tools, slots that are too small. Whatever a run refuses before it begins.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "engine/base/error.h"
#include "scripting/library/library.h"

namespace stampede::program {

struct BuiltCheck {
  std::vector<const ScriptFile*> files;  // objects, robots, worlds and tasks are built; others are passed over
  std::size_t most_variations = 1;       // of a task, spread over all that it has
  const std::atomic<bool>* stop = nullptr;
};

// Objects, robots and worlds by themselves, tasks one draw a variation. Complaints are added, each once.
// Result: remarks on what is no mistake (Assets::remarks).
std::vector<Error> check_built(const std::shared_ptr<const Library>& library, const BuiltCheck& asked,
                               std::vector<Error>& complaints);

}  // namespace stampede::program
