#include "scripting/session/session_core.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <thread>

#include "engine/base/names.h"
#include "engine/base/processor.h"
#include "engine/base/stopping.h"
#include "engine/episode/episode_source.h"
#include "engine/motion/planner.h"
#include "engine/record/arrays.h"
#include "engine/sim/numerics.h"
#include "engine/symbolic/pddl.h"
#include "engine/symbolic/task_planner.h"
#include "scripting/library/roots.h"
#include "scripting/runtime/assets.h"
#include "scripting/session/constraints_fit.h"
#include "scripting/session/episode_job.h"
#include "scripting/session/evaluation.h"
#include "scripting/session/own_words.h"
#include "scripting/session/policies_fit.h"
#include "scripting/session/run_job.h"
#include "scripting/session/settings_fit.h"
#include "scripting/session/start_question.h"

namespace stampede {
namespace {

WhichFrames which(PicturesOf frames) {
  switch (frames) {
    case PicturesOf::none:
      return WhichFrames::none;
    case PicturesOf::keyframes:
      return WhichFrames::keyframes;
    case PicturesOf::all:
      return WhichFrames::all;
  }
  return WhichFrames::none;
}

// All of it: who asks for pictures leaves nothing to the world.
ObservationChoice choice_of(const PictureStorage& wanted) {
  ObservationChoice choice;
  choice.images = which(wanted.frames);
  choice.cameras = wanted.cameras;
  if (wanted.width != 0 || wanted.height != 0) choice.size = {wanted.width, wanted.height};
  choice.kinds = PictureKinds{wanted.rgb, wanted.depth, wanted.instance, wanted.semantic};
  choice.points = wanted.points;
  choice.shadows = wanted.shadows;
  if (wanted.renderer != DrawnBy::own) choice.renderer = wanted.renderer;
  choice.rgb_noise = wanted.rgb_noise;
  choice.depth_noise = wanted.depth_noise;
  return choice;
}

RunOptions options_of(const EpisodeRequest& request) {
  RunOptions options;
  if (!request.where.empty()) options.where = formula_option(request.where, "EpisodeRequest::where");
  if (!request.goal.empty()) options.goal = formula_option(request.goal, "EpisodeRequest::goal");
  if (request.skills < 1) throw Error("EpisodeRequest::skills", "it is at least 1");
  options.behaviour = request.behaviour;
  options.skills = request.skills;
  options.on_failure = request.on_failure;
  if (!request.controller.empty()) check_controller(request.controller, "EpisodeRequest::controller");
  options.controller = request.controller;
  check_motion_planner(request.motion_planner, "EpisodeRequest::motion_planner");
  options.motion_planner = request.motion_planner;
  if (request.pictures) options.observation = choice_of(*request.pictures);
  if (request.randomise) options.randomise = default_randomisation();
  options.split = request.seed >= kFirstTestSeed ? Split::test : Split::train;
  check_split(options.split, request.seed, request.seed);
  return options;
}

Episode told(const EpisodeRecord& record) {
  Episode episode;
  episode.key = record.made.key;
  episode.task = record.task;
  episode.variation = record.variation;
  episode.seed = record.seed;
  episode.outcome = record.outcome;
  episode.reason = to_string(record.reason);
  episode.detail = record.detail;
  episode.frames = static_cast<std::int64_t>(record.frames.size());
  episode.duration_s = record.duration_s();
  episode.undone = static_cast<int>(record.labels.attempts.size());
  return episode;
}

std::vector<std::string> keys_in(const Catalogue& catalogue) {
  std::vector<std::string> keys;
  for (const auto& row : catalogue.query("SELECT key FROM episode", {{}, 0}).rows)
    keys.push_back(std::get<std::string>(row[0]));
  return keys;
}

// `where`: the request's own type, for complaints.
JobList jobs_of(const std::shared_ptr<const Library>& library, const std::string& where, const RunRequest& asked,
                const RunOptions& options) {
  if (asked.tasks.empty()) throw Error(where + "::tasks", "no task is named", "name one of Session::tasks()");
  if (asked.episodes < 1) throw Error(where + "::episodes", "it is at least 1");
  if (asked.workers < 1) throw Error(where + "::workers", "it is at least 1");
  if (options.split == Split::train && asked.each.seed + asked.episodes > kFirstTestSeed)
    throw Error(
        where,
        "seeds from " + std::to_string(kFirstTestSeed) + " up belong to the test split, those below to the other",
        "ask for the episodes of each split by themselves");
  check_shard(asked.shard, where + "::shard");
  JobRequest request{asked.tasks, asked.episodes, asked.each.seed, asked.each.variation};
  request.shard = asked.shard;
  if (options.where || options.goal) {
    request.variations.emplace();
    for (const std::string& task : asked.tasks)
      (*request.variations)[task] =
          fitting_variations(library, task, matching_variations(task_info(*library, task), asked.each.variation),
                             asked.each.seed, options);
  }
  return JobList(*library, request);
}

TaskPlan told(const PlanOutcome& outcome) {
  TaskPlan plan;
  plan.found = outcome.solved;
  plan.end = to_text(outcome.end);
  plan.explanation = outcome.explanation;
  for (const PlanStep& step : outcome.plan) plan.steps.push_back({step.action, step.arguments});
  return plan;
}

}  // namespace

SessionCore::SessionCore(const std::filesystem::path& root, const std::vector<std::filesystem::path>& paths,
                         std::filesystem::path catalogue)
    : library_(in_own_words([&] { return Library::load(make_roots(root, paths)); })), path_(std::move(catalogue)) {
  if (path_ == ":memory:")
    throw Error("SessionOptions::catalogue", "a catalogue is a file",
                "leave it empty: what `run` gives then holds the whole episode");
}

std::vector<std::string> SessionCore::tasks() const { return names_of(library_->files(DefinitionKind::task)); }

std::vector<std::string> SessionCore::variations(const std::string& task) const {
  return task_info(*library_, task).variation_texts;
}

std::optional<Episode> SessionCore::stored(const std::string& key) {
  if (path_.empty() || (!catalogue_ && !std::filesystem::exists(path_))) return std::nullopt;
  const std::optional<std::int64_t> id = catalogue_to_write().find(key);
  if (!id) return std::nullopt;
  Episode episode = told(catalogue().read_episode(*id));
  episode.id = *id;
  return episode;
}

RunOptions SessionCore::options_for(const EpisodeRequest& request) const {
  RunOptions options = options_of(request);
  options.set = settings_from(request.set, *library_, "EpisodeRequest::set");
  options.policies = policies_;
  options.sensors = sensors_;
  options.services.encoders = usable_cores() - 1;  // of an episode alone
  return options;
}

PreparedEpisode SessionCore::prepare(const std::string& task, const EpisodeRequest& request,
                                     const Perturbation& perturb, std::shared_ptr<Assets> assets) const {
  return in_own_words([&]() -> PreparedEpisode {
    RunOptions options = options_for(request);
    options.perturb = perturb;
    const std::vector<std::string> variations = fitting_variations(
        library_, task, matching_variations(task_info(*library_, task), request.variation), request.seed, options);
    return {library_, {task, variations.empty() ? "" : variations.front(), request.seed}, options, std::move(assets)};
  });
}

Episode SessionCore::run(const std::string& task_name, const EpisodeRequest& request) {
  PreparedEpisode prepared = prepare(task_name, request);
  if (auto episode = stored(prepared.key())) return *episode;
  const std::atomic<bool>* const stop = stop_of_this_thread();
  check_policies(library_, {prepared.job()}, prepared.options(), stop);
  EpisodeRecord record = prepared.run(stop);
  if (record.reason == Reason::interrupted) throw Interrupted();
  return keep(std::move(record));
}

Episode SessionCore::keep(EpisodeRecord made) {
  auto record = std::make_shared<const EpisodeRecord>(std::move(made));
  Episode episode = told(*record);
  if (path_.empty())
    episode.record = std::move(record);
  else
    episode.id = catalogue_to_write().add(*record, {STAMPEDE_VERSION, numerics_probe()});
  return episode;
}

Episode SessionCore::keep_for(const RunRequest& request, EpisodeRecord made) {
  if (!request.sink) {
    const std::lock_guard lock(mutex_);
    const std::optional<std::int64_t> id = catalogue_to_write().add_if_new(made, {STAMPEDE_VERSION, numerics_probe()});
    Episode episode = told(made);
    episode.id = id ? *id : catalogue_to_write().find(made.made.key).value_or(0);  // another run may have been faster
    return episode;
  }
  Episode episode = told(made);
  episode.record = std::make_shared<const EpisodeRecord>(std::move(made));
  request.sink(episode);
  return episode;
}

// Workers run the episodes; this thread keeps them and calls the program's functions.
RunTally SessionCore::run_all(const RunRequest& request) {
  RunSettings settings;
  settings.options = in_own_words([&] { return options_for(request.each); });
  settings.workers = request.workers;
  settings.stop = request.stop;
  const JobList jobs = in_own_words([&] { return jobs_of(library_, "RunRequest", request, settings.options); });
  EpisodeQueue queue(queue_bytes(settings));
  if (!request.sink) {
    if (path_.empty())
      throw Error("RunRequest", "nobody would keep the episodes", "set SessionOptions::catalogue, or RunRequest::sink");
    const std::lock_guard lock(mutex_);
    queue.know(keys_in(catalogue_to_write()));
  }
  RunTally tally;
  std::exception_ptr failed, thrown;  // by the workers; by who keeps the episodes, and by the program's functions
  std::thread workers([&] {
    try {
      tally = run_jobs(library_, jobs, settings, &queue);
    } catch (...) {
      failed = std::current_exception();
    }
    queue.end();
  });
  while (auto next = queue.next()) {
    bool kept = false;
    try {
      const Episode episode = keep_for(request, std::move(next->episode));
      kept = true;
      if (request.progress && !thrown) request.progress({episode, next->place + 1, jobs.size()});
    } catch (...) {
      if (!thrown) thrown = std::current_exception();
      queue.fail(thrown);
      if (!kept) break;
    }
  }
  workers.join();
  if (thrown) std::rethrow_exception(thrown);
  if (failed) std::rethrow_exception(failed);
  return tally;
}

// A task of this session, for an environment.
class TaskSource final : public EpisodeSource {
 public:
  TaskSource(std::shared_ptr<SessionCore> core, std::string task)
      : core_(std::move(core)), task_(std::move(task)), assets_(assets_of(*core_->library_)) {}

  Opened open(const ResetRequest& request) override {
    const std::lock_guard lock(core_->mutex_);
    EpisodeRequest same;
    same.variation = request.variation, same.seed = request.seed;
    same.where = request.where, same.goal = request.goal, same.randomise = request.randomise;
    const Perturbation perturb =
        request.perturb.empty() ? Perturbation{} : perturbation_from(request.perturb, "ResetRequest::perturb");
    const std::shared_ptr<PreparedEpisode> prepared(
        new PreparedEpisode(core_->prepare(task_, same, perturb, assets_)));  // it cannot move
    return {prepared->scripts().task(), &prepared->scripts().symbols(), &prepared->scripts().skills(),
            prepared->options(), prepared};
  }

  Episode close(EpisodeRecord record, const std::shared_ptr<void>& owner) override {
    const std::lock_guard lock(core_->mutex_);
    static_cast<const PreparedEpisode*>(owner.get())->complete(record);
    record.made.key = acted_key(record);
    if (auto episode = core_->stored(record.made.key)) return *episode;
    return core_->keep(std::move(record));
  }

  std::shared_ptr<const EpisodeRecord> record_of(const Episode& episode) override {
    const std::lock_guard lock(core_->mutex_);
    auto record = core_->record_of(episode);
    if (record->task != task_)
      throw Error("ResetRequest::episode", "it is of task '" + record->task + "', not of '" + task_ + "'",
                  "make an environment of that task");
    return record;
  }

 private:
  std::shared_ptr<SessionCore> core_;
  std::string task_;
  std::shared_ptr<Assets> assets_;  // of all its episodes
};

// What runs already keeps those that it began with.
void SessionCore::add_policy(const std::string& name, PolicyEntry entry) {
  if (name.empty() || !entry.make)
    throw Error("Session::add_policy", "a policy has a name, and a function that makes one");
  const std::lock_guard lock(mutex_);
  auto all = policies_ ? *policies_ : std::map<std::string, PolicyEntry>{};
  all[name] = std::move(entry);
  policies_ = std::make_shared<const std::map<std::string, PolicyEntry>>(std::move(all));
}

// The name becomes part of names of columns, and of an option.
void SessionCore::add_sensor(const std::string& name, SensorEntry entry) {
  const std::string where = "Session::add_sensor";
  const auto letter = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), letter))
    throw Error(where, "'" + name + "' is no name for a sensor", "use letters, digits and _");
  if (!entry.read) throw Error(where, "sensor '" + name + "' has no function that reads it", "set SensorEntry::read");
  if (entry.components.empty() || std::count(entry.components.begin(), entry.components.end(), std::string()) > 0)
    throw Error(where, "sensor '" + name + "' does not say what its values are called",
                "give SensorEntry::components a name for each value");
  if (entry.rate_hz < 1) throw Error(where, "sensor '" + name + "' is never read", "set SensorEntry::rate_hz");
  const std::lock_guard lock(mutex_);
  auto all = sensors_ ? *sensors_ : std::map<std::string, SensorEntry>{};
  all[name] = std::move(entry);
  sensors_ = std::make_shared<const std::map<std::string, SensorEntry>>(std::move(all));
}

Environment SessionCore::environment(const std::string& task, const EnvironmentSettings& settings) {
  task_info(*library_, task);  // throws for one that is not there
  return make_environment(std::make_shared<TaskSource>(shared_from_this(), task), settings);
}

Evaluation SessionCore::evaluate(const std::vector<std::string>& tasks, const EvaluationRequest& request) {
  const std::lock_guard lock(mutex_);
  RunRequest asked;
  asked.tasks = tasks;
  asked.episodes = request.episodes;
  asked.workers = request.workers;
  asked.shard = request.shard;
  asked.each.seed = request.first_seed;
  asked.each.variation = request.variation;
  EvaluationSettings settings;
  settings.perturb = request.perturb;
  settings.run.options = in_own_words([&] { return options_for(asked.each); });
  settings.run.workers = request.workers;
  settings.run.stop = request.stop;
  if (request.policy) settings.run.act = [&](PreparedEpisode& prepared) { return act_as(prepared, request); };
  const JobList jobs =
      in_own_words([&] { return jobs_of(library_, "EvaluationRequest", asked, settings.run.options); });
  if (path_.empty()) return stampede::evaluate(library_, jobs, settings, nullptr);
  catalogue_.reset();  // one writer at a time
  writable_ = false;
  return stampede::evaluate(library_, jobs, settings, [&] {
    CatalogueWriterOptions writing;
    writing.engine = {STAMPEDE_VERSION, numerics_probe()};
    writing.queue_bytes = queue_bytes(settings.run);
    return std::make_unique<CatalogueWriter>(path_, std::move(writing));
  });
}

TaskPlan SessionCore::plan(const std::string& task, const EpisodeRequest& request) const {
  PreparedEpisode prepared = prepare(task, request);
  const StartQuestion question = question_at_start(prepared.scripts(), prepared.options(), nullptr);
  TaskPlan plan;
  if (question.start.reason != Reason::none) {
    plan.end = "no start: " + std::string(to_string(question.start.reason));
    plan.explanation = question.start.detail;
    return plan;
  }
  plan = told(question.said ? *question.said : solve(question.asked.domain, question.asked.problem));
  if (!plan.found) plan.explanation += why_not_assumed(question.not_assumed, plan.explanation);
  PddlTexts texts = pddl_of(question, prepared.scripts().symbols().domain(), false);
  plan.domain = std::move(texts.domain);
  plan.problem = std::move(texts.problem);
  for (const Fact& fact : question.assumed) plan.assumed.push_back(to_text(fact));
  return plan;
}

TaskPlan plan_of_texts(const std::string& domain_text, const std::string& problem_text) {
  const Domain domain = domain_from_pddl(domain_text, "domain");
  const Problem problem = problem_from_pddl(problem_text, "problem", domain);
  TaskPlan plan = told(solve(domain, problem));
  plan.domain = domain_text;
  plan.problem = problem_text;
  return plan;
}

Catalogue& SessionCore::catalogue() {
  if (path_.empty())
    throw Error("Session", "it has no catalogue to ask",
                "set SessionOptions::catalogue, or name the episode by what `run` gave");
  if (!catalogue_) catalogue_.emplace(Catalogue::open(path_));
  return *catalogue_;
}

Catalogue& SessionCore::catalogue_to_write() {
  if (!writable_) {
    catalogue_.reset();
    catalogue_.emplace(Catalogue::write(path_));
    writable_ = true;
  }
  return *catalogue_;
}

Rows SessionCore::query(std::string_view question, const std::vector<SqlValue>& parameters) {
  return catalogue().query(question, {parameters, 0});
}

std::shared_ptr<const EpisodeRecord> SessionCore::record_of(const Episode& episode) {
  if (episode.record) return episode.record;
  if (record_id_ != episode.id) {
    record_ = std::make_shared<const EpisodeRecord>(catalogue().read_episode(episode.id));
    record_id_ = episode.id;
  }
  return record_;
}

CameraPicture SessionCore::picture(const Episode& episode, std::int64_t frame, const PictureRequest& request) {
  if (!studio_) studio_.emplace();
  return studio_->picture(record_of(episode), frame, request);
}

CameraPoints SessionCore::points(const Episode& episode, std::int64_t frame, const PictureRequest& request) {
  if (!studio_) studio_.emplace();
  return studio_->points(record_of(episode), frame, request);
}

WorldState SessionCore::state(const Episode& episode, std::int64_t frame) {
  return world_state(*record_of(episode), frame);
}

EpisodeArrays SessionCore::arrays(const Episode& episode, const ArrayRequest& request) {
  return episode.record ? episode_arrays(*episode.record, request) : catalogue().read_arrays(episode.id, request);
}

}  // namespace stampede
