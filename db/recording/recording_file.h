// recording.json: what a recording folder holds, checked. See README.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/reason.h"
#include "engine/geometry/value.h"
#include "engine/record/record.h"

namespace stampede {

// A clock of the recording: the time line's time of a stamp, s.
struct RecordingClock {
  std::string name;  // empty: the time line itself
  double offset_s = 0, drift_ppm = 0, reference_s = 0;
  bool reference_given = false;  // else it is the first stamp of the clock, which is in its streams
  double time(double stamp) const { return stamp + offset_s + drift_ppm * 1e-6 * (stamp - reference_s); }
};

enum class StreamKind { joints, gripper, command, wrench, channel, rgb, depth };
std::string_view to_string(StreamKind kind);

struct RecordedStream {
  StreamKind kind = StreamKind::joints;
  std::string name;   // of the camera or channel; of the others their kind
  std::string place;  // in recording.json, for complaints
  std::string file;   // in the folder: a CSV, or the folder of the pictures
  std::string times;  // of pictures: a CSV; empty: their names are stamps
  RecordingClock clock;
  std::string link;                          // wrench
  std::string unit;                          // channel
  double unit_m = 0, near_m = 0, far_m = 0;  // depth
  bool pictures() const { return kind == StreamKind::rgb || kind == StreamKind::depth; }
};

struct RecordingFile {
  std::filesystem::path folder;
  std::string shown;  // `lab/recording.json`
  std::string text;   // of the file
  std::string task, world, source;
  Outcome outcome = Outcome::success;
  Reason reason = Reason::none;
  std::string detail;
  int frame_hz = 30;
  std::optional<double> start_s, end_s;
  std::string robot;  // its name
  std::string urdf;   // in the folder; empty: a robot of the library
  Value robot_fields;
  Transform world_from_base = Transform::Identity();
  std::vector<RecordingClock> clocks;
  std::vector<RecordedStream> streams;  // the joints first
  std::string cameras, labels;          // files in the folder; empty: none

  // A file in the folder. Throws Error, with `place`, where it lies outside or is not there.
  std::filesystem::path path_of(const std::string& file, const std::string& place, const char* what = "file") const;
  std::string shown_path(const std::string& file) const;
  const RecordingClock& clock(const Value& name) const;  // throws Error for one that is not there
};

inline constexpr int kMostFrameHz = 1000;

std::vector<std::string> failure_reasons();  // their names

RecordingFile read_recording(const std::filesystem::path& folder);  // throws Error

}  // namespace stampede
