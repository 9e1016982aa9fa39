#include "scripting/session/evaluation.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <utility>

#include "engine/base/stopping.h"
#include "engine/start/perturbation.h"
#include "scripting/runtime/script_error.h"
#include "scripting/session/prepared_source.h"
#include "stampede/environment.h"

namespace stampede {
namespace {

constexpr int kMostPolicyRefusals = 100;  // in a row, without a frame going by

double share(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

// The same one in each run of the episode.
std::string instruction_of(PreparedEpisode& prepared) {
  const EpisodeJob& job = prepared.job();
  const std::vector<std::string> all = instructions_of(prepared);
  if (all.empty()) return {};
  Random random(RandomKey("instruction").with(job.task).with(job.variation).with(job.seed));
  return all[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(all.size())))];
}

// Acts until the episode is over. What went wrong, or nothing.
std::string let_act(Policy& policy, Environment& world, EnvironmentObservation seen, const std::atomic<bool>* stop) {
  for (int refusals = 0; !(stop && stop->load());) {
    const std::optional<AgentAction> action = policy.act(seen);
    if (!action) return {};
    StepResult result = world.step(*action);
    if (result.terminated || result.truncated) return {};
    refusals = result.frames > 0 ? 0 : refusals + 1;
    if (refusals >= kMostPolicyRefusals)
      return "no frame went by in " + std::to_string(refusals) + " actions" +
             (result.refusal ? "; the last was refused: " + result.refusal->what : "");
    seen = std::move(result.observation);
  }
  return {};
}

}  // namespace

std::pair<double, double> wilson_interval(std::int64_t succeeded, std::int64_t episodes) {
  if (episodes == 0) return {0, 1};
  constexpr double z = 1.959963984540054;
  const auto n = static_cast<double>(episodes);
  const double p = static_cast<double>(succeeded) / n, scale = 1 + z * z / n;
  const double centre = (p + z * z / (2 * n)) / scale;
  const double half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / scale;
  return {succeeded == 0 ? 0 : centre - half, succeeded == episodes ? 1 : centre + half};
}

void EvaluationTable::Count::add(const EpisodeRecord& episode) {
  ++episodes;
  microseconds += std::llround(1e6 * episode.duration_s());
  for (const FrameRecord& frame : episode.frames) returned += std::llround(1e6 * frame.reward);
  if (episode.outcome == Outcome::success)
    ++succeeded;
  else
    ++reasons[std::string(to_string(episode.reason))];
}

EvaluationRow EvaluationTable::Count::row() const {
  EvaluationRow row;
  row.episodes = episodes;
  row.succeeded = succeeded;
  row.success = share(succeeded, episodes);
  std::tie(row.lower, row.upper) = wilson_interval(succeeded, episodes);
  row.mean_return = 1e-6 * share(returned, episodes);
  row.mean_length_s = 1e-6 * share(microseconds, episodes);
  row.reasons = reasons;
  return row;
}

void EvaluationTable::add(const std::string& perturbation, const EpisodeRecord& episode) {
  std::map<Place, Count>& counts = counts_[perturbation];
  counts[{}].add(episode);
  counts[{episode.task, {}, {}}].add(episode);
  for (const auto& [axis, value] : episode.axes) counts[{episode.task, axis, value}].add(episode);
}

std::vector<EvaluationRow> EvaluationTable::rows(const std::vector<std::string>& perturbations) const {
  std::vector<EvaluationRow> rows;
  for (const std::string& perturbation : perturbations) {
    const auto found = counts_.find(perturbation);
    if (found == counts_.end()) continue;
    const auto put = [&](const Place& place, const Count& count) {
      EvaluationRow row = count.row();
      row.perturbation = perturbation;
      row.task = place.task, row.axis = place.axis, row.value = place.value;
      rows.push_back(std::move(row));
    };
    const auto tasks = std::count_if(found->second.begin(), found->second.end(), [](const auto& entry) {
      return !entry.first.task.empty() && entry.first.axis.empty();
    });
    for (const auto& [place, count] : found->second)
      if (!place.task.empty()) put(place, count);
    if (tasks > 1) put({}, found->second.at({}));
  }
  return rows;
}

Evaluation evaluate(const std::shared_ptr<const Library>& library, const JobList& jobs, EvaluationSettings settings,
                    const std::function<std::unique_ptr<CatalogueWriter>()>& open) {
  std::vector<std::pair<std::string, Perturbation>> trials = {{kUndisturbed, {}}};
  for (const std::string& text : settings.perturb) {
    Perturbation perturbation = perturbation_from(text, "perturb");
    std::string name = to_text(perturbation);
    const bool there = std::any_of(trials.begin(), trials.end(), [&](const auto& one) { return one.first == name; });
    if (!there) trials.emplace_back(std::move(name), std::move(perturbation));
  }
  Evaluation answer;
  EvaluationTable table;
  RunTally all;
  all.total = jobs.size() * static_cast<std::int64_t>(trials.size());
  std::mutex mutex;
  std::vector<std::string> names;
  for (const auto& [name, perturbation] : trials) {
    names.push_back(name);
    RunSettings run = settings.run;
    run.options.perturb = perturbation;
    run.progress = nullptr;
    run.act = [&, trial = name](PreparedEpisode& prepared) {
      EpisodeRecord episode = settings.run.act ? settings.run.act(prepared) : prepared.run(run.stop);
      if (episode.reason == Reason::interrupted) return episode;
      const std::lock_guard lock(mutex);
      table.add(trial, episode);
      ++all.finished;
      if (episode.outcome == Outcome::success) ++all.succeeded;
      if (settings.run.progress) settings.run.progress(episode, all);
      return episode;
    };
    const std::unique_ptr<CatalogueWriter> writer = open ? open() : nullptr;
    answer.interrupted = run_jobs(library, jobs, run, writer.get()).interrupted;
    if (writer) writer->finish();
    if (answer.interrupted) break;
  }
  answer.interrupted |= all.finished < all.total;
  answer.rows = table.rows(names);
  return answer;
}

EpisodeRecord act_as(PreparedEpisode& prepared, const EvaluationRequest& request) {
  const auto source = std::make_shared<PreparedSource>(prepared, request.policy_name);
  EnvironmentSettings settings = request.settings;
  settings.record = true;
  std::string mistake;
  try {
    Environment world = make_environment(source, settings);
    const EnvironmentObservation seen = world.reset();
    try {
      const std::unique_ptr<Policy> policy = request.policy();
      if (!policy) throw Error("policy", "the function that makes one gave none");
      PolicyCall call;
      call.task = prepared.job().task;
      call.instruction = instruction_of(prepared);
      policy->begin(call);
      mistake = let_act(*policy, world, seen, request.stop);
    } catch (const ScriptError&) {
      throw;
    } catch (const Interruption&) {
      throw;
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception& error) {
      mistake = std::string("it threw: ") + error.what();
    } catch (...) {
      mistake = "it threw what is no std::exception";
    }
    world.episode();
  } catch (const NoStart& error) {
    return source->failed(error.reason(), error.detail());
  } catch (const ScriptError& error) {
    return source->failed(Reason::script_error, error.what());
  }
  EpisodeRecord record = source->take();
  if (request.stop && request.stop->load()) record.reason = Reason::interrupted;
  if (mistake.empty()) return record;
  record.outcome = Outcome::failure;
  record.reason = Reason::policy_error;
  record.detail = std::move(mistake);
  return record;
}

}  // namespace stampede
