#include "db/recording/recording_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "db/recording/json_value.h"
#include "engine/base/enum_names.h"
#include "engine/base/file_scope.h"
#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/base/text_file.h"
#include "engine/render/png.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostStreams = 256;
constexpr std::array<std::string_view, 7> kKinds{"joints", "gripper", "command", "wrench", "channel", "rgb", "depth"};

StreamKind kind_of(const Value& value) {
  const std::string& name = value.as_text();
  if (const auto kind = enum_from<StreamKind>(kKinds, name)) return *kind;
  throw Error(value.place, "there is no kind of stream '" + name + "'",
              did_you_mean(name, {kKinds.begin(), kKinds.end()}));
}

double finite_or(const Value& object, const std::string& field, double otherwise) {
  const double value = object.number_or(field, otherwise);
  if (!std::isfinite(value)) object[field].expected("a finite number");
  return value;
}

Transform base_pose(const Value& base) {
  if (!base.present()) return Transform::Identity();
  require_fields(base, {"position", "quaternion"});
  Pose pose;
  const Vector3 at = base.vector_or("position", Vector3::Zero());
  pose.position = {at.x(), at.y(), at.z()};
  if (const Value& turn = base["quaternion"]; turn.present()) {
    const std::vector<double> q = turn.as_numbers();
    if (q.size() != 4) turn.expected("four numbers: x, y, z, w");
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(std::abs(length - 1) < 1e-3))
      throw Error(turn.place, "a quaternion has length 1, and this one has not",
                  "write x, y, z, w; [0, 0, 0, 1] turns nothing");
    for (std::size_t i = 0; i < 4; ++i) pose.quaternion[i] = q[i] / length;
  }
  return to_transform(pose);
}

void read_robot(const Value& robot, RecordingFile& recording) {
  std::vector<std::string> known = {"name", "base", "urdf"};
  const bool own = robot["urdf"].present();
  if (own) known.insert(known.end(), {"arm", "fingers", "pads", "tip", "opening", "home", "velocity", "effort"});
  require_fields(robot, known);
  recording.world_from_base = base_pose(robot["base"]);
  recording.robot = plain_name(required(robot, "name", "name the robot: \"panda\""));
  if (!own) return;
  recording.urdf = robot["urdf"].as_text();
  recording.path_of(recording.urdf, robot["urdf"].place);
  required(robot, "arm", "list the names of its driven joints, from base to tip");
  required(robot, "tip", "give {\"link\": …, \"at\": [0, 0, 0.1]}");
  recording.robot_fields = robot;
  for (const char* ours : {"name", "base", "urdf"}) recording.robot_fields.fields.erase(ours);
}

void read_clocks(const Value& clocks, RecordingFile& recording) {
  if (!clocks.present()) return;
  if (!clocks.is_table() || is_list(clocks)) clocks.expected("an object of clocks by name");
  for (const auto& [name, fields] : clocks.fields) {
    require_fields(fields, {"offset_s", "drift_ppm", "reference_s"});
    const RecordingClock clock{name, finite_or(fields, "offset_s", 0), finite_or(fields, "drift_ppm", 0),
                               finite_or(fields, "reference_s", 0), fields["reference_s"].present()};
    if (!(std::abs(clock.drift_ppm) < 1e5))
      expected(fields["drift_ppm"], "a drift in millionths, below 100000", "a quartz has some dozens: write 40");
    recording.clocks.push_back(clock);
  }
}

void read_pictures(const Value& value, const RecordingFile& recording, RecordedStream& stream) {
  std::vector<std::string> known = {"kind", "camera", "folder", "times", "clock"};
  if (stream.kind == StreamKind::depth) known.insert(known.end(), {"unit_m", "near_m", "far_m"});
  require_fields(value, known);
  stream.name = plain_name(required(value, "camera", "name the camera of the pictures"));
  stream.file = required(value, "folder", "name the folder of the pictures").as_text();
  stream.times = value.text_or("times", "");
  if (!fs::is_directory(recording.path_of(stream.file, value["folder"].place, "folder")))
    value["folder"].expected("a folder of pictures");
  if (!stream.times.empty()) recording.path_of(stream.times, value["times"].place);
  if (stream.kind == StreamKind::rgb) return;
  stream.unit_m = required(value, "unit_m", "0.001 for millimetres").as_number();
  stream.near_m = finite_or(value, "near_m", 0);
  stream.far_m = finite_or(value, "far_m", 65535 * kDepthUnit);
  if (!(stream.unit_m > 0 && stream.unit_m <= 0.1)) value["unit_m"].expected("a length in m, such as 0.001");
  if (!(stream.near_m >= 0 && stream.far_m > stream.near_m && stream.far_m <= 65535 * kDepthUnit))
    throw Error(value.place, "near_m must not be below 0 and far_m lie beyond it, up to 6.5535 m",
                "of a RealSense: \"near_m\": 0.3, \"far_m\": 3.0");
}

void read_numbers(const Value& value, const RecordingFile& recording, RecordedStream& stream) {
  std::vector<std::string> known = {"kind", "file", "clock"};
  if (stream.kind == StreamKind::wrench) known.insert(known.end(), {"name", "link"});
  if (stream.kind == StreamKind::channel) known.insert(known.end(), {"name", "unit"});
  require_fields(value, known);
  stream.file = required(value, "file", "name its CSV file").as_text();
  recording.path_of(stream.file, value["file"].place);
  stream.name = to_string(stream.kind);
  if (stream.kind == StreamKind::wrench) {
    if (value["name"].present()) stream.name = plain_name(value["name"]);
    stream.link = required(value, "link", "name the link in whose frame it was measured").as_text();
    stream.unit = "N, N m";
  } else if (stream.kind == StreamKind::channel) {
    stream.name = plain_name(required(value, "name", "name the channel"));
    stream.unit = required(value, "unit", "give the unit of its values").as_text();
  }
}

void read_streams(const Value& streams, RecordingFile& recording) {
  if (streams.items.empty()) streams.expected("a list of streams, of which one has the kind \"joints\"");
  if (streams.items.size() > kMostStreams)
    throw Error(streams.place,
                "it has " + std::to_string(streams.items.size()) + " streams, at most " + std::to_string(kMostStreams),
                "join channels: one may have many columns");
  std::vector<std::string> seen;
  for (const Value& value : streams.items) {
    if (!value.is_table()) value.expected("an object: { \"kind\": …, … }");
    RecordedStream stream;
    stream.place = value.place;
    stream.kind = kind_of(required(value, "kind", "one of joints, gripper, command, wrench, channel, rgb, depth"));
    if (value["clock"].present()) stream.clock = recording.clock(value["clock"]);
    stream.pictures() ? read_pictures(value, recording, stream) : read_numbers(value, recording, stream);
    const bool channel = stream.kind == StreamKind::wrench || stream.kind == StreamKind::channel;
    const std::string key = (channel ? "channel" : std::string(to_string(stream.kind))) + " " + stream.name;
    if (std::find(seen.begin(), seen.end(), key) != seen.end())
      throw Error(value.place, "there is another stream of the same kind and name", "join them, or name one otherwise");
    seen.push_back(key);
    recording.streams.push_back(std::move(stream));
  }
  const auto joints = std::find_if(recording.streams.begin(), recording.streams.end(),
                                   [](const RecordedStream& stream) { return stream.kind == StreamKind::joints; });
  if (joints == recording.streams.end())
    throw Error(streams.place, "there is no stream of kind \"joints\"", "frames are made of joint states: record them");
  std::rotate(recording.streams.begin(), joints, joints + 1);
}

void read_outcome(const Value& root, RecordingFile& recording) {
  const Value& outcome = required(root, "outcome", "write \"success\" or \"failure\"");
  if (outcome.as_text() != "success" && outcome.text != "failure")
    throw Error(outcome.place, "there is no outcome '" + outcome.text + "'", "write \"success\" or \"failure\"");
  recording.detail = root.text_or("detail", "");
  if (outcome.text == "success") {
    if (root["reason"].present()) throw Error(root["reason"].place, "a success has no reason", "leave it out");
    return;
  }
  recording.outcome = Outcome::failure;
  recording.reason = Reason::failed_by_task;
  const Value& reason = root["reason"];
  if (!reason.present()) return;
  const auto known = reason_from(reason.as_text());
  if (known && *known != Reason::none) {
    recording.reason = *known;
    return;
  }
  throw Error(reason.place, "there is no reason '" + reason.text + "'", did_you_mean(reason.text, failure_reasons()));
}

}  // namespace

std::string_view to_string(StreamKind kind) { return enum_name(kKinds, kind); }

std::string RecordingFile::shown_path(const std::string& file) const { return (folder / file).string(); }

fs::path RecordingFile::path_of(const std::string& file, const std::string& place, const char* what) const {
  const fs::path path = folder / file;
  try {
    FileScope({folder}).check(path);
  } catch (const Error& error) {
    throw Error(place, error.message(), "files of a recording lie in its folder");
  }
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw Error(place, "there is no " + std::string(what) + " '" + path.string() + "'",
                "copy it into the recording, or leave it out");
  return path;
}

const RecordingClock& RecordingFile::clock(const Value& name) const {
  for (const RecordingClock& one : clocks)
    if (one.name == name.as_text()) return one;
  throw Error(
      name.place, "there is no clock '" + name.as_text() + "'",
      clocks.empty() ? "name it: \"clocks\": {\"" + name.text + "\": {}}" : did_you_mean(name.text, names_of(clocks)));
}

std::vector<std::string> failure_reasons() {
  std::vector<std::string> names;
  for (const Reason one : all_reasons())
    if (one != Reason::none) names.emplace_back(to_string(one));
  return names;
}

RecordingFile read_recording(const fs::path& folder) {
  RecordingFile recording;
  recording.folder = folder;
  recording.shown = (folder / "recording.json").string();
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw Error(folder.string(), "there is no such folder", "name a recording folder; db/recording/README.md");
  if (!fs::exists(folder / "recording.json", ignored))
    throw Error(folder.string(), "this folder has no recording.json", "see db/recording/README.md");
  recording.text = read_text_file(recording.path_of("recording.json", recording.shown));
  const Value root = value_from_json(recording.text, recording.shown);
  require_fields(root, {"stampede_recording", "task", "outcome", "reason", "detail", "world", "frame_hz", "start_s",
                        "end_s", "robot", "clocks", "streams", "cameras", "labels", "source"});
  const Value& version = required(root, "stampede_recording", "write \"stampede_recording\": 1");
  if (version.as_number() != 1)
    throw Error(version.place, "this program reads version 1 of recordings, not " + plain_text(version),
                "write \"stampede_recording\": 1, or take a newer program");
  recording.task = plain_name(required(root, "task", "name what was done"));
  read_outcome(root, recording);
  recording.world = root.text_or("world", "");
  recording.source = root.text_or("source", "");
  const double hz = root.number_or("frame_hz", recording.frame_hz);
  if (!(hz >= 1 && hz <= kMostFrameHz && hz == std::floor(hz)))
    expected(root["frame_hz"], "a whole number of frames a second, 1 to 1000", "write \"frame_hz\": 30");
  recording.frame_hz = static_cast<int>(hz);
  if (root["start_s"].present()) recording.start_s = finite_or(root, "start_s", 0);
  if (root["end_s"].present()) recording.end_s = finite_or(root, "end_s", 0);
  read_robot(required(root, "robot", "write \"robot\": { \"name\": \"panda\" }"), recording);
  read_clocks(root["clocks"], recording);
  read_streams(required(root, "streams", "list what was recorded"), recording);
  recording.cameras = root.text_or("cameras", "");
  recording.labels = root.text_or("labels", "");
  if (!recording.cameras.empty()) recording.path_of(recording.cameras, root["cameras"].place);
  if (!recording.labels.empty()) recording.path_of(recording.labels, root["labels"].place);
  return recording;
}

}  // namespace stampede
