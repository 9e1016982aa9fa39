// Readings at their own times become values at the times of frames.
#pragma once

#include <cstdint>
#include <vector>

#include "db/recording/track.h"

namespace stampede {

// Frame i is at begin + i / hz.
struct FrameTimes {
  double begin = 0;
  int hz = 30;
  std::size_t count = 0;
  double at(std::size_t frame) const { return begin + static_cast<double>(frame) / hz; }
  double end() const { return at(count - 1); }
};

// What lies further apart is a gap: 0.1 s, or three periods of a slower stream.
double gap_bound(const Track& track);

// Each column at each frame (row by row): on the straight line between the readings before and after. NaN where there
// is no reading on one side, where the two lie further apart than `bound`, or either is unknown. A reading at the
// frame's own time (to a microsecond) is taken as it is.
std::vector<double> linear(const Track& track, const FrameTimes& frames, double bound);

// The last reading before the end of each frame's period, unless it is older than `bound`.
std::vector<double> held(const Track& track, const FrameTimes& frames, double bound);

// For each frame the index of the nearest of `time` within half a period, or -1; none is taken twice.
std::vector<std::int64_t> nearest(const std::vector<double>& time, const FrameTimes& frames);

// Rates of change by differences of neighbours on both sides (one side at ends and gaps); NaN where there are none.
std::vector<double> differences(const std::vector<double>& values, std::size_t width, int hz);

}  // namespace stampede
