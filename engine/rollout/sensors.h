// What sensors say, at their own rates, while a world is stepped: those of the scene by the runner, and again by
// replay; those of the program by the runner alone.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/shared_list.h"
#include "engine/record/observation.h"
#include "engine/start/options.h"
#include "engine/start/world_view.h"
#include "stampede/world_state.h"

namespace stampede {

class SensorReader {
 public:
  // Reads the sensors that the observation wants, and no others. `key` tells episodes apart, for noise.
  SensorReader(const Scene& scene, const Observation& observation, RandomKey key);

  // Beside these, whatever is wanted. Throws Error for a name that is taken, and a rate that does not fit the scene's.
  void add(const Scene& scene, const std::string& name, const SensorEntry& entry);

  // Margins, read by whoever knows the facts: wanted by name alone. `head`: the channel without readings.
  bool wants_margins() const { return wants_margins_; }
  void add_margins(ChannelRecord head);
  void note_margins(std::int64_t step, const std::vector<double>& reading);

  void step(const WorldView& view);  // after every physics step
  // Why the program's sensors are not read any more; empty: they are.
  const std::string& failure() const { return failure_; }

  struct Mark {
    std::vector<std::size_t> samples;
    std::vector<std::vector<double>> sums;
  };
  Mark mark() const;
  void cut(const Mark& mark);  // everything after the mark never happened
  void forget();               // all samples but the last of each channel

  // The scene's, in its order, then the program's and margins: all that was read, and the last reading alone of each.
  std::vector<ChannelRecord> channels() const;
  std::vector<ChannelRecord> last_readings() const;

 private:
  struct Source {
    Sensor sensor;
    int period = 1;            // steps
    std::vector<double> sums;  // since the last sample
  };
  struct Own {  // of the program
    SensorEntry entry;
    int period = 1;           // steps
    std::size_t channel = 0;  // place in channels_
  };
  struct Channel {
    ChannelRecord head;  // without readings
    SharedList<std::int64_t, 256> steps;
    SharedList<double, 1024> values;
    void add(std::int64_t step, const std::vector<double>& reading);
    ChannelRecord last(std::size_t count) const;
  };
  std::vector<double> read(const Source& source, const World& world) const;
  void read_own(const Own& own, const WorldView& view);
  void add_noise(std::size_t index, const World& world, std::vector<double>& values) const;

  std::vector<int> arm_;
  double torque_noise_ = 0;
  TorqueNoise torque_model_;  // in the order of arm_, or empty
  RandomKey key_;
  double warm_up_s_ = 0;  // of the arm, at the first step
  std::vector<Source> sources_;
  std::vector<Channel> channels_;
  std::vector<Own> own_;
  bool wants_margins_ = false;
  std::size_t margins_ = 0;  // place in channels_, once they were added
  std::string failure_;
};

// As the episode's own options want them, with the noise that is its own; and those of the program.
SensorReader sensors_of(const Scene& scene, const EpisodeRecord& episode, const SensorEntries& own);

}  // namespace stampede
