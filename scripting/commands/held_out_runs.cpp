#include "scripting/commands/held_out_runs.h"

#include <utility>
#include <variant>

#include "engine/base/error.h"
#include "engine/base/ordered_work.h"
#include "scripting/session/episode_job.h"

namespace stampede::program {
namespace {

using research::HeldOutEpisode, research::PhysicalRun, research::TrueWordsPlanner;

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
    options.planner.name = "learned";
    options.planner.plan = [&](const Domain& domain, const Problem& problem) {
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
  std::vector<std::string> tasks;
  for (const HeldOutEpisode& one : episodes) tasks.push_back(one.task);
  const std::shared_ptr<const Library> library = Library::load(roots, tasks);
  for (const std::string& task : tasks) task_info(*library, task);
  std::vector<PhysicalRun> runs;
  in_order(
      episodes.size(), {workers}, [] { return std::monostate{}; },
      [&](std::monostate, std::size_t i) { return run_held_out(library, episodes[i], planner); },
      [&](std::size_t, PhysicalRun run) { runs.push_back(std::move(run)); });
  return runs;
}

}  // namespace stampede::program
