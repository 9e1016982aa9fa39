#include "scripting/research/physics.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "engine/base/error.h"
#include "scripting/session/episode_job.h"

namespace stampede::research {
namespace {

// The planner's own domain has fluents for the goal's order: the held-out problem has none.
PlanOutcome ask_learned(const TrueWordsPlanner& planner, const HeldOutEpisode& episode, const Domain& domain,
                        Problem problem) {
  problem.goal = episode.problem.goal;
  return planner(domain, problem);
}

PhysicalRun run_held_out(const std::shared_ptr<const Library>& library, const HeldOutEpisode& episode,
                         const TrueWordsPlanner& planner) {
  RunOptions options;
  options.seed = episode.seed;
  options.observation.images = WhichFrames::none;
  if (planner) {
    options.planner_name = "learned";
    options.planner = [&](const Domain& domain, const Problem& problem) {
      return ask_learned(planner, episode, domain, problem);
    };
  }
  PreparedEpisode prepared(library, {episode.task, episode.variation, episode.seed}, options);
  EpisodeRecord record;
  try {
    record = prepared.run(nullptr);
  } catch (const Error& error) {
    if (!planner) throw;
    return {false, "refused_call", error.message()};  // a call that no skill takes: of things of other types
  }
  return {record.outcome == Outcome::success, std::string(to_string(record.reason)), record.detail};
}

}  // namespace

std::vector<PhysicalRun> run_in_physics(const std::vector<HeldOutEpisode>& episodes, const Roots& roots, int workers,
                                        const TrueWordsPlanner& planner) {
  const std::shared_ptr<const Library> library = Library::load_usable(roots);
  for (const HeldOutEpisode& one : episodes) task_info(*library, one.task);
  std::vector<PhysicalRun> runs(episodes.size());
  std::atomic<std::size_t> next = 0;
  std::exception_ptr first;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < episodes.size(); i = next++) try {
        runs[i] = run_held_out(library, episodes[i], planner);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!first) first = std::current_exception();
      }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < std::min(workers, static_cast<int>(episodes.size())); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (first) std::rethrow_exception(first);
  return runs;
}

}  // namespace stampede::research
