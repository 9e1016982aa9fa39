#include "engine/rollout/sensors.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/record/scene_record.h"
#include "engine/sim/world.h"
#include "stampede/environment.h"

namespace stampede {
namespace {

constexpr const char* kForceTorque = "force_torque";

bool wanted(const Observation& observation, const std::string& name) {
  return asks_for_channel(observation, "*") || asks_for_channel(observation, name);
}

ChannelRecord channel_of(const Sensor& sensor, const Robot& robot) {
  ChannelRecord channel;
  channel.name = sensor.name;
  channel.rate_hz = sensor.rate_hz;
  if (sensor.kind == kForceTorque) {
    channel.unit = "N, N m";
    channel.components = {"force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z"};
    return channel;
  }
  channel.unit = "N m";
  channel.components = arm_joints(robot);
  return channel;
}

// A moving part by the name of its joint: `panda.joint1`, `chest.top_drawer`.
PartRef joint_named(const Scene& scene, std::string_view name) {
  std::vector<std::string> names;
  for (const JointName& joint : joints_of(scene)) {
    if (joint.name == name) return joint.part;
    names.push_back(joint.name);
  }
  throw Error("", "the scene has no joint '" + std::string(name) + "'", did_you_mean(name, names));
}

Vector3 vector_of(const std::array<double, 3>& values) { return {values[0], values[1], values[2]}; }

}  // namespace

double SimulatorView::time_s() const { return view_->time_s(); }

double SimulatorView::joint_position(std::string_view joint) const {
  return view_->world().joint_position(joint_named(view_->scene(), joint));
}

double SimulatorView::joint_velocity(std::string_view joint) const {
  return view_->world().joint_velocity(joint_named(view_->scene(), joint));
}

double SimulatorView::joint_effort(std::string_view joint) const {
  return view_->world().joint_effort(joint_named(view_->scene(), joint));
}

StatePose SimulatorView::pose(std::string_view object) const {
  const Pose pose = to_pose(view_->world_from(object));
  return {std::string(object), pose.position, pose.quaternion};
}

std::array<double, 3> SimulatorView::velocity(std::string_view object) const {
  const Vector3 velocity = view_->velocity(object);
  return {velocity.x(), velocity.y(), velocity.z()};
}

double SimulatorView::opening_m() const { return view_->world().opening(); }

double SimulatorView::contact_force(std::string_view one, std::string_view other) const {
  return view_->contact_force(one, other);
}

std::optional<double> SimulatorView::distance(const std::array<double, 3>& from,
                                              const std::array<double, 3>& to) const {
  const std::optional<RayHit> hit = view_->world().ray(vector_of(from), vector_of(to));
  return hit ? std::optional(hit->distance) : std::nullopt;
}

SensorReader::SensorReader(const Scene& scene, const Observation& observation, RandomKey key)
    : arm_(scene.robot.arm),
      torque_noise_(observation.torque_noise),
      key_(key),
      wants_margins_(asks_for_channel(observation, kMargins)) {
  if (!observation.torque_model.empty()) torque_model_ = of_arm(observation.torque_model, arm_joints(scene.robot));
  warm_up_s_ = warm_up_s(torque_model_, key_);
  for (const Sensor& sensor : scene.sensors) {
    if (!wanted(observation, sensor.name)) continue;
    channels_.push_back({channel_of(sensor, scene.robot), {}, {}});
    sources_.push_back(
        {sensor, scene.physics_hz / sensor.rate_hz, std::vector<double>(channels_.back().head.components.size(), 0.0)});
  }
}

void SensorReader::add(const Scene& scene, const std::string& name, const SensorEntry& entry) {
  const std::string where = "sensor '" + name + "'";
  for (const Sensor& sensor : scene.sensors)
    if (sensor.name == name) throw Error(where, "world " + scene.world + " has one of that name", "choose another one");
  if (name == kMargins) throw Error(where, "the signed margins of facts are called so", "choose another name");
  if (entry.rate_hz < 1 || scene.physics_hz % entry.rate_hz != 0)
    throw Error(where, "world " + scene.world + " cannot be read " + std::to_string(entry.rate_hz) + " times a second",
                "choose a rate that divides its " + std::to_string(scene.physics_hz) + " steps a second");
  own_.push_back({entry, scene.physics_hz / entry.rate_hz, channels_.size()});
  ChannelRecord& channel = channels_.emplace_back().head;
  channel.name = name;
  channel.unit = entry.unit;
  channel.components = entry.components;
  channel.rate_hz = entry.rate_hz;
}

void SensorReader::add_margins(ChannelRecord head) {
  margins_ = channels_.size();
  channels_.push_back({std::move(head), {}, {}});
}

void SensorReader::note_margins(std::int64_t step, const std::vector<double>& reading) {
  channels_[margins_].add(step, reading);
}

void SensorReader::read_own(const Own& own, const WorldView& view) {
  const ChannelRecord& channel = channels_[own.channel].head;
  const auto fail = [&](const std::string& what) {
    failure_ = "sensor '" + channel.name + "' at " + std::to_string(view.time_s()) + " s: " + what;
  };
  try {
    const std::vector<double> values = own.entry.read(SimulatorView(view));
    if (values.size() != channel.components.size())
      return fail("it gave " + std::to_string(values.size()) + " values for " +
                  std::to_string(channel.components.size()) + " components");
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i])) return fail(channel.components[i] + " is not a finite number");
    channels_[own.channel].add(view.world().step_count(), values);
  } catch (const std::exception& error) {
    fail(error.what());
  } catch (const Interruption&) {
    throw;
  } catch (...) {
    fail("it threw what is no std::exception");
  }
}

std::vector<double> SensorReader::read(const Source& source, const World& world) const {
  std::vector<double> values;
  if (source.sensor.kind == kForceTorque) {
    const Wrench wrench = world.contact_wrench(source.sensor.part);
    values.insert(values.end(), wrench.force.data(), wrench.force.data() + 3);
    values.insert(values.end(), wrench.torque.data(), wrench.torque.data() + 3);
  } else {
    for (const int part : arm_) values.push_back(world.joint_effort(PartRef::of_robot(part)));
  }
  return values;
}

void SensorReader::add_noise(std::size_t index, const World& world, std::vector<double>& values) const {
  if (sources_[index].sensor.kind == kForceTorque) return;
  const std::int64_t step = world.step_count();
  Random random(key_.with(channels_[index].head.name).with(step));
  if (torque_noise_ > 0)
    for (double& value : values) value += torque_noise_ * random.normal();
  if (torque_model_.empty()) return;
  const double since_on_s = warm_up_s_ + static_cast<double>(step) / world.scene().physics_hz;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] += torque_error(torque_model_, i, world.joint_velocity(PartRef::of_robot(arm_[i])), since_on_s, random);
}

void SensorReader::step(const WorldView& view) {
  const World& world = view.world();
  for (const Own& own : own_)
    if (failure_.empty() && world.step_count() % own.period == 0) read_own(own, view);
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    Source& source = sources_[i];
    const bool mean = source.sensor.kind == kForceTorque;  // contact impulses flicker from step to step
    const bool due = world.step_count() % source.period == 0;
    if (!mean && !due) continue;
    std::vector<double> values = read(source, world);
    if (mean)
      for (std::size_t k = 0; k < values.size(); ++k) values[k] = source.sums[k] += values[k];
    if (!due) continue;
    if (mean)
      for (double& value : values) value /= source.period;
    source.sums.assign(source.sums.size(), 0.0);
    add_noise(i, world, values);
    channels_[i].add(world.step_count(), values);
  }
}

SensorReader::Mark SensorReader::mark() const {
  Mark mark;
  for (const Channel& channel : channels_) mark.samples.push_back(channel.steps.size());
  for (const Source& source : sources_) mark.sums.push_back(source.sums);
  return mark;
}

void SensorReader::cut(const Mark& mark) {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    channels_[i].steps.shorten(mark.samples[i]);
    channels_[i].values.shorten(mark.samples[i] * channels_[i].head.components.size());
  }
  for (std::size_t i = 0; i < sources_.size(); ++i) sources_[i].sums = mark.sums[i];
  failure_.clear();
}

void SensorReader::forget() {
  for (Channel& channel : channels_) {
    channel.steps.keep_last(1);
    channel.values.keep_last(channel.head.components.size());
  }
}

void SensorReader::Channel::add(std::int64_t step, const std::vector<double>& reading) {
  steps.push_back(step);
  for (const double value : reading) values.push_back(value);
}

ChannelRecord SensorReader::Channel::last(std::size_t count) const {
  ChannelRecord record = head;
  for (std::size_t i = steps.size() - std::min(count, steps.size()); i < steps.size(); ++i)
    record.steps.push_back(steps[i]);
  for (std::size_t i = values.size() - record.steps.size() * head.components.size(); i < values.size(); ++i)
    record.values.push_back(values[i]);
  return record;
}

std::vector<ChannelRecord> SensorReader::channels() const {
  std::vector<ChannelRecord> records;
  for (const Channel& channel : channels_) records.push_back(channel.last(channel.steps.size()));
  return records;
}

std::vector<ChannelRecord> SensorReader::last_readings() const {
  std::vector<ChannelRecord> records;
  for (const Channel& channel : channels_) records.push_back(channel.last(1));
  return records;
}

SensorReader sensors_of(const Scene& scene, const EpisodeRecord& episode, const SensorEntries& own) {
  SensorReader reader(scene, chosen(observation_of(episode)),
                      RandomKey("sensor noise").with(episode.task).with(episode.variation).with(episode.seed));
  if (own)
    for (const auto& [name, entry] : *own) reader.add(scene, name, entry);
  return reader;
}

}  // namespace stampede
