#include "engine/episode/sensors.h"

#include <algorithm>

namespace stampede {
namespace {

constexpr const char* kForceTorque = "force_torque";

bool wanted(const Observation& observation, const std::string& name) {
  return std::any_of(observation.channels.begin(), observation.channels.end(),
                     [&](const std::string& one) { return one == "*" || one == name; });
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
  for (const int part : robot.arm)
    channel.components.push_back(robot.body.parts[static_cast<std::size_t>(part)].joint.name);
  return channel;
}

}  // namespace

SensorReader::SensorReader(const Scene& scene, const Observation& observation, RandomKey key)
    : arm_(scene.robot.arm), torque_noise_(observation.torque_noise), key_(key) {
  for (const Sensor& sensor : scene.sensors) {
    if (!wanted(observation, sensor.name)) continue;
    channels_.push_back(channel_of(sensor, scene.robot));
    sources_.push_back(
        {sensor, scene.physics_hz / sensor.rate_hz, std::vector<double>(channels_.back().components.size(), 0.0)});
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

void SensorReader::add_noise(std::size_t index, std::int64_t step, std::vector<double>& values) const {
  if (torque_noise_ <= 0 || sources_[index].sensor.kind == kForceTorque) return;
  Random random(key_.with(channels_[index].name).with(step));
  for (double& value : values) value += torque_noise_ * random.normal();
}

void SensorReader::step(const World& world) {
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
    add_noise(i, world.step_count(), values);
    channels_[i].steps.push_back(world.step_count());
    channels_[i].values.insert(channels_[i].values.end(), values.begin(), values.end());
  }
}

SensorReader::Mark SensorReader::mark() const {
  Mark mark;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    mark.samples.push_back(channels_[i].steps.size());
    mark.sums.push_back(sources_[i].sums);
  }
  return mark;
}

void SensorReader::cut(const Mark& mark) {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    channels_[i].steps.resize(mark.samples[i]);
    channels_[i].values.resize(mark.samples[i] * channels_[i].components.size());
    sources_[i].sums = mark.sums[i];
  }
}

void SensorReader::forget() {
  for (ChannelRecord& channel : channels_) {
    if (channel.steps.size() < 2) continue;
    channel.steps.erase(channel.steps.begin(), channel.steps.end() - 1);
    channel.values.erase(channel.values.begin(),
                         channel.values.end() - static_cast<std::ptrdiff_t>(channel.components.size()));
  }
}

SensorReader sensors_of(const Scene& scene, const EpisodeRecord& episode) {
  return {scene, chosen(observation_of(episode)),
          RandomKey("sensor noise").with(episode.task).with(episode.variation).with(episode.seed)};
}

}  // namespace stampede
