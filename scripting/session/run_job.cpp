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

// Any thread makes an episode; what is told and counted of it is one thread's at a time.
class JobRun {
 public:
  JobRun(std::shared_ptr<const Library> library, const JobList& jobs, const RunSettings& settings, EpisodeSink* sink)
      : library_(std::move(library)), jobs_(jobs), settings_(settings), sink_(sink) {
    const auto busy = static_cast<int>(std::clamp<std::int64_t>(jobs.size(), 1, settings.workers));
    encoders_ = settings.helpers + settings.workers - busy;
    tally_.total = jobs.size();
  }

  RunTally run() {
    const std::atomic<bool>* stop = settings_.stop;
    if (!settings_.act) check_policies(library_, jobs_.first_of_each_task(), settings_.options, stop);
    in_parallel(static_cast<std::size_t>(jobs_.size()), settings_.workers, stop, [&](std::size_t i, Workbench& bench) {
      const auto place = static_cast<std::int64_t>(i);
      try {
        make(place, bench);
      } catch (...) {
        abandon(place);
        throw;
      }
    });
    tally_.interrupted = stop && stop->load() && tally_.done() < tally_.total;
    return std::move(tally_);
  }

 private:
  void make(std::int64_t place, Workbench& bench) {
    const EpisodeJob job = jobs_[place];
    if (!bench.assets) bench.assets = assets_of(*library_);
    RunOptions options = options_for(job, settings_);
    options.services.renderer = &bench.renderer;
    options.services.encoders = encoders_;
    PreparedEpisode prepared(library_, job, std::move(options), bench.assets);
    pass_on(bench.assets->remarks());
    if (!settings_.act && is_there(place, job.task, prepared.key())) return;
    EpisodeRecord episode = settings_.act ? settings_.act(prepared) : prepared.run(settings_.stop);
    if (episode.reason == Reason::interrupted) return abandon(place);
    if (settings_.act && is_there(place, job.task, episode.made.key)) return;
    count(episode);
    if (sink_) sink_->finished(place, std::move(episode));
  }

  // The others must not wait for it.
  void abandon(std::int64_t place) {
    if (sink_) sink_->abandon(place);
  }

  // Then it is counted as such, and not kept again.
  bool is_there(std::int64_t place, const std::string& task, const std::string& key) {
    if (!sink_ || !sink_->has(key)) return false;
    sink_->abandon(place);
    const std::lock_guard lock(mutex_);
    ++tally_.existing;
    ++tally_.tasks[task].existing;
    return true;
  }

  void pass_on(const std::vector<Error>& remarks) {
    if (!settings_.remark || remarks.empty()) return;
    const std::lock_guard lock(mutex_);
    for (const Error& remark : remarks)
      if (remarked_.insert(remark.what()).second) settings_.remark(remark);
  }

  void count(const EpisodeRecord& episode) {
    const std::lock_guard lock(mutex_);
    count_episode(episode, tally_);
    if (settings_.progress) settings_.progress(episode, tally_);
  }

  const std::shared_ptr<const Library> library_;
  const JobList& jobs_;
  const RunSettings& settings_;
  EpisodeSink* const sink_;
  int encoders_ = 0;
  std::mutex mutex_;
  RunTally tally_;
  std::set<std::string> remarked_;
};

}  // namespace

RunTally run_jobs(std::shared_ptr<const Library> library, const JobList& jobs, const RunSettings& settings,
                  EpisodeSink* sink) {
  return JobRun(std::move(library), jobs, settings, sink).run();
}

}  // namespace stampede
