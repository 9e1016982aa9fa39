#include "db/recording/track.h"

#include <algorithm>
#include <map>
#include <set>

#include "db/recording/csv_file.h"
#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"

namespace stampede {
namespace {

constexpr std::size_t kNoColumn = static_cast<std::size_t>(-1);

// Where each of the wanted columns is in the file.
std::vector<std::size_t> places_of(const CsvFile& csv, const RecordedStream& stream, std::vector<TrackColumn>& columns,
                                   const std::string& shown) {
  if (columns.empty())
    for (const std::string& name : csv.header())
      if (name != "time_s") columns.push_back({name, false});
  std::vector<std::string> known = {"time_s"};
  for (const TrackColumn& column : columns) known.push_back(column.name);
  const std::set<std::string_view> known_names(known.begin(), known.end());
  std::map<std::string_view, std::size_t> in_header;
  for (std::size_t i = 0; i < csv.header().size(); ++i) in_header.emplace(csv.header()[i], i);
  for (const std::string& name : csv.header())
    if (!known_names.contains(name))
      throw Error(shown + ":1",
                  "a stream of kind " + std::string(to_string(stream.kind)) + " has no column '" + name + "'",
                  did_you_mean(name, known));
  std::vector<std::size_t> places;
  for (const std::string& name : known) {
    const auto found = in_header.find(name);
    const bool needed = name == "time_s" || columns[places.size() - 1].needed;
    if (found == in_header.end() && needed)
      throw Error(shown + ":1", "the column '" + name + "' is missing",
                  "it has " + joined(csv.header()) + "; is this another robot's?");
    places.push_back(found == in_header.end() ? kNoColumn : found->second);
  }
  return places;
}

}  // namespace

Track read_track(const RecordingFile& recording, const RecordedStream& stream, std::vector<TrackColumn> columns,
                 const std::function<void(const std::string&)>& hash) {
  const std::string shown = recording.shown_path(stream.file);
  CsvFile csv(recording.path_of(stream.file, stream.place), shown);
  hash(csv.text());
  Track track;
  const std::vector<std::size_t> places = places_of(csv, stream, columns, shown);
  track.columns = std::move(columns);
  for (std::size_t i = 1; i < places.size(); ++i) track.there.push_back(places[i] != kNoColumn);
  double last_stamp = 0;
  while (csv.next()) {
    const double stamp = csv.number(places[0]);
    if (std::isnan(stamp)) throw Error(csv.place(), "this row has no time", "give each reading its stamp");
    if (!track.time.empty() && !(stamp > last_stamp))
      throw Error(
          csv.place(),
          "its clock runs backwards: " + std::string(csv.fields()[places[0]]) + " does not come after the row before",
          "sort the rows by time, and leave out those that were sent twice");
    last_stamp = stamp;
    if (track.values.size() + track.width() > kMostReadings)
      throw Error(csv.place(), "it has more than " + std::to_string(kMostReadings) + " readings, rows times columns",
                  "record for a shorter time or at a lower rate, or leave columns out");
    track.time.push_back(stream.clock.time(stamp));
    for (std::size_t i = 1; i < places.size(); ++i)
      track.values.push_back(places[i] == kNoColumn ? std::nan("") : csv.number(places[i]));
  }
  if (track.time.empty()) throw Error(shown, "it has no readings", "leave the stream out of recording.json");
  return track;
}

double median_period(const std::vector<double>& time) {
  if (time.size() < 2) return 0;
  std::vector<double> periods;
  for (std::size_t i = 1; i < time.size(); ++i) periods.push_back(time[i] - time[i - 1]);
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

void describe_times(const std::vector<double>& time, double begin, double end, StreamRecord& record) {
  const auto first = std::lower_bound(time.begin(), time.end(), begin), last = std::upper_bound(first, time.end(), end);
  const std::vector<double> within(first, last);
  record.readings = static_cast<std::int64_t>(within.size());
  const double period = median_period(within);
  record.rate_hz = period > 0 ? 1 / period : 0;
  record.longest_gap_s = 0;
  for (std::size_t i = 1; i < within.size(); ++i)
    record.longest_gap_s = std::max(record.longest_gap_s, within[i] - within[i - 1]);
}

}  // namespace stampede
