// A start in which what a task asks holds.
#pragma once

#include <atomic>
#include <map>

#include "engine/start/options.h"
#include "engine/start/predicates.h"
#include "engine/start/task.h"
#include "engine/start/world_view.h"

namespace stampede {

// Makes and settles a start in which init holds, without running it. Throws nothing; a reason when none was found.
struct Start {
  Reason reason = Reason::none;
  std::string detail;  // which literal failed, and how often
  std::shared_ptr<const Scene> scene;
  int draws = 0;
};

// With what was read in the world it settled in.
struct PreparedStart : Start {
  Task task;                              // the draw that was taken, or the last one
  std::map<Fact, Symbols::Value> values;  // facts read after settling, as the episode begins with them
  WorldView::History history;
};
// `stop`: looked at before every draw; set, the reason is `interrupted`.
PreparedStart prepare_start(const TaskDraw& task, Symbols& symbols, const RunOptions& options,
                            const std::atomic<bool>* stop = nullptr);

}  // namespace stampede
