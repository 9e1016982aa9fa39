// What a run's options change of a task: its start is constrained further, or its goal is another.
#pragma once

#include "engine/start/options.h"
#include "engine/start/task.h"

namespace stampede {

class Symbols;

// With another goal the task's own steps, stages, subgoals and functions are left out. Throws Error for a goal that
// speaks of what the task's scene does not have.
Task altered(Task task, const Symbols& symbols, const RunOptions& options);
// The same of each draw. Lifetime: refers to symbols and options.
TaskDraw altered(const TaskDraw& task, const Symbols& symbols, const RunOptions& options);

}  // namespace stampede
