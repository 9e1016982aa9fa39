#include "engine/rollout/observer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"
#include "engine/model/camera.h"
#include "engine/render/point_cloud.h"
#include "engine/rollout/assumptions.h"
#include "engine/start/effects.h"
#include "engine/start/language.h"
#include "engine/start/planning.h"
#include "engine/symbolic/drawn_choice.h"
#include "engine/symbolic/instances.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr const char* kAbstract[] = {"facts",     "known", "applicable", "fact_names", "feasible_skills", "pddl",
                                     "sentences", "plan",  "progress",   "goal",       "tool_jacobian"};
constexpr std::string_view kPoseIn = "object_pose_in/";
// Columns of a whole episode that say nothing of one moment, or are made here from the running world.
constexpr const char* kNotNow[] = {"reward",     "done",  "facts",   "known", "progress",
                                   "applicable", "skill", "subgoal", "motion"};
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

std::int64_t count_of(std::size_t size) { return static_cast<std::int64_t>(size); }

bool named(std::string_view name, const std::vector<std::string>& wanted) {
  return std::any_of(wanted.begin(), wanted.end(), [&](const std::string& one) {
    return name == one || (name.starts_with(one) && name.substr(one.size()).starts_with("/"));
  });
}

ChannelValue value_of(ArrayColumn column) {
  ChannelValue value;
  value.name = std::move(column.name);
  value.unit = std::move(column.unit);
  value.frame = std::move(column.frame);
  value.shape = std::move(column.shape);
  value.labels = std::move(column.labels);
  if (column.rate_hz > 0 && !value.shape.empty()) value.shape.erase(value.shape.begin());
  std::visit([&](auto& data) { value.data = std::move(data); }, column.data);
  auto* reals = std::get_if<std::vector<double>>(&value.data);
  if (reals != nullptr && reals->empty()) {  // a sensor that has not been read yet
    std::size_t count = 1;
    for (const std::int64_t extent : value.shape) count *= static_cast<std::size_t>(extent);
    reals->assign(count, kUnknown);
  }
  return value;
}

std::vector<std::string> names_of(const std::vector<PlanStep>& steps) {
  std::vector<std::string> names;
  for (const PlanStep& step : steps) names.push_back(to_text(Fact{step.action, step.arguments}));
  return names;
}

std::vector<std::string> names_of(const std::vector<stampede::Camera>& cameras) {
  std::vector<std::string> names;
  for (const stampede::Camera& camera : cameras) names.push_back(camera.name);
  return names;
}

const stampede::Camera& named_camera(const std::vector<stampede::Camera>& cameras, const std::string& name) {
  const auto camera =
      std::find_if(cameras.begin(), cameras.end(), [&](const stampede::Camera& one) { return one.name == name; });
  if (camera != cameras.end()) return *camera;
  throw Error("camera '" + name + "'", "there is no such camera", did_you_mean(name, names_of(cameras)));
}

// Throws Error for sizes of cameras that there are not.
void size_cameras(std::vector<stampede::Camera>& cameras, const EnvironmentSettings& settings) {
  for (const auto& [name, size] : settings.picture_sizes) named_camera(cameras, name);
  for (stampede::Camera& camera : cameras) {
    const auto own = settings.picture_sizes.find(camera.name);
    const PictureSize size =
        own == settings.picture_sizes.end() ? PictureSize{settings.width, settings.height} : own->second;
    if (size.width > 0 && size.height > 0) camera = resized(camera, size.width, size.height);
  }
}

bool has_quantifier(const Formula& formula) {
  return formula.kind == Formula::Kind::exists || formula.kind == Formula::Kind::forall ||
         std::any_of(formula.parts.begin(), formula.parts.end(), has_quantifier);
}

// Of a conjunction, those with quantifiers, or those without.
Formula parts_of(const Formula& formula, bool quantified) {
  std::vector<Formula> all = {formula}, parts;
  if (formula.kind == Formula::Kind::conjunction) all = formula.parts;
  std::copy_if(all.begin(), all.end(), std::back_inserter(parts),
               [&](const Formula& part) { return has_quantifier(part) == quantified; });
  return conjunction(std::move(parts));
}

}  // namespace

Observer::Observer(Rollout& rollout, std::shared_ptr<const Scene> shared, const RunOptions& options,
                   const EnvironmentSettings& settings, const EpisodeRecord& episode,
                   std::unique_ptr<Renderer>& renderer)
    : rollout_(rollout),
      options_(options),
      settings_(settings),
      now_(std::make_unique<EpisodeRecord>()),
      scene_(std::move(shared)),
      facts_that_show_(facts_that_show(*scene_)),
      renderer_(renderer) {
  const Scene& scene = *scene_;
  const FrameReader reader(rollout.view());
  now_->task = episode.task;
  now_->variation = episode.variation;
  now_->seed = episode.seed;
  now_->physics_hz = scene.physics_hz;
  now_->frame_hz = scene.frame_hz;
  now_->objects = scene.objects;
  now_->cameras = scene.cameras;
  size_cameras(now_->cameras, settings);
  now_->joints = reader.joints();
  now_->posed = reader.posed();
  now_->hands = {scene.robot.name + "." + scene.robot.hand};
  enumerate_atoms();
  enumerate_skills();
  choose(settings.channels);
}

Observer::~Observer() = default;

EpisodeArrays Observer::columns(const ArrayRequest& request) const {
  FrameTables tables = frame_tables(*now_);
  tables.commanded = scene_->robot.arm.size();  // tells arm from fingers; nothing is commanded yet
  tables.action_joint_position.resize(tables.commanded, kUnknown);
  return arrays_of(*now_, tables, request);
}

void Observer::enumerate_atoms() {
  atoms_ = rollout_.facts().atoms();
  auto things = rollout_.facts().objects();  // not the colours drawn at this start, whose number is another each time
  std::erase_if(things, [&](const auto& thing) { return scene_->object(thing.name) == nullptr; });
  const symbolic::View view{rollout_.facts().facts(), rollout_.domain(), things};
  for (const Predicate& predicate : rollout_.domain().predicates) {
    if (predicate.kind != PredicateKind::derived) continue;
    symbolic::limit_instances(predicate.name, predicate.parameters, view, "predicate " + predicate.name);
    Binding binding;
    symbolic::for_each_binding(predicate.parameters, view, binding, [&] {
      Fact fact{predicate.name, {}};
      for (const Parameter& parameter : predicate.parameters) fact.arguments.push_back(binding.at(parameter.name));
      atoms_.push_back(std::move(fact));
      return true;
    });
  }
  for (const Fact& atom : atoms_) places_.emplace(atom, places_.size());
}

// Types, traits and distinctness: what a planner would ground. In the order of the domain and of the objects.
void Observer::enumerate_skills() {
  const symbolic::View view{rollout_.facts().facts(), rollout_.domain(), rollout_.facts().objects()};
  for (const Action& action : rollout_.domain().actions) {
    symbolic::limit_instances(action.name, action.parameters, view, "skill " + action.skill);
    Binding binding;
    symbolic::for_each_binding(action.parameters, view, binding, [&] {
      PlanStep step{action.name, {}};
      for (const Parameter& parameter : action.parameters) step.arguments.push_back(binding.at(parameter.name));
      const auto may_equal = [&](std::size_t i, std::size_t k) {
        const std::string &a = action.parameters[i].name, &b = action.parameters[k].name;
        return std::any_of(action.may_equal.begin(), action.may_equal.end(), [&](const auto& pair) {
          return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
        });
      };
      for (std::size_t i = 0; action.distinct && i < step.arguments.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
          if (step.arguments[i] == step.arguments[k] && !may_equal(i, k)) return true;
      skills_.push_back(std::move(step));
      return true;
    });
  }
}

const Facts& Observer::facts() {
  if (facts_at_ == rollout_.facts().changes()) return facts_;
  facts_at_ = rollout_.facts().changes();
  return facts_ = settings_.hidden ? rollout_.facts().facts() : rollout_.facts().observed();
}

const std::vector<std::uint8_t>& Observer::row() {
  if (row_at_ == rollout_.facts().changes()) return row_;
  row_at_ = rollout_.facts().changes();
  row_.assign(atoms_.size(), 0);
  for (const Fact& fact : facts())
    if (const auto place = places_.find(fact); place != places_.end()) row_[place->second] = 1;
  return row_;
}

const std::vector<std::uint8_t>& Observer::feasible() {
  if (feasible_at_ == rollout_.facts().changes()) return feasible_;
  std::optional<Facts> ever;
  const auto compiled = [&](const PlanStep& step, bool quantified) {
    if (!ever) {
      ever = rollout_.facts().facts();  // what is no atom here never changes
      ever->insert(atoms_.begin(), atoms_.end());
    }
    const Action& action = *rollout_.domain().action(step.action);
    return AtomFormula(parts_of(action.precondition, quantified),
                       {places_, rollout_.domain(), rollout_.facts().objects(), *ever},
                       binding_of(action, step.arguments));
  };
  if (preconditions_.empty())
    for (const PlanStep& step : skills_) preconditions_.push_back({compiled(step, false), std::nullopt});
  const std::uint8_t* now = row().data();
  feasible_at_ = rollout_.facts().changes();
  feasible_.assign(skills_.size(), 0);
  for (std::size_t i = 0; i < skills_.size(); ++i) {
    Precondition& one = preconditions_[i];
    if (!one.plain.holds(now)) continue;
    if (!one.quantified) one.quantified = compiled(skills_[i], true);
    feasible_[i] = one.quantified->holds(now) ? 1 : 0;
  }
  return feasible_;
}

void Observer::forget() {
  facts_at_ = row_at_ = feasible_at_ = plan_at_ = -1;
  drawn_.clear();
}

void Observer::choose(const std::vector<std::string>& channels) {
  now_->frames = {rollout_.recorder().frames.back()};
  now_->channels = rollout_.sensors().last_readings();
  const EpisodeArrays all = columns({});
  std::vector<std::string> known(std::begin(kAbstract), std::end(kAbstract)), raw, abstract;
  std::vector<PictureChannel> pictures;
  std::vector<std::string> unmet = channels;
  const auto take = [&](const std::string& name) {
    known.push_back(name);
    if (!named(name, channels)) return false;
    std::erase_if(unmet, [&](const std::string& one) { return named(name, {one}); });
    return true;
  };
  for (const ArrayColumn& column : all.columns) {
    const bool now =
        std::none_of(std::begin(kNotNow), std::end(kNotNow), [&](const char* name) { return column.name == name; });
    if (now && !column.name.starts_with("action/") && take(column.name)) raw.push_back(column.name);
  }
  using Kind = PictureChannel::Kind;
  for (const stampede::Camera& camera : now_->cameras)
    for (const auto& [suffix, kind] :
         {std::pair{"_rgb", Kind::rgb}, std::pair{"_depth", Kind::depth}, std::pair{"_mask", Kind::instance},
          std::pair{"_semantic_mask", Kind::semantic}, std::pair{"_point_cloud", Kind::points}})
      if (take(camera.name + suffix)) pictures.push_back({camera.name + suffix, camera.name, kind});
  for (const char* name : kAbstract)
    if (take(name)) abstract.emplace_back(name);
  for (const std::string& name : channels) {
    if (!name.starts_with(kPoseIn)) continue;
    const std::string pair = name.substr(kPoseIn.size());
    const std::size_t slash = pair.find('/');
    for (const std::string& thing : {pair.substr(0, slash), slash == std::string::npos ? "" : pair.substr(slash + 1)})
      if (std::find(now_->posed.begin(), now_->posed.end(), thing) == now_->posed.end())
        throw Error("channel '" + name + "'", "there is no '" + thing + "' here", did_you_mean(thing, now_->posed));
    abstract.push_back(name);
    std::erase(unmet, name);
  }
  if (!unmet.empty())
    throw Error("channel '" + unmet.front() + "'", "there is no such channel", did_you_mean(unmet.front(), known));
  raw_ = std::move(raw);
  abstract_ = std::move(abstract);
  pictures_ = std::move(pictures);
  kinds_.clear();
  for (const PictureChannel& one : pictures_) {
    PictureKinds& kinds = kinds_.try_emplace(one.camera, PictureKinds::none()).first->second;
    kinds.rgb = kinds.rgb || one.kind == Kind::rgb;
    kinds.depth = kinds.depth || one.kind == Kind::depth || one.kind == Kind::points;
    kinds.instance = kinds.instance || one.kind == Kind::instance;
    kinds.semantic = kinds.semantic || one.kind == Kind::semantic;
  }
  drawn_.clear();
}

EnvironmentObservation Observer::observe() {
  EnvironmentObservation observation;
  observation.frame = rollout_.step() / rollout_.steps_per_frame();
  observation.time_s = static_cast<double>(rollout_.step()) * rollout_.world().dt();
  now_->frames.resize(1);
  now_->frames[0] = rollout_.recorder().frames.back();
  if (!settings_.hidden) hidden_ = rollout_.facts().out_of_sight(rollout_.view());
  if (!raw_.empty()) add_raw(observation);
  if (!pictures_.empty()) add_pictures(observation);
  for (const std::string& name : abstract_) observation.channels.push_back(abstract(name));
  return observation;
}

void Observer::add_raw(EnvironmentObservation& observation) {
  ArrayRequest request;
  request.columns = raw_;
  if (std::any_of(raw_.begin(), raw_.end(), [](const auto& name) { return name.starts_with("sensor"); }))
    now_->channels = rollout_.sensors().last_readings();
  for (ArrayColumn& column : columns(request).columns) {
    observation.channels.push_back(value_of(std::move(column)));
    if (!hidden_.empty()) hide(observation.channels.back());
  }
}

// Poses of what no eye can see are not known, nor are margins of atoms about it.
void Observer::hide(ChannelValue& value) const {
  const auto unknown = [&](std::size_t from) {
    auto& data = std::get<std::vector<double>>(value.data);
    std::fill_n(data.begin() + static_cast<std::ptrdiff_t>(from), 7, kUnknown);
  };
  if (value.name == "task_low_dim_state") {
    for (std::size_t i = 0; i < now_->posed.size(); ++i)
      if (hidden_.contains(now_->posed[i])) unknown(7 * i);
  } else if (value.name.starts_with("object_pose/") || value.name.starts_with("object_pose_in_tool/")) {
    if (hidden_.contains(value.name.substr(value.name.find('/') + 1))) unknown(0);
  } else if (value.name == "sensor/" + std::string(kMargins)) {
    auto& margins = std::get<std::vector<double>>(value.data);
    for (std::size_t i = 0; i < margins.size(); ++i)
      if (names_hidden(value.labels.at(i))) margins[i] = kUnknown;
  }
}

// Is one of them an argument of the atom, `(inside item box)`?
bool Observer::names_hidden(const std::string& atom) const {
  const std::vector<std::string> words = split(std::string_view(atom).substr(1, atom.size() - 2), ' ');
  return std::any_of(words.begin() + 1, words.end(), [&](const std::string& word) { return hidden_.contains(word); });
}

View Observer::view_from(const std::string& camera, const ScenePoses& poses) const {
  return {named_camera(now_->cameras, camera),
          world_from_camera(*scene_, poses, named_camera(scene_->cameras, camera))};
}

std::vector<Picture> Observer::draw(const std::vector<View>& views, const ScenePoses& poses,
                                    const PictureKinds& kinds) {
  if (!renderer_) renderer_ = make_renderer();
  if (!loaded_) renderer_->load(scene_);
  loaded_ = true;
  DrawOptions options;
  options.kinds = kinds;
  options.shadows = settings_.shadows;
  options.by = settings_.renderer;
  std::vector<Picture> pictures;
  renderer_->draw(poses, views, options, pictures);
  return pictures;
}

SceneState Observer::state() const {
  SceneState state = state_at(*scene_, *now_, 0);
  for (const std::vector<std::string>& words : facts_that_show_)
    if (rollout_.facts().facts().contains({words[0], {words.begin() + 1, words.end()}})) state.facts.insert(words);
  return state;
}

ChannelValue Observer::picture(const std::string& camera, PictureSize size) {
  if (const auto& frames = rollout_.recorder().frames; !frames.empty()) now_->frames.assign(1, frames.back());
  const ScenePoses poses = scene_poses(*scene_, state());
  View view = view_from(camera, poses);
  if (size.width > 0 && size.height > 0) view.camera = resized(view.camera, size.width, size.height);
  PictureKinds colours = PictureKinds::none();
  colours.rgb = true;
  Picture picture = std::move(draw({view}, poses, colours).front());
  ChannelValue value;
  value.name = camera + "_rgb";
  value.frame = camera;
  value.shape = {picture.height, picture.width, 3};
  value.data = std::move(picture.rgb);
  return value;
}

void Observer::look(const std::vector<std::string>& cameras) {
  const ScenePoses poses = scene_poses(*scene_, state());
  std::vector<View> views;
  PictureKinds kinds = PictureKinds::none();
  for (const std::string& name : cameras) {
    views.push_back(view_from(name, poses));
    for (const PictureKind kind : kPictureKinds)
      if (kinds_.at(name).has(kind)) kinds.add(kind);
  }
  std::vector<Picture> pictures = draw(views, poses, kinds);
  const std::int64_t frame = rollout_.step() / rollout_.steps_per_frame();
  const CameraNoise noise{settings_.rgb_noise, settings_.depth_noise};
  const RandomKey key = RandomKey("camera noise").with(now_->task).with(now_->variation).with(now_->seed);
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (noise.any()) add_noise(pictures[i], views[i].camera, noise, key.with(views[i].camera.name).with(frame));
    drawn_[cameras[i]] = {frame, std::move(pictures[i]), views[i]};
  }
}

void Observer::add_pictures(EnvironmentObservation& observation) {
  std::vector<std::string> due;
  for (const auto& [camera, kinds] : kinds_) {
    const auto rate = settings_.picture_hz.find(camera);
    const auto last = drawn_.find(camera);
    const double period = rate == settings_.picture_hz.end() || !(rate->second > 0) ? 0 : now_->frame_hz / rate->second;
    const bool fresh =
        last != drawn_.end() && (last->second.frame == observation.frame ||
                                 static_cast<double>(observation.frame - last->second.frame) < period - 1e-9);
    if (!fresh) due.push_back(camera);
  }
  if (!due.empty()) look(due);
  using Kind = PictureChannel::Kind;
  for (const PictureChannel& one : pictures_) {
    const Drawn& drawn = drawn_.at(one.camera);
    const Picture& picture = drawn.picture;
    ChannelValue& value = observation.channels.emplace_back();
    value.name = one.name;
    value.frame = one.camera;
    value.shape = {picture.height, picture.width};
    if (one.kind == Kind::rgb) {
      value.shape.push_back(3);
      value.data = picture.rgb;
    } else if (one.kind == Kind::depth) {
      value.unit = "m";
      value.data = picture.depth;
    } else if (one.kind == Kind::instance) {
      value.data = picture.instance;
    } else if (one.kind == Kind::semantic) {
      value.data = picture.semantic;
    } else {
      value.unit = "m";
      value.frame = "world";
      value.shape.push_back(3);
      std::vector<float> points(picture.depth.size() * 3, std::numeric_limits<float>::quiet_NaN());
      const PointCloud cloud = point_cloud(picture, drawn.view);
      std::size_t next = 0;
      for (std::size_t i = 0; i < picture.depth.size() && next < cloud.positions.size(); ++i)
        if (picture.depth[i] > 0)
          std::copy_n(cloud.positions[next++].begin(), 3, points.begin() + static_cast<std::ptrdiff_t>(3 * i));
      value.data = std::move(points);
    }
  }
}

AtomFormula Observer::compiled(const Formula& formula) const {
  Facts ever = rollout_.facts().facts();  // what is no atom here never changes
  ever.insert(atoms_.begin(), atoms_.end());
  return {formula, AtomWorld{places_, rollout_.domain(), rollout_.facts().objects(), ever}};
}

double Observer::progress() {
  if (!goal_) goal_ = compiled(rollout_.task().goal);
  return goal_->share(row().data());
}

const std::vector<double>& Observer::goal() {
  if (wanted_at_ == rollout_.stage()) return wanted_;
  wanted_at_ = rollout_.stage();
  const Task& task = rollout_.task();
  const auto stage = static_cast<std::size_t>(wanted_at_);
  wanted_.assign(atoms_.size(), 0);
  compiled(stage < task.stages.size() ? task.stages[stage] : task.goal).mark(wanted_);
  return wanted_;
}

// What the planner would do from here, on what is known.
std::vector<std::string> Observer::plan() {
  if (plan_at_ == rollout_.facts().changes()) return plan_;
  plan_at_ = rollout_.facts().changes();
  const auto key = [&](const char* purpose) {
    return RandomKey(purpose).with(now_->task).with(now_->variation).with(now_->seed);
  };
  PlanningTask asked = planning_task(rollout_.task(), rollout_.domain(), rollout_.facts(), rollout_.stage());
  keep_known(asked.problem, rollout_.facts(), {});
  const AssumingPlan found =
      plan_assuming(asked, conceivable(rollout_.facts()), key("assume"), [&](const PlanningTask& planning) {
        if (options_.planner) return options_.planner(planning.domain, planning.problem);
        return solve_drawn(planning.domain, planning.problem, {}, key("plan"));
      });
  return plan_ = names_of(found.outcome.plan);
}

namespace {

void fill_jacobian(const World& world, ChannelValue& value) {
  const auto jacobian = world.arm().jacobian(world.arm_position());
  std::vector<double> data;
  for (Eigen::Index row = 0; row < 6; ++row)
    for (Eigen::Index joint = 0; joint < jacobian.cols(); ++joint) data.push_back(jacobian(row, joint));
  value.shape = {6, count_of(static_cast<std::size_t>(jacobian.cols()))};
  value.unit = "m/rad, 1";
  value.frame = "world";
  value.data = std::move(data);
}

// Of `NAME/OTHER`: where a thing is as seen from another.
void fill_pose_in(const WorldView& view, const std::string& pair, const std::set<std::string>& hidden,
                  ChannelValue& value) {
  const std::size_t slash = pair.find('/');
  const std::string thing = pair.substr(0, slash), other = pair.substr(slash + 1);
  const Pose pose = to_pose(view.world_from(other).inverse() * view.world_from(thing));
  std::vector<double> data(pose.position.begin(), pose.position.end());
  data.insert(data.end(), pose.quaternion.begin(), pose.quaternion.end());
  if (hidden.contains(thing) || hidden.contains(other)) data.assign(7, kUnknown);
  value.shape = {7};
  value.unit = "m, 1";
  value.frame = other;
  value.data = std::move(data);
}

}  // namespace

ChannelValue Observer::abstract(const std::string& name) {
  ChannelValue value;
  value.name = name;
  const auto texts = [&](std::vector<std::string> list) {
    value.shape = {count_of(list.size())};
    value.data = std::move(list);
  };
  if (name == "facts" || name == "known") {
    value.shape = {count_of(atoms_.size())};
    value.data = row();
    if (name == "known" && settings_.hidden) {
      std::vector<std::uint8_t> known(atoms_.size(), 0);
      for (const Fact& fact : rollout_.facts().observed())
        if (const auto place = places_.find(fact); place != places_.end()) known[place->second] = 1;
      value.data = std::move(known);
    }
  } else if (name == "applicable") {
    value.shape = {count_of(skills_.size())};
    value.data = feasible();
  } else if (name == "fact_names") {
    std::vector<std::string> list;
    for (const Fact& fact : facts()) list.push_back(to_text(fact));
    texts(std::move(list));
  } else if (name == "feasible_skills") {
    std::vector<PlanStep> list;
    const std::vector<std::uint8_t>& mask = feasible();
    for (std::size_t i = 0; i < mask.size(); ++i)
      if (mask[i] != 0) list.push_back(skills_[i]);
    texts(names_of(list));
  } else if (name == "pddl") {
    Problem problem = world_problem(rollout_.task(), rollout_.facts());
    if (!settings_.hidden) problem.init = rollout_.facts().known_basic();
    texts({to_pddl(problem, named_by_content(rollout_.domain()), beside_goal(rollout_.task()))});
  } else if (name == "sentences") {
    const Domain& domain = rollout_.domain();
    texts(describe_world(settings_.hidden ? facts() : mentionable(rollout_.facts().facts(), facts(), domain, *scene_),
                         domain, *scene_));
  } else if (name == "plan") {
    texts(plan());
  } else if (name == "tool_jacobian") {
    fill_jacobian(rollout_.world(), value);
  } else if (name == "progress") {
    value.data = std::vector<double>{progress()};
  } else if (name == "goal") {
    value.shape = {count_of(atoms_.size())};
    value.data = goal();
  } else {  // object_pose_in/NAME/OTHER
    fill_pose_in(rollout_.view(), name.substr(kPoseIn.size()), hidden_, value);
  }
  return value;
}

}  // namespace stampede
