// Many episodes by several worker threads into one sink.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "db/catalogue_writer.h"
#include "scripting/session/episode_job.h"

namespace stampede {

struct TaskTally {
  std::int64_t episodes = 0, succeeded = 0, existing = 0;
  std::map<std::string, std::int64_t> reasons;                              // of the failed ones
  std::map<std::string, std::pair<std::int64_t, std::int64_t>> variations;  // succeeded, episodes
  std::int64_t simulated_us = 0;  // whole numbers: their sum does not depend on who is done first
};

struct RunTally {
  std::int64_t total = 0;      // asked for
  std::int64_t finished = 0;   // in this run
  std::int64_t succeeded = 0;  // of these
  std::int64_t existing = 0;   // were there already
  bool interrupted = false;
  std::map<std::string, TaskTally> tasks;
  std::int64_t done() const { return finished + existing; }
};

struct RunSettings {
  RunOptions options;
  std::map<std::string, std::vector<Camera>> cameras;  // by task: RunOptions::cameras, which its scene decides
  int workers = 1;
  // Makes an episode, and its key, instead of the planner; each worker calls it.
  std::function<EpisodeRecord(PreparedEpisode&)> act;
  std::function<void(const EpisodeRecord&, const RunTally&)> progress;  // one at a time, from worker threads
  const std::atomic<bool>* stop = nullptr;
};

// Runs the episodes that `writer` does not have yet and hands it each finished one; without a writer all are run and
// nothing is kept. Interrupted ones leave no trace. An episode's scripts are loaded, and its key known, when its turn
// comes.
// Throws: what a worker threw first, after the others have ended.
RunTally run_jobs(std::shared_ptr<const Library> library, const JobList& jobs, const RunSettings& settings,
                  CatalogueWriter* writer);

}  // namespace stampede
