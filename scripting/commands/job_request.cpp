#include "scripting/commands/job_request.h"

#include <fmt/format.h>

#include "engine/model/camera.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/picture_options.h"

namespace stampede::program {

Shard shard_option(const Arguments& arguments) {
  try {
    return shard_from(arguments.text("--shard"));
  } catch (const Error& error) {
    throw UsageError(error.where() + ": " + error.message(), error.hint());
  }
}

JobRequest job_request(const Arguments& arguments, Split split) {
  JobRequest request;
  request.tasks = arguments.list("TASK");
  request.episodes = in_range(arguments, "--episodes", 1, kMostEpisodes);
  request.first_seed = arguments.integer("--seed").value_or(split == Split::test ? kFirstTestSeed : 0);
  if (request.first_seed > kLargestSeed) throw UsageError(fmt::format("--seed is at most {}", kLargestSeed));
  request.variation = arguments.text("--variation");
  if (arguments.has("--shard")) request.shard = shard_option(arguments);
  try {
    check_split(split, request.first_seed, request.first_seed + request.episodes - 1);
  } catch (const Error& error) {
    throw UsageError(error.where() + ": " + error.message(), error.hint());
  }
  return request;
}

// A camera may be mounted on what is in the scene, so each task's is asked, and before anything runs.
std::map<std::string, std::vector<Camera>> cameras_by_task(const std::shared_ptr<const Library>& library,
                                                           const JobList& jobs, const Arguments& arguments) {
  std::map<std::string, std::vector<Camera>> cameras;
  const auto given = [&](const char* option) { return arguments.has(option); };
  if (!given("--camera") && !given("--camera-file") && !given("--add-camera") && !given("--channels") &&
      !given("--noise"))
    return cameras;
  const ObservationChoice choice = picture_choice(arguments, PictureUse::run);
  for (const EpisodeJob& job : jobs.first_of_each_task()) {
    Scene scene = EpisodeScripts(library, job).task()(0).scene;
    const std::vector<Camera> further = cameras[job.task] = further_cameras(arguments, scene);
    put_cameras(scene, further);
    check_choice(choice, scene);
  }
  return cameras;
}

void tell_of(Progress& progress, Console& console, RunSettings& settings) {
  settings.progress = [&](const EpisodeRecord& episode, const RunTally& tally) {
    progress.update({tally.total, tally.done(), tally.finished, tally.succeeded, 0}, episode_line(episode));
  };
  settings.remark = [&](const Error& remark) { console.err << remark.what() << "\n"; };
}

std::string episode_line(const EpisodeRecord& episode) {
  const std::string name = episode.task + (episode.variation.empty() ? "" : " " + episode.variation);
  const double seconds = episode.duration_s();
  if (episode.outcome == Outcome::success)
    return fmt::format("{} seed {}: success, {:.1f} s", name, episode.seed, seconds);
  return fmt::format("{} seed {}: {}{}", name, episode.seed, to_string(episode.reason),
                     episode.detail.empty() ? "" : ", " + episode.detail);
}

}  // namespace stampede::program
