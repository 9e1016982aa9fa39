// Many episodes by several worker threads into one sink.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/record/episode_queue.h"
#include "scripting/session/episode_job.h"
#include "stampede/episode.h"

namespace stampede {

struct RunSettings {
  RunOptions options;
  std::map<std::string, std::vector<Camera>> cameras;          // by task: RunOptions::cameras, which its scene decides
  std::map<std::string, std::vector<MadeSentence>> sentences;  // by task: RunOptions::sentences of all variations
  int workers = 1;                                             // threads that run episodes
  int helpers = 0;  // further threads that may encode pictures, as workers without an episode do
  // Makes an episode, and its key, instead of the planner; each worker calls it.
  std::function<EpisodeRecord(PreparedEpisode&)> act;
  std::function<void(const EpisodeRecord&, const RunTally&)> progress;  // one at a time, from worker threads
  std::function<void(const Error&)> remark;                             // likewise, each remark of Assets once
  const std::atomic<bool>* stop = nullptr;
};

// Of the sink: who has one core keeps an episode before the next is begun, others go on meanwhile.
inline std::int64_t queue_bytes(const RunSettings& settings) {
  return settings.workers + settings.helpers > 1 ? EpisodeQueue::kBytes : 0;
}

// Runs the episodes that `sink` does not have yet and hands it each finished one; without a sink all are run and
// nothing is kept. Interrupted ones leave no trace. An episode's scripts are loaded, and its key known, when its turn
// comes.
// Throws: what a worker threw first, after the others have ended.
RunTally run_jobs(std::shared_ptr<const Library> library, const JobList& jobs, const RunSettings& settings,
                  EpisodeSink* sink);

}  // namespace stampede
