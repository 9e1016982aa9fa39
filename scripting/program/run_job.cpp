#include "scripting/program/run_job.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

namespace stampede {
namespace {

// Calls work(i) for 0 … count-1 from `workers` threads until all are done, one throws, or `stop`.
template <typename Work>
void in_parallel(std::size_t count, int workers, const std::atomic<bool>* stop, Work&& work) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> failed = false;
  std::exception_ptr first;
  std::mutex mutex;
  const auto loop = [&] {
    while (!failed && !(stop && stop->load())) {
      const std::size_t i = next++;
      if (i >= count) return;
      try {
        work(i);
      } catch (const std::exception&) {
        const std::lock_guard lock(mutex);
        if (!first) first = std::current_exception();
        failed = true;
      }
    }
  };
  std::vector<std::thread> threads;
  const auto wanted = std::min<std::size_t>(static_cast<std::size_t>(std::max(1, workers)), count);
  for (std::size_t t = 1; t < wanted; ++t) threads.emplace_back(loop);
  loop();
  for (std::thread& thread : threads) thread.join();
  if (first) std::rethrow_exception(first);
}

void count_episode(const EpisodeRecord& episode, RunTally& tally) {
  const bool success = episode.outcome == Outcome::success;
  TaskTally& task = tally.tasks[episode.task];
  auto& [variation_succeeded, variation_episodes] = task.variations[episode.variation];
  ++tally.finished;
  ++task.episodes;
  ++variation_episodes;
  task.simulated_s += static_cast<double>(episode.steps) / episode.physics_hz;
  if (success) {
    ++tally.succeeded;
    ++task.succeeded;
    ++variation_succeeded;
  } else {
    ++task.reasons[std::string(to_string(episode.reason))];
  }
}

}  // namespace

RunTally run_jobs(std::shared_ptr<const Library> library, const std::vector<EpisodeJob>& jobs,
                  const RunSettings& settings, EpisodeSink& sink) {
  RunTally tally;
  tally.total = static_cast<std::int64_t>(jobs.size());
  const std::atomic<bool>* stop = settings.stop;
  std::vector<std::string> keys(jobs.size());
  in_parallel(jobs.size(), settings.workers, stop,
              [&](std::size_t i) { keys[i] = PreparedEpisode(library, jobs[i], settings.options).key(); });
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < jobs.size() && !(stop && stop->load()); ++i) {
    TaskTally& task = tally.tasks[jobs[i].task];
    if (settings.exists && settings.exists(keys[i])) {
      ++tally.existing;
      ++task.existing;
      continue;
    }
    wanted.push_back(i);
    if (settings.expect) settings.expect(keys[i]);
  }
  std::mutex mutex;
  in_parallel(wanted.size(), settings.workers, stop, [&](std::size_t i) {
    PreparedEpisode prepared(library, jobs[wanted[i]], settings.options);
    EpisodeRecord episode = prepared.run(stop);
    if (episode.reason == Reason::interrupted) return;
    {
      const std::lock_guard lock(mutex);
      count_episode(episode, tally);
      if (settings.progress) settings.progress(episode, tally);
    }
    sink.finished(std::move(episode));
  });
  tally.interrupted = stop && stop->load() && tally.done() < tally.total;
  return tally;
}

}  // namespace stampede
