#include "db/recording/import_recording.h"

#include <algorithm>
#include <cmath>

#include "db/recording/label_file.h"
#include "db/recording/picture_stream.h"
#include "db/recording/recording_scene.h"
#include "db/recording/robot_track.h"
#include "engine/base/text.h"
#include "engine/record/keyframes.h"
#include "engine/record/observation.h"
#include "engine/record/scene_record.h"
#include "engine/render/png.h"

namespace stampede {
namespace {

constexpr int kTicks = 1'000'000;          // a second, about: steps of a real episode
constexpr double kMostFrames = 1'000'000;  // nine hours at 30 a second
constexpr const char* kNoKey = "no key yet: its pictures are being read";
constexpr double kSameMoment = 1e-6;  // s
constexpr double kSlowest = 0.9;      // s between joint states: 1000 Hz in milliseconds are beyond

std::string seconds(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f s", value);
  return text.data();
}

class Importer {
 public:
  Importer(const std::filesystem::path& folder, const RecordingStager& stager, const ImportOptions& options)
      : recording_(read_recording(folder)), stager_(stager), options_(options) {
    own_hz_ = recording_.frame_hz;
    if (options.frame_hz) recording_.frame_hz = *options.frame_hz;
    if (options.world) recording_.world = *options.world;
    hasher_.text("recording 1").text(recording_.text).number(recording_.frame_hz).text(recording_.world);
  }
  // All but the pictures themselves, and so without the key.
  EpisodeRecord import() {
    settle_references();
    scene_ = scene_of(recording_, stager_, hasher_);
    read_robot();
    set_times();
    describe();
    fill_frames(scene_.stage.scene, tracks_, times_, record_);
    describe_robot_streams();
    for (const RecordedStream& stream : recording_.streams) {
      if (stream.kind == StreamKind::wrench || stream.kind == StreamKind::channel) add_channel(stream);
      if (stream.pictures()) add_camera(stream);
    }
    std::sort(record_.image_times.begin(), record_.image_times.end(), [](const auto& a, const auto& b) {
      return std::tie(a.frame, a.camera, a.kind) < std::tie(b.frame, b.camera, b.kind);
    });
    images_->set_makers(options_.workers);
    if (images_->count() > 0) record_.images = images_;
    record_.made.key = kNoKey;
    record_.labels.keyframes["stopped"] = stopped_keyframes(record_);
    if (!recording_.labels.empty()) {
      const std::filesystem::path file = recording_.path_of(recording_.labels, recording_.shown);
      put_labels(read_labels(file, recording_.shown_path(recording_.labels), record_, {&recording_, own_times_}),
                 record_);
    }
    return std::move(record_);
  }
  std::vector<std::string> notes() const { return notes_; }
  // Once, when all pictures were read.
  std::string key() {
    for (const auto& part : later_) part(hasher_);
    return hasher_.digest();
  }

 private:
  const RecordedStream* stream_of(StreamKind kind) const {
    for (const RecordedStream& stream : recording_.streams)
      if (stream.kind == kind) return &stream;
    return nullptr;
  }

  // Into the key: now, or after the pictures that come before it.
  void hash(const std::string& text) {
    if (later_.empty())
      hasher_.text(text);
    else
      later_.emplace_back([text](Hasher& hasher) { hasher.text(text); });
  }
  Track track_of(const RecordedStream& stream, std::vector<TrackColumn> columns) {
    Track track = read_track(recording_, stream, std::move(columns), [this](const std::string& text) { hash(text); });
    readings_ += track.values.size();
    if (readings_ > kMostReadings)
      throw Error(stream.place,
                  "with this stream the recording has more than " + std::to_string(kMostReadings) +
                      " readings, rows times columns",
                  "cut it into shorter recordings, or leave streams out");
    return track;
  }

  void read_robot() {
    const Robot& robot = scene_.stage.scene.robot;
    const RecordedStream& joints = *stream_of(StreamKind::joints);
    joints_ = track_of(joints, joint_columns(robot));
    check_joint_limits(recording_, joints, joints_, robot);
    tracks_.joints = &joints_;
    if (const RecordedStream* gripper = stream_of(StreamKind::gripper)) {
      gripper_ = track_of(*gripper, {{"opening_m", true}, {"effort_n", false}});
      check_openings(recording_, *gripper, gripper_, robot);
      tracks_.gripper = &gripper_;
    }
    if (const RecordedStream* command = stream_of(StreamKind::command)) {
      command_ = track_of(*command, command_columns(robot));
      check_joint_limits(recording_, *command, command_, robot);
      check_openings(recording_, *command, command_, robot);
      tracks_.command = &command_;
    }
  }

  // Milliseconds taken for seconds are slow, and nothing else tells them.
  void require_seconds() const {
    const double period = median_period(joints_.time);
    if (period > kSlowest)
      throw Error(recording_.shown_path(stream_of(StreamKind::joints)->file),
                  "its joint states are " + seconds(period) + " apart: frames cannot be made of so few",
                  "stamps are in seconds: divide those in milliseconds by 1000");
  }

  // What a drift counts from where nobody says it: the first stamp of its clock, in whichever of its streams.
  void settle_references() {
    for (RecordingClock& clock : recording_.clocks) {
      if (clock.reference_given || clock.drift_ppm == 0) continue;
      std::optional<double> first;
      for (RecordedStream stream : recording_.streams) {
        if (stream.clock.name != clock.name) continue;
        stream.clock = {};  // its stamps as they are
        const double stamp = stream.pictures()
                                 ? read_picture_stream(recording_, stream).time.front()
                                 : read_track(recording_, stream, {}, [](const std::string&) {}).time.front();
        first = std::min(first.value_or(stamp), stamp);
      }
      clock.reference_s = first.value_or(0);
      for (RecordedStream& stream : recording_.streams)
        if (stream.clock.name == clock.name) stream.clock = clock;
    }
  }

  void set_times() {
    require_seconds();
    const double begin = recording_.start_s.value_or(joints_.time.front());
    const double end = recording_.end_s.value_or(joints_.time.back());
    const auto frames_at = [&](int hz) { return std::floor((end - begin) * hz + kSameMoment * hz) + 1; };
    const double count = frames_at(recording_.frame_hz);
    if (!(count >= 2))
      throw Error(recording_.shown, "it has no two frames: from " + seconds(begin) + " to " + seconds(end),
                  "record joint states for longer, or correct start_s and end_s");
    for (const int hz : {recording_.frame_hz, own_hz_})
      if (frames_at(hz) > kMostFrames)
        throw Error(recording_.shown,
                    "from " + seconds(begin) + " to " + seconds(end) + " are " + std::to_string(hz) +
                        " frames a second more than a million frames",
                    "are all stamps in seconds, and start_s and end_s on the recording's time line? If so, lower "
                    "frame_hz, or cut it into shorter recordings");
    times_ = {begin, recording_.frame_hz, static_cast<std::size_t>(count)};
    own_times_ = {begin, own_hz_, static_cast<std::size_t>(frames_at(own_hz_))};
    require_overlap(*stream_of(StreamKind::joints), joints_.time);
    if (tracks_.gripper != nullptr) require_overlap(*stream_of(StreamKind::gripper), gripper_.time);
    if (tracks_.command != nullptr) require_overlap(*stream_of(StreamKind::command), command_.time);
  }

  void require_overlap(const RecordedStream& stream, const std::vector<double>& time) const {
    if (time.front() <= times_.end() && time.back() >= times_.begin) return;
    throw Error(stream.place,
                "none of its readings lies within the recording: they are from " + seconds(time.front()) + " to " +
                    seconds(time.back()) + ", and its frames from " + seconds(times_.begin) + " to " +
                    seconds(times_.end()),
                "give its clock's offset_s: by how much its stamps are too small");
  }

  void describe() {
    Scene& scene = scene_.stage.scene;
    const int ticks = std::max(1, kTicks / recording_.frame_hz);
    scene.physics_hz = ticks * recording_.frame_hz;
    describe_scene(scene, record_);
    record_.real = true;
    record_.task = recording_.task;
    record_.outcome = recording_.outcome;
    record_.reason = recording_.reason;
    record_.detail = recording_.detail;
    record_.steps = static_cast<std::int64_t>(times_.count - 1) * ticks;
    if (!recording_.source.empty()) record_.made.options["recording"] = recording_.source;
    const std::string uncalibrated = joined({scene_.uncalibrated.begin(), scene_.uncalibrated.end()}, ",");
    if (!uncalibrated.empty()) record_.made.options["uncalibrated"] = uncalibrated;
    record_.made.definitions = scene_.stage.definitions;
  }

  StreamRecord& describe_stream(const RecordedStream& stream, const std::vector<double>& time, const char* rule) {
    StreamRecord& record = record_.streams.emplace_back();
    record.kind = to_string(stream.kind);
    record.name = stream.name;
    record.file = stream.file;
    record.clock = stream.clock.name;
    record.offset_s = stream.clock.offset_s;
    record.drift_ppm = stream.clock.drift_ppm;
    record.reference_s = stream.clock.reference_s;
    record.origin_s = times_.begin;
    record.rule = rule;
    describe_times(time, times_.begin - kSameMoment, times_.end() + kSameMoment, record);
    return record;
  }

  void describe_robot_streams() {
    const auto missing = [&](const auto& is_there) {
      std::int64_t count = 0;
      for (std::size_t i = 0; i < record_.frames.size(); ++i) count += is_there(record_.frames[i]) ? 0 : 1;
      return count;
    };
    describe_stream(*stream_of(StreamKind::joints), joints_.time, "linear").missing =
        missing([](const FrameRecord& frame) { return !std::isnan(frame.hands[0].tip.position[0]); });
    if (tracks_.gripper != nullptr)
      describe_stream(*stream_of(StreamKind::gripper), gripper_.time, "linear").missing =
          missing([](const FrameRecord& frame) { return !std::isnan(frame.hands[0].opening); });
    if (tracks_.command != nullptr)
      describe_stream(*stream_of(StreamKind::command), command_.time, "hold").missing =
          missing([](const FrameRecord& frame) { return frame.action.has_value(); }) - 1;  // the last has none
  }

  void add_channel(const RecordedStream& stream) {
    std::vector<TrackColumn> columns;
    if (stream.kind == StreamKind::wrench) {
      const Robot& robot = scene_.stage.scene.robot;
      if (robot.body.part_index(stream.link) < 0)
        throw Error(stream.place, robot.name + " has no link '" + stream.link + "'", "name a link of its URDF");
      for (const char* name : {"force_x_n", "force_y_n", "force_z_n", "torque_x_nm", "torque_y_nm", "torque_z_nm"})
        columns.push_back({name, true});
    }
    const Track track = track_of(stream, columns);
    require_overlap(stream, track.time);
    ChannelRecord channel;
    channel.name = stream.name;
    channel.unit = stream.unit;
    for (const TrackColumn& column : track.columns)  // `force_x_n` is force_x: the channel has the unit
      channel.components.push_back(stream.kind == StreamKind::wrench ? column.name.substr(0, column.name.rfind('_'))
                                                                     : column.name);
    for (std::size_t i = 0; i < track.time.size(); ++i) {
      if (track.time[i] < times_.begin - kSameMoment || track.time[i] > times_.end() + kSameMoment) continue;
      const auto step = static_cast<std::int64_t>(std::llround((track.time[i] - times_.begin) * record_.physics_hz));
      channel.steps.push_back(std::clamp<std::int64_t>(step, 0, record_.steps));
      channel.values.insert(channel.values.end(), track.values.begin() + static_cast<std::ptrdiff_t>(i * track.width()),
                            track.values.begin() + static_cast<std::ptrdiff_t>((i + 1) * track.width()));
    }
    channel.rate_hz = describe_stream(stream, track.time, "kept").rate_hz;
    record_.channels.push_back(std::move(channel));
  }

  void add_camera(const RecordedStream& stream) {
    const PictureStream pictures = read_picture_stream(recording_, stream);
    if (!pictures.note.empty()) notes_.push_back(pictures.note);
    require_overlap(stream, pictures.time);
    const std::vector<std::int64_t> chosen = nearest(pictures.time, times_);
    const auto camera = std::find_if(record_.scene.cameras.begin(), record_.scene.cameras.end(),
                                     [&](const Camera& one) { return one.name == stream.name; });
    const int index = static_cast<int>(camera - record_.scene.cameras.begin());
    StreamRecord& described = describe_stream(stream, pictures.time, "nearest");
    for (std::size_t frame = 0; frame < chosen.size(); ++frame) {
      if (chosen[frame] < 0) {
        ++described.missing;
        continue;
      }
      const double time = pictures.time[static_cast<std::size_t>(chosen[frame])] - times_.begin;
      record_.image_times.push_back(
          {static_cast<std::int64_t>(frame), index, std::string(to_string(stream.kind)), time});
    }
    later_.emplace_back([digest = add_pictures(stream, pictures, chosen, *camera, index, *images_),
                         times = pictures.time](Hasher& hasher) {
      hasher.text(digest());
      for (const double time : times) hasher.number(time);
    });
  }

  RecordingFile recording_;
  const RecordingStager& stager_;
  ImportOptions options_;
  Hasher hasher_;
  std::vector<std::function<void(Hasher&)>> later_;
  RecordingScene scene_;
  Track joints_, gripper_, command_;
  RobotTracks tracks_;
  FrameTimes times_, own_times_;  // own: at the rate that recording.json says
  int own_hz_ = 0;
  std::size_t readings_ = 0;
  EpisodeRecord record_;
  std::vector<std::string> notes_;
  std::shared_ptr<ImageStore> images_ = std::make_shared<ImageStore>();
};

}  // namespace

EpisodeRecord record_of(const std::filesystem::path& folder, const RecordingStager& stager,
                        const ImportOptions& options) {
  Importer importer(folder, stager, options);
  EpisodeRecord record = importer.import();
  if (record.images) record.images->read_all([](const ImageRecord&, const Bytes&) {});
  record.made.key = importer.key();
  return record;
}

StoredRecording store_recording(const std::filesystem::path& folder, const RecordingStager& stager,
                                const ImportOptions& options, Catalogue& catalogue, const EngineInfo& engine) {
  Importer importer(folder, stager, options);
  StoredRecording stored;
  stored.episode = importer.import();
  stored.notes = importer.notes();
  EpisodeRecord& episode = stored.episode;
  const auto alike = [&](const EpisodeSummary& one) {
    return one.task == episode.task && one.frames == static_cast<std::int64_t>(episode.frames.size());
  };
  const std::vector<EpisodeSummary> there = catalogue.episodes();
  std::optional<std::int64_t> id;
  if (!episode.images || std::any_of(there.begin(), there.end(), alike)) {
    if (episode.images) episode.images->read_all([](const ImageRecord&, const Bytes&) {});
    episode.made.key = importer.key();
    id = catalogue.add_if_new(episode, engine);
  } else {
    id = catalogue.add_if_new(episode, engine, [&] { return episode.made.key = importer.key(); });
  }
  stored.added = id.has_value();
  stored.id = id ? *id : catalogue.find(episode.made.key).value_or(0);
  return stored;
}

}  // namespace stampede
