// Numbers that were read one after the other, on the recording's time line.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "db/recording/recording_file.h"

namespace stampede {

inline constexpr std::size_t kMostReadings = 50'000'000;  // of a recording: of all its streams

struct TrackColumn {
  std::string name;  // in the CSV's header
  bool needed = false;
};

// values[i * width() + column] was read at time[i]; NaN: nothing was read, or the file has no such column.
struct Track {
  std::vector<double> time;  // s, strictly rising
  std::vector<TrackColumn> columns;
  std::vector<bool> there;  // which columns the file has
  std::vector<double> values;
  std::size_t width() const { return columns.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * width() + column]; }
};

// Reads a stream's CSV: `time_s` and these columns, in any order; with no columns given, all that it has. `hash` is
// called with its bytes. Throws Error with the line: other columns, missing ones, stamps that do not rise, no rows.
Track read_track(const RecordingFile& recording, const RecordedStream& stream, std::vector<TrackColumn> columns,
                 const std::function<void(const std::string&)>& hash);

// What is said of a stream's times: by the part of them within [begin, end].
void describe_times(const std::vector<double>& time, double begin, double end, StreamRecord& record);
double median_period(const std::vector<double>& time);  // s; 0 where there is one reading

}  // namespace stampede
