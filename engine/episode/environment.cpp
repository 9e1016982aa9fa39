#include "stampede/environment.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/base/stopping.h"
#include "engine/episode/account.h"
#include "engine/episode/acting.h"
#include "engine/episode/dense_reward.h"
#include "engine/record/scene_record.h"
#include "engine/rollout/agent_action.h"
#include "engine/start/altered_task.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr const char* kRewardKinds[] = {"sparse", "dense", "task"};  // as RewardKind counts them

std::vector<StateFact> difference(const Facts& before, const Facts& now) {
  std::vector<StateFact> changes;
  for (const Fact& fact : now)
    if (!before.contains(fact)) changes.push_back({fact.predicate, fact.arguments, true, true});
  for (const Fact& fact : before)
    if (!now.contains(fact)) changes.push_back({fact.predicate, fact.arguments, false, true});
  return changes;
}

// Nothing else of an environment needs them.
bool observes_margins(const std::vector<std::string>& channels) {
  return std::any_of(channels.begin(), channels.end(), [](const std::string& name) {
    return name == "sensor/" + std::string(kMargins) || name == "sensor_time/" + std::string(kMargins);
  });
}

std::vector<SkillDescription> described_skills(const EpisodeSource::Opened& opened) {
  constexpr const char* kSources[] = {"value", "grasps", "sample"};
  std::vector<SkillDescription> list;
  for (const Action& action : opened.symbols->domain().actions) {
    const SkillInfo* info = opened.skills->skill(action.skill);
    if (info == nullptr) continue;
    SkillDescription& one = list.emplace_back();
    one.skill = action.name;
    one.controller = to_string(info->controller);
    for (const Parameter& parameter : action.parameters) {
      one.parameters.push_back(parameter.name);
      one.types.push_back(parameter.type.empty() ? "object" : parameter.type);
    }
    for (const ContinuousInfo& parameter : info->continuous)
      one.continuous.push_back({parameter.name, parameter.unit, parameter.frame, parameter.initial, parameter.lower,
                                parameter.upper, kSources[static_cast<std::size_t>(parameter.source)]});
  }
  return list;
}

}  // namespace

struct SavedState::Data {
  std::string task;
  ResetRequest request;  // that made its start
  std::string identity;  // of task, variation, seed and rates
  bool recorded = false;
  Rollout::Branch branch;
  SkillTrack::State track;
  ActingPlace place;
  std::optional<DenseReward::State> dense;
};

struct Environment::Impl {
  Impl(std::shared_ptr<EpisodeSource> source_in, EnvironmentSettings settings_in)
      : source(std::move(source_in)), settings(std::move(settings_in)) {}

  // What can be said of a task before it has begun.
  struct Outline {
    std::string task;
    double frame_hz = 0, horizon_s = 0;
    std::vector<ActionSpace> spaces;
    std::vector<SkillDescription> skills;
  };

  Acting& acting() const;
  const Outline& outline() const;
  EpisodeSource::Opened opened(const ResetRequest& request) const;
  void begin(const ResetRequest& request);
  void begin(const SavedState::Data& state);
  void go_to_frame(const EpisodeRecord& episode, std::int64_t frame);
  EnvironmentObservation observe();

  StepResult step(const AgentAction& action);
  double reward();

  std::shared_ptr<EpisodeSource> source;
  EnvironmentSettings settings;
  EnvironmentSettings present;  // of the episode that is under way: its perturbation may add noise
  ResetRequest request;         // likewise
  std::unique_ptr<Renderer> renderer;
  std::unique_ptr<Acting> now;
  mutable std::optional<Outline> drawn;
};

Acting& Environment::Impl::acting() const {
  if (!now) throw Error("Environment", "nothing has begun", "call reset() first");
  return *now;
}

EnvironmentObservation Environment::Impl::observe() {
  Acting& own = acting();
  return own.last ? *own.last : own.observer.observe();
}

EpisodeSource::Opened Environment::Impl::opened(const ResetRequest& asked) const {
  EpisodeSource::Opened opened = source->open(asked);
  opened.options.physics_hz = static_cast<int>(std::lround(settings.physics_hz));
  opened.options.frame_hz = static_cast<int>(std::lround(settings.frame_hz));
  opened.options.horizon_s = settings.horizon_s;
  return opened;
}

// Of the first variation, without a start: nothing is simulated.
const Environment::Impl::Outline& Environment::Impl::outline() const {
  if (!drawn) {
    const EpisodeSource::Opened first = opened({});
    const Task task = altered(first.draw(0), *first.symbols, first.options);
    drawn = Outline{task.name, static_cast<double>(task.scene.frame_hz), task.horizon_s, action_spaces(task.scene),
                    described_skills(first)};
  }
  return *drawn;
}

void Environment::Impl::begin(const ResetRequest& asked) {
  now.reset();
  EpisodeSource::Opened opened = this->opened(asked);
  RunOptions& options = opened.options;
  if (settings.torque_noise > 0) options.observation.torque_noise = settings.torque_noise;
  if (!settings.torque_model.empty()) options.observation.torque_model = torque_noise_from(settings.torque_model);
  const PreparedStart start = prepare_start(altered(opened.draw, *opened.symbols, options), *opened.symbols, options);
  if (observes_margins(settings.channels)) {
    auto& channels = options.observation.channels;
    if (!channels) channels = chosen(start.task.observation).channels;
    channels->emplace_back(kMargins);
  }
  EpisodeRecord record = described(start.task, *opened.symbols, options);
  record.made.draws = start.draws;
  if (start.reason != Reason::none) throw NoStart(start.task.name, start.reason, start.detail);
  if (settings.record) describe_scene(*start.scene, record);
  const SensorNoise further = further_noise(options.perturb);
  present = settings;
  present.rgb_noise += further.rgb;
  present.depth_noise += further.depth;
  now = std::make_unique<Acting>(std::move(opened), present, std::move(record), start, renderer);
  now->rollout.keep_record(settings.record);
  now->identity =
      content_hash(now->record.task + "\n" + now->record.variation + "\n" + std::to_string(now->record.seed) + "\n" +
                   std::to_string(start.scene->physics_hz) + "\n" + std::to_string(start.scene->frame_hz) + "\n" +
                   to_pddl(start.task.goal) + "\n" + asked.where + "\n" + asked.perturb +
                   (now->rollout.sensors().wants_margins() ? "\nmargins" : ""));
  request = asked;
  if (settings.record) {
    describe_beginning(now->rollout, now->record);
    now->record.labels.documents.push_back({DocumentKind::plan, {}});
  }
  if (settings.reward == RewardKind::dense)
    now->dense.emplace(now->rollout, *now->opened.symbols, draw_key("plan", now->record));
}

// The start that a state was saved from.
void Environment::Impl::begin(const SavedState::Data& state) {
  const std::string& task = now ? now->rollout.task().name : outline().task;  // the record may be given away
  if (state.task != task)
    throw Error("Environment", "the state is of task '" + state.task + "', not of '" + task + "'",
                "restore it into an environment of that task");
  begin(state.request);
}

// The same start again, and all that was commanded up to that frame: facts and what is known come about as they did.
void Environment::Impl::go_to_frame(const EpisodeRecord& episode, std::int64_t frame) {
  const std::string where = "episode of " + episode.task;
  if (frame < 0 || frame >= static_cast<std::int64_t>(episode.frames.size()))
    throw Error(where, "it has no frame " + std::to_string(frame),
                "frames count from 0 to " + std::to_string(episode.frames.size() - 1));
  Acting& own = *now;
  const Scene& scene = own.rollout.view().scene();
  if (scene.physics_hz != episode.physics_hz || scene.frame_hz != episode.frame_hz)
    throw Error(where, "it was recorded at other rates", "leave physics_hz and frame_hz as they are");
  if (scene_to_document(scene) != episode.scene.document)
    throw Error(where, "the scripts that are here now make another scene of it", "use those that it was recorded with");
  std::size_t next = 0;
  while (own.rollout.step() < frame * own.rollout.steps_per_frame()) {
    for (; next < episode.commands.size() && episode.commands[next].step == own.rollout.step(); ++next)
      own.rollout.world().apply(episode.commands[next].operation);
    own.rollout.advance();
  }
  own.controlled = true;
  own.track.advance_subgoals();
}

StepResult Environment::Impl::step(const AgentAction& action) {
  Acting& own = acting();
  StepResult result;
  own.observer.symbols().facts();  // as they are before
  own.rollout.world().forget_limited();
  const std::int64_t changes = own.rollout.facts().changes(), before_step = own.rollout.step();
  if (auto refusal = own.refusal_of(action))
    result.refusal = std::move(refusal);
  else
    result.refusal = own.do_asked(action, result);
  result.frames = (own.rollout.step() - before_step) / own.rollout.steps_per_frame();
  if (own.rollout.facts().changes() != changes) {
    const Facts before = own.observer.symbols().last_facts();
    result.changes = difference(before, own.observer.symbols().facts());
  }
  if (own.over != Reason::none || own.success) {
    result.success = own.success;
    result.truncated = own.over == Reason::timeout;
    result.terminated = !result.truncated;
    result.reason = to_string(own.over);
    if (own.over != Reason::none) result.detail = describe(own.over);
    if (own.over == Reason::sensor_error) result.detail = own.rollout.sensors().failure();
  }
  if (own.running.what != Running::What::nothing) result.running = own.running.name;
  if (lasts_a_frame(action.space)) result.limited = own.rollout.world().limited();
  // Success is rewarded once; what says how things stand does so again.
  result.reward = result.refusal && settings.reward == RewardKind::sparse ? 0 : reward();
  own.note_result(result);
  result.observation = observe();
  return result;
}

double Environment::Impl::reward() {
  Acting& own = *now;
  switch (settings.reward) {
    case RewardKind::sparse:
      return own.success ? 1 : 0;
    case RewardKind::dense:
      return own.dense->value();
    case RewardKind::task:
      break;
  }
  const Task& task = own.rollout.task();
  return (task.reward ? task.reward(own.rollout.view()) : 0) + (own.success ? 1 : 0);
}

Environment::Environment(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Environment::~Environment() = default;
Environment::Environment(Environment&&) noexcept = default;
Environment& Environment::operator=(Environment&&) noexcept = default;

EnvironmentObservation Environment::reset(const ResetRequest& request) {
  if (request.channels) impl_->settings.channels = *request.channels;
  if (!request.episode) {
    impl_->begin(request);
    return impl_->observe();
  }
  const std::shared_ptr<const EpisodeRecord> record = impl_->source->record_of(*request.episode);
  ResetRequest same = request;
  same.variation = record->variation;
  same.seed = record->seed;
  const auto option = [&](const char* name) {
    const auto found = record->made.options.find(name);
    return found == record->made.options.end() ? std::string() : found->second;
  };
  same.where = option("where");
  same.goal = option("goal");
  same.randomise = !option("randomise").empty();
  same.perturb = option("perturb");
  same.episode.reset();
  impl_->begin(same);
  impl_->go_to_frame(*record, request.frame);
  return impl_->observe();
}

EnvironmentObservation Environment::reset_to(const SavedState& state) {
  const std::unique_ptr<Acting>& now = impl_->now;
  if (state.data && (!now || now->ended || now->identity != state.data->identity)) impl_->begin(*state.data);
  return restore(state);
}

StepResult Environment::step(const AgentAction& action) {
  try {
    return impl_->step(action);
  } catch (const Interruption&) {
    impl_->now.reset();  // in the midst of a step there is nothing to go on with
    throw;
  } catch (const Interrupted&) {
    impl_->now.reset();
    throw;
  }
}

double Environment::frame_hz() const {
  return impl_->now ? impl_->now->rollout.view().scene().frame_hz : impl_->outline().frame_hz;
}

double Environment::horizon_s() const {
  if (!impl_->now) return impl_->outline().horizon_s;
  const Rollout& rollout = impl_->now->rollout;
  return static_cast<double>(rollout.horizon_steps()) / rollout.view().scene().physics_hz;
}

std::vector<std::string> Environment::instructions() const {
  std::vector<std::string> sentences;
  for (const LanguageRecord& one : impl_->acting().record.labels.language)
    if (one.level == LanguageLevel::task) sentences.push_back(one.text);
  return sentences;
}

std::vector<ActionSpace> Environment::spaces() const {
  return impl_->now ? impl_->now->spaces : impl_->outline().spaces;
}

std::vector<SkillChoice> Environment::skills() const {
  SymbolChannels& symbols = impl_->acting().observer.symbols();
  const std::vector<std::uint8_t>& mask = symbols.feasible();
  std::vector<SkillChoice> choices;
  for (std::size_t i = 0; i < mask.size(); ++i)
    choices.push_back({symbols.skills()[i].action, symbols.skills()[i].arguments, mask[i] != 0});
  return choices;
}

std::vector<SkillDescription> Environment::skill_descriptions() const {
  return impl_->now ? described_skills(impl_->now->opened) : impl_->outline().skills;
}

EnvironmentObservation Environment::observe() const { return impl_->observe(); }

ChannelValue Environment::picture(const std::string& camera, PictureSize size) const {
  return impl_->acting().observer.picture(camera, size);
}

std::vector<StateFact> Environment::atoms() const {
  std::vector<StateFact> atoms;
  for (const Fact& fact : impl_->acting().observer.symbols().atoms()) atoms.push_back({fact.predicate, fact.arguments});
  return atoms;
}

SavedState Environment::save() {
  Acting& own = impl_->acting();
  if (own.running.what != Running::What::nothing)
    throw Error("Environment::save", own.running.name + " is under way", "let it go_on to its end, or act otherwise");
  auto data = std::make_shared<SavedState::Data>(SavedState::Data{
      own.rollout.task().name, impl_->request, own.identity, impl_->settings.record, own.rollout.branch(),
      own.track.state(), own, own.dense ? std::optional(own.dense->state()) : std::nullopt});
  return {std::move(data)};
}

EnvironmentObservation Environment::restore(const SavedState& state) {
  if (!state.data) throw Error("Environment::restore", "an empty state", "take it with save()");
  if (!impl_->now) impl_->begin(*state.data);
  Acting& own = impl_->acting();
  if (state.data->identity != own.identity)
    throw Error("Environment::restore",
                "the state is of another task, variation, seed or rate, or only one of both reads margins",
                "reset the environment to what it was when the state was saved");
  if (impl_->settings.record && !state.data->recorded)
    throw Error("Environment::restore", "the state was saved without a record, and this environment keeps one",
                "set EnvironmentSettings::record in both or in neither");
  if (own.ended) throw Error("Environment::restore", "the episode was ended by episode()", "call reset() first");
  StepResult ignored;
  own.end_running(ignored, "another state was restored");
  const SavedState::Data& data = *state.data;
  own.rollout.restore(data.branch);
  own.track.restore(data.track);
  static_cast<ActingPlace&>(own) = data.place;
  own.over = data.branch.ended;
  if (own.dense && data.dense) own.dense->restore(*data.dense);
  own.success = false;
  own.observer.forget();
  return impl_->observe();
}

Episode Environment::episode() {
  Acting& own = impl_->acting();
  if (!impl_->settings.record)
    throw Error("Environment::episode", "nothing was recorded", "set EnvironmentSettings::record");
  if (own.ended) throw Error("Environment::episode", "it was taken already", "call reset()");
  SkillResult verdict;
  if (!own.success && own.over != Reason::none) verdict = {own.over, std::string(describe(own.over)), true};
  if (!own.success && own.over == Reason::none)
    verdict = {Reason::goal_false, "the agent ended the episode before the goal had held long enough"};
  own.record.made.options["reward"] = kRewardKinds[static_cast<std::size_t>(impl_->settings.reward)];
  own.finish(verdict);
  return impl_->source->close(std::move(own.record), own.opened.owner);
}

Environment make_environment(std::shared_ptr<EpisodeSource> source, EnvironmentSettings settings) {
  return Environment(std::make_unique<Environment::Impl>(std::move(source), std::move(settings)));
}

namespace {

const auto& as(const ChannelValue& value, const auto* kind, const char* type) {
  using Kind = std::remove_cvref_t<decltype(*kind)>;
  if (const auto* data = std::get_if<Kind>(&value.data)) return *data;
  throw Error("channel '" + value.name + "'", std::string("its values are no ") + type);
}

}  // namespace

const std::vector<double>& ChannelValue::reals() const {
  return as(*this, static_cast<const std::vector<double>*>(nullptr), "float64");
}
const std::vector<std::uint8_t>& ChannelValue::bytes() const {
  return as(*this, static_cast<const std::vector<std::uint8_t>*>(nullptr), "uint8");
}
const std::vector<std::string>& ChannelValue::texts() const {
  return as(*this, static_cast<const std::vector<std::string>*>(nullptr), "texts");
}

const ChannelValue& EnvironmentObservation::operator[](std::string_view name) const {
  for (const ChannelValue& one : channels)
    if (one.name == name) return one;
  throw Error("channel '" + std::string(name) + "'", "it was not asked for", did_you_mean(name, names_of(channels)));
}

}  // namespace stampede
