// A start and what was read in the world it settled in.
#pragma once

#include <atomic>
#include <map>

#include "engine/episode/runner.h"

namespace stampede {

struct PreparedStart : Start {
  Task task;                              // the draw that was taken, or the last one
  std::map<Fact, Symbols::Value> values;  // facts read after settling, as the episode begins with them
  WorldView::History history;
};
// `stop`: looked at before every draw; set, the reason is `interrupted`.
PreparedStart prepare_start(const TaskDraw& task, Symbols& symbols, const RunOptions& options,
                            const std::atomic<bool>* stop = nullptr);

}  // namespace stampede
