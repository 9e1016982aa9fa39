#include "db/research/segmentation.h"

#include <algorithm>
#include <set>

#include "engine/base/error.h"

namespace stampede::research {
namespace {

std::int64_t frames_of(const PlainFile& hidden, std::int64_t episode) {
  return hidden.query("SELECT frames FROM episodes WHERE episode = ?1", {episode}).integer(0, "frames");
}

// Runs of frames of the same segment.
Segmentation from_frames(const std::vector<int>& of_frame, const std::vector<LabelledSegment>& painted) {
  Segmentation one;
  one.frames = static_cast<std::int64_t>(of_frame.size());
  for (std::int64_t frame = 0; frame < one.frames;) {
    const int segment = of_frame[static_cast<std::size_t>(frame)];
    const std::int64_t first = frame;
    while (frame < one.frames && of_frame[static_cast<std::size_t>(frame)] == segment) ++frame;
    if (segment >= 0) one.segments.push_back({first, frame, painted[static_cast<std::size_t>(segment)].label});
  }
  return one;
}

}  // namespace

Segmentations true_segments(const PlainFile& hidden, const std::vector<std::int64_t>& episodes,
                            const std::string& label_column) {
  const std::string table = label_column == "motion" ? "controls" : "skills";
  Segmentations all;
  for (const std::int64_t episode : episodes) {
    std::vector<int> of_frame(static_cast<std::size_t>(frames_of(hidden, episode)), -1);
    std::vector<LabelledSegment> painted;
    // rowid: in the order of beginning, callers before what they call
    const Rows rows = hidden.query("SELECT first_frame, end_frame, " + label_column + " AS label FROM " + table +
                                       " WHERE episode = ?1 ORDER BY rowid",
                                   {episode});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto end = std::min<std::int64_t>(rows.integer(i, "end_frame"), static_cast<std::int64_t>(of_frame.size()));
      for (std::int64_t frame = rows.integer(i, "first_frame"); frame < end; ++frame)
        of_frame[static_cast<std::size_t>(frame)] = static_cast<int>(painted.size());
      painted.push_back({rows.integer(i, "first_frame"), end, rows.text(i, "label")});
    }
    all[episode] = from_frames(of_frame, painted);
  }
  return all;
}

Segmentations answered_segments(const ScoringJob& job, const std::string& label_column) {
  Segmentations all;
  const std::set<std::int64_t> tests(job.test_units.begin(), job.test_units.end());
  for (const std::int64_t episode : tests) all[episode].frames = frames_of(job.hidden, episode);
  const Rows& rows = job.answers.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::int64_t episode = rows.integer(i, "episode");
    if (!tests.contains(episode)) continue;
    const std::int64_t first = rows.integer(i, "first_frame"), end = rows.integer(i, "end_frame");
    Segmentation& one = all[episode];
    const std::string where = job.answers.where + ", answer " + std::to_string(i + 1);
    const std::string span = "[" + std::to_string(first) + ", " + std::to_string(end) + ")";
    if (first < 0 || end > one.frames)
      throw Error(where, "the segment " + span + " goes beyond the frames of episode " + std::to_string(episode),
                  "it has frames 0 to " + std::to_string(one.frames - 1) + "; end_frame is the frame after the last");
    if (first >= end) throw Error(where, "the segment " + span + " is empty", "end_frame is the frame after the last");
    one.segments.push_back({first, end, rows.is_null(i, label_column) ? "" : rows.text(i, label_column)});
  }
  for (auto& [episode, one] : all) {
    std::sort(one.segments.begin(), one.segments.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 1; i < one.segments.size(); ++i)
      if (one.segments[i].first < one.segments[i - 1].end)
        throw Error(job.answers.where,
                    "segments of episode " + std::to_string(episode) + " overlap at frame " +
                        std::to_string(one.segments[i].first),
                    "give each frame to one segment at most");
  }
  return all;
}

std::vector<std::int64_t> boundaries_of(const Segmentation& one) {
  std::set<std::int64_t> frames;
  for (const LabelledSegment& segment : one.segments) frames.insert(segment.first), frames.insert(segment.end);
  frames.erase(0), frames.erase(one.frames);
  return {frames.begin(), frames.end()};
}

std::vector<int> segment_of_frames(const Segmentation& one) {
  std::vector<int> of_frame(static_cast<std::size_t>(one.frames), -1);
  for (std::size_t i = 0; i < one.segments.size(); ++i)
    for (std::int64_t frame = one.segments[i].first; frame < one.segments[i].end; ++frame)
      of_frame[static_cast<std::size_t>(frame)] = static_cast<int>(i);
  return of_frame;
}

}  // namespace stampede::research
