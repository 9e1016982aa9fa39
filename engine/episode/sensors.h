// What the scene's sensors say, at their own rates, while a world is stepped: by the runner, and again by replay.
#pragma once

#include <vector>

#include "engine/episode/observation.h"
#include "engine/sim/world.h"

namespace stampede {

class SensorReader {
 public:
  // Reads the sensors that the observation wants, and no others. `key` tells episodes apart, for noise.
  SensorReader(const Scene& scene, const Observation& observation, RandomKey key);

  void step(const World& world);  // after every physics step

  struct Mark {
    std::vector<std::size_t> samples;
    std::vector<std::vector<double>> sums;
  };
  Mark mark() const;
  void cut(const Mark& mark);  // everything after the mark never happened
  void forget();               // all samples but the last of each channel

  const std::vector<ChannelRecord>& channels() const { return channels_; }  // in the scene's order

 private:
  struct Source {
    Sensor sensor;
    int period = 1;            // steps
    std::vector<double> sums;  // since the last sample
  };
  std::vector<double> read(const Source& source, const World& world) const;
  void add_noise(std::size_t index, std::int64_t step, std::vector<double>& values) const;

  std::vector<int> arm_;
  double torque_noise_ = 0;
  RandomKey key_;
  std::vector<Source> sources_;
  std::vector<ChannelRecord> channels_;
};

// As the episode's own options want them, with the noise that is its own.
SensorReader sensors_of(const Scene& scene, const EpisodeRecord& episode);

}  // namespace stampede
