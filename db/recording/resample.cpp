#include "db/recording/resample.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stampede {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kSameTime = 1e-6;   // s
constexpr double kLongestGap = 0.1;  // s

}  // namespace

double gap_bound(const Track& track) { return std::max(kLongestGap, 3 * median_period(track.time)); }

std::vector<double> linear(const Track& track, const FrameTimes& frames, double bound) {
  const std::size_t width = track.width(), rows = track.time.size();
  std::vector<double> values(frames.count * width, kUnknown);
  std::size_t after = 0;  // first reading after the frame
  for (std::size_t frame = 0; frame < frames.count; ++frame) {
    const double t = frames.at(frame);
    while (after < rows && track.time[after] <= t) ++after;
    const auto exactly = [&](std::size_t row) { return row < rows && std::abs(track.time[row] - t) <= kSameTime; };
    const std::size_t same = after > 0 && exactly(after - 1) ? after - 1 : exactly(after) ? after : rows;
    if (same < rows) {
      std::copy_n(&track.values[same * width], width, &values[frame * width]);
      continue;
    }
    if (after == 0 || after == rows) continue;
    const double from = track.time[after - 1], to = track.time[after];
    if (to - from > bound) continue;
    const double share = (t - from) / (to - from);
    for (std::size_t column = 0; column < width; ++column)
      values[frame * width + column] =
          track.at(after - 1, column) + share * (track.at(after, column) - track.at(after - 1, column));
  }
  return values;
}

std::vector<double> held(const Track& track, const FrameTimes& frames, double bound) {
  const std::size_t width = track.width(), rows = track.time.size();
  std::vector<double> values(frames.count * width, kUnknown);
  std::size_t after = 0;
  for (std::size_t frame = 0; frame < frames.count; ++frame) {
    const double end = frames.at(frame + 1) - kSameTime;
    while (after < rows && track.time[after] < end) ++after;
    if (after == 0 || frames.at(frame) - track.time[after - 1] > bound) continue;
    std::copy_n(&track.values[(after - 1) * width], width, &values[frame * width]);
  }
  return values;
}

std::vector<std::int64_t> nearest(const std::vector<double>& time, const FrameTimes& frames) {
  std::vector<std::int64_t> chosen(frames.count, -1);
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double place = std::ceil((time[i] - frames.begin) * frames.hz - 0.5);  // in (-half, half] of its frame
    if (place < 0 || place >= static_cast<double>(frames.count)) continue;
    const auto frame = static_cast<std::size_t>(place);
    std::int64_t& now = chosen[frame];
    if (now >= 0 &&
        std::abs(time[static_cast<std::size_t>(now)] - frames.at(frame)) <= std::abs(time[i] - frames.at(frame)))
      continue;
    now = static_cast<std::int64_t>(i);
  }
  return chosen;
}

std::vector<double> differences(const std::vector<double>& values, std::size_t width, int hz) {
  std::vector<double> rates(values.size(), kUnknown);
  const std::size_t frames = width == 0 ? 0 : values.size() / width;
  for (std::size_t frame = 0; frame < frames; ++frame)
    for (std::size_t column = 0; column < width; ++column) {
      const auto known = [&](std::size_t at) { return at < frames && !std::isnan(values[at * width + column]); };
      if (!known(frame)) continue;
      const std::size_t before = frame > 0 && known(frame - 1) ? frame - 1 : frame;
      const std::size_t after = known(frame + 1) ? frame + 1 : frame;
      if (before == after) continue;
      rates[frame * width + column] =
          (values[after * width + column] - values[before * width + column]) * hz / static_cast<double>(after - before);
    }
  return rates;
}

}  // namespace stampede
