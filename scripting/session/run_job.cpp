#include "scripting/session/run_job.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

#include "engine/base/stopping.h"
#include "engine/render/renderer.h"
#include "scripting/runtime/assets.h"
#include "scripting/session/made_sentences.h"
#include "scripting/session/policies_fit.h"

namespace stampede {
namespace {

// Made when something is to be drawn: a run without pictures needs none, one with pictures one a thread.
class LazyRenderer : public Renderer {
 public:
  void load(std::shared_ptr<const Scene> scene) override {
    if (!renderer_) renderer_ = make_renderer();
    renderer_->load(std::move(scene));
  }
  void draw(const ScenePoses& poses, std::span<const View> views, const DrawOptions& options,
            std::vector<Picture>& pictures) override {
    renderer_->draw(poses, views, options, pictures);
  }

 private:
  std::unique_ptr<Renderer> renderer_;
};

// What a thread makes all its episodes with.
struct Workbench {
  LazyRenderer renderer;
  std::shared_ptr<Assets> assets;
};

// Calls work(i, bench) for 0 … count-1 from `workers` threads, each with a bench of its own, until all are done, one
// throws, or `stop`.
template <typename Work>
void in_parallel(std::size_t count, int workers, const std::atomic<bool>* stop, Work&& work) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> failed = false;
  std::exception_ptr first;
  std::mutex mutex;
  const auto loop = [&] {
    const StopScope scope(stop);
    Workbench bench;
    while (!failed && !(stop && stop->load())) {
      const std::size_t i = next++;
      if (i >= count) return;
      try {
        work(i, bench);
      } catch (const Interrupted&) {
        return;  // as `stop` says
      } catch (...) {
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

RunOptions options_for(const EpisodeJob& job, const RunSettings& settings) {
  RunOptions options = settings.options;
  if (const auto found = settings.cameras.find(job.task); found != settings.cameras.end())
    options.cameras = found->second;
  if (const auto found = settings.sentences.find(job.task); found != settings.sentences.end())
    options.sentences = sentences_for(found->second, job.variation);
  return options;
}

void count_episode(const EpisodeRecord& episode, RunTally& tally) {
  const bool success = episode.outcome == Outcome::success;
  TaskTally& task = tally.tasks[episode.task];
  auto& [variation_succeeded, variation_episodes] = task.variations[episode.variation];
  ++tally.finished;
  ++task.episodes;
  ++variation_episodes;
  task.simulated_us += std::llround(1e6 * episode.duration_s());
  if (success) {
    ++tally.succeeded;
    ++task.succeeded;
    ++variation_succeeded;
  } else {
    ++task.reasons[std::string(to_string(episode.reason))];
  }
}

}  // namespace

RunTally run_jobs(std::shared_ptr<const Library> library, const JobList& jobs, const RunSettings& settings,
                  EpisodeSink* sink) {
  RunTally tally;
  tally.total = jobs.size();
  const std::atomic<bool>* stop = settings.stop;
  const auto busy = static_cast<int>(std::clamp<std::int64_t>(jobs.size(), 1, settings.workers));
  const int encoders = settings.helpers + settings.workers - busy;
  if (!settings.act) check_policies(library, jobs.first_of_each_task(), settings.options, stop);
  std::mutex mutex;
  std::set<std::string> remarked;
  const auto pass_on = [&](const std::vector<Error>& remarks) {
    if (!settings.remark || remarks.empty()) return;
    const std::lock_guard lock(mutex);
    for (const Error& remark : remarks)
      if (remarked.insert(remark.what()).second) settings.remark(remark);
  };
  in_parallel(static_cast<std::size_t>(jobs.size()), settings.workers, stop, [&](std::size_t i, Workbench& bench) {
    const auto place = static_cast<std::int64_t>(i);
    try {
      const EpisodeJob job = jobs[place];
      if (!bench.assets) bench.assets = std::make_shared<Assets>(FileScope(library->roots().folders));
      RunOptions options = options_for(job, settings);
      options.renderer = &bench.renderer;
      options.encoders = encoders;
      PreparedEpisode prepared(library, job, std::move(options), bench.assets);
      pass_on(bench.assets->remarks());
      const auto is_there = [&](const std::string& key) {
        if (!sink || !sink->has(key)) return false;
        sink->abandon(place);
        const std::lock_guard lock(mutex);
        ++tally.existing;
        ++tally.tasks[job.task].existing;
        return true;
      };
      if (!settings.act && is_there(prepared.key())) return;
      EpisodeRecord episode = settings.act ? settings.act(prepared) : prepared.run(stop);
      if (episode.reason == Reason::interrupted) {
        if (sink) sink->abandon(place);
        return;
      }
      if (settings.act && is_there(episode.key)) return;
      {
        const std::lock_guard lock(mutex);
        count_episode(episode, tally);
        if (settings.progress) settings.progress(episode, tally);
      }
      if (sink) sink->finished(place, std::move(episode));
    } catch (...) {
      if (sink) sink->abandon(place);  // the others must not wait for it
      throw;
    }
  });
  tally.interrupted = stop && stop->load() && tally.done() < tally.total;
  return tally;
}

}  // namespace stampede
