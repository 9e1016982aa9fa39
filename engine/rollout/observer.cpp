#include "engine/rollout/observer.h"

#include <algorithm>
#include <array>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"

namespace stampede {
namespace {

constexpr const char* kToolJacobian = "tool_jacobian";
constexpr std::string_view kPoseIn = "object_pose_in/";
constexpr std::array kNotNow{"reward", "done", "skill", "subgoal", "motion"};  // columns that say nothing of one moment
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

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

bool tells_now(const std::string& column) {
  return std::ranges::find(kNotNow, column) == kNotNow.end() && !column.starts_with("action/") &&
         SymbolChannels::find(column) == nullptr;  // those are made from the running world
}

EpisodeRecord present(const Rollout& rollout, const RunOptions& options, const EnvironmentSettings& settings) {
  const Scene& scene = *rollout.scene();
  const FrameReader reader(rollout.view());
  EpisodeRecord now;
  now.task = rollout.task().name;
  now.variation = rollout.task().variation;
  now.seed = options.seed;
  now.physics_hz = scene.physics_hz;
  now.frame_hz = scene.frame_hz;
  now.scene.objects = scene.objects;
  now.scene.cameras = sized_cameras(scene.cameras, settings);
  now.scene.joints = reader.joints();
  now.scene.posed = reader.posed();
  now.scene.hands = {scene.robot.name + "." + scene.robot.hand};
  return now;
}

void fill_jacobian(const World& world, ChannelValue& value) {
  const auto jacobian = world.arm().jacobian(world.arm_position());
  std::vector<double> data;
  for (Eigen::Index row = 0; row < 6; ++row)
    for (Eigen::Index joint = 0; joint < jacobian.cols(); ++joint) data.push_back(jacobian(row, joint));
  value.shape = {6, jacobian.cols()};
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

Observer::Observer(Rollout& rollout, const RunOptions& options, const EnvironmentSettings& settings,
                   std::unique_ptr<Renderer>& renderer)
    : rollout_(rollout),
      settings_(settings),
      now_(present(rollout, options, settings)),
      symbols_(rollout, options, settings),
      pictures_(rollout, settings, now_, renderer) {
  choose(settings.channels);
}

EpisodeArrays Observer::columns(const ArrayRequest& request) const {
  FrameTables tables = frame_tables(now_);
  tables.commanded = rollout_.scene()->robot.arm.size();  // tells arm from fingers; nothing is commanded yet
  tables.action_joint_position.resize(tables.commanded, kUnknown);
  return arrays_of(now_, tables, request);
}

void Observer::forget() {
  symbols_.forget();
  pictures_.forget();
}

void Observer::choose(const std::vector<std::string>& channels) {
  now_.frames = {rollout_.recorder().frames.back()};
  now_.channels = rollout_.sensors().last_readings();
  std::vector<std::string> made, known, unmet = channels;
  for (const SymbolChannels::Channel& one : SymbolChannels::all()) made.emplace_back(one.name);
  made.emplace_back(kToolJacobian);
  known = made;
  const auto take = [&](const std::string& name) {
    known.push_back(name);
    if (!named(name, channels)) return false;
    std::erase_if(unmet, [&](const std::string& one) { return named(name, {one}); });
    return true;
  };
  for (const ArrayColumn& column : columns({}).columns)
    if (tells_now(column.name) && take(column.name)) columns_.push_back(column.name);
  std::vector<PictureChannels::Channel> pictures;
  for (const PictureChannels::Channel& one : pictures_.all())
    if (take(one.name)) pictures.push_back(one);
  pictures_.choose(std::move(pictures));
  for (const std::string& name : made)
    if (take(name)) made_.push_back(name);
  for (const std::string& name : channels) {
    if (!name.starts_with(kPoseIn)) continue;
    const std::string pair = name.substr(kPoseIn.size());
    const std::size_t slash = pair.find('/');
    for (const std::string& thing : {pair.substr(0, slash), slash == std::string::npos ? "" : pair.substr(slash + 1)})
      if (std::ranges::find(now_.scene.posed, thing) == now_.scene.posed.end())
        throw Error("channel '" + name + "'", "there is no '" + thing + "' here",
                    did_you_mean(thing, now_.scene.posed));
    made_.push_back(name);
    std::erase(unmet, name);
  }
  if (!unmet.empty())
    throw Error("channel '" + unmet.front() + "'", "there is no such channel", did_you_mean(unmet.front(), known));
}

EnvironmentObservation Observer::observe() {
  EnvironmentObservation observation;
  observation.frame = rollout_.step() / rollout_.steps_per_frame();
  observation.time_s = static_cast<double>(rollout_.step()) * rollout_.world().dt();
  now_.frames.assign(1, rollout_.recorder().frames.back());
  if (!settings_.hidden) hidden_ = rollout_.facts().out_of_sight(rollout_.view());
  if (!columns_.empty()) add_columns(observation);
  pictures_.add_to(observation);
  for (const std::string& name : made_) observation.channels.push_back(made(name));
  return observation;
}

ChannelValue Observer::picture(const std::string& camera, PictureSize size) {
  if (const auto& frames = rollout_.recorder().frames; !frames.empty()) now_.frames.assign(1, frames.back());
  return pictures_.picture(camera, size);
}

void Observer::add_columns(EnvironmentObservation& observation) {
  ArrayRequest request;
  request.columns = columns_;
  if (std::ranges::any_of(columns_, [](const auto& name) { return name.starts_with("sensor"); }))
    now_.channels = rollout_.sensors().last_readings();
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
    for (std::size_t i = 0; i < now_.scene.posed.size(); ++i)
      if (hidden_.contains(now_.scene.posed[i])) unknown(7 * i);
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

ChannelValue Observer::made(const std::string& name) {
  ChannelValue value;
  if (const SymbolChannels::Channel* symbol = SymbolChannels::find(name))
    value = symbol->value(symbols_);
  else if (name == kToolJacobian)
    fill_jacobian(rollout_.world(), value);
  else
    fill_pose_in(rollout_.view(), name.substr(kPoseIn.size()), hidden_, value);
  value.name = name;
  return value;
}

}  // namespace stampede
