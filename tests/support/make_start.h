// A start as a run makes it.
#pragma once

#include "engine/start/altered_task.h"
#include "engine/start/start.h"
#include "engine/start/task.h"

namespace stampede {

class Symbols;

inline PreparedStart make_start(const TaskDraw& task, Symbols& symbols, const RunOptions& options) {
  return prepare_start(altered(task, symbols, options), symbols, options);
}

}  // namespace stampede
