#include "db/recording/export_recording.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "db/recording/robot_track.h"
#include "engine/base/file_name.h"
#include "engine/base/output_file.h"
#include "engine/model/camera.h"
#include "engine/render/png.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

// Shortest that is read back to the same bits; nothing where it is not known.
std::string number(double value) {
  if (std::isnan(value)) return {};
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

// An episode that was exported and imported is exported as the same bytes: a pose goes through a quaternion, which
// turns its last bits, and stamps of channels are stored to a microsecond. 1e-12 m, and 1e-6 s.
double coarse(double value, double steps) { return std::round(value * steps) / steps + 0.0; }  // no -0
constexpr double kPose = 1e12, kStamp = 1e6;

class Exporter {
 public:
  Exporter(const Catalogue& catalogue, const StoredEpisode& stored, const fs::path& folder)
      : catalogue_(catalogue),
        stored_(stored),
        episode_(stored.episode),
        robot_(stored.scene->robot),
        folder_(folder, "recording.json", {"a recording", {}, false}, {}) {
    for (const int part : robot_.arm)
      for (std::size_t i = 0; i < episode_.scene.joints.size(); ++i)
        if (episode_.scene.joints[i].part == PartRef{-1, part}) arm_.push_back(i);
  }
  std::int64_t run() {
    write_joints();
    write_gripper();
    write_commands();
    write_wrench();
    write_pictures();
    write_cameras();
    write_labels();
    write_root();
    return files_;
  }

 private:
  double time_of(std::size_t frame) const {
    return static_cast<double>(episode_.frames[frame].step) / episode_.physics_hz;
  }
  void write(const std::string& name, const std::string& text) {
    folder_.write(name, text);
    ++files_;
  }
  void add_stream(OrderedJson stream) { streams_.push_back(std::move(stream)); }

  void write_joints() {
    std::string text = "time_s";
    for (const TrackColumn& column : joint_columns(robot_)) text += "," + column.name;
    text += "\n";
    for (std::size_t i = 0; i < episode_.frames.size(); ++i) {
      const FrameRecord& frame = episode_.frames[i];
      text += number(time_of(i));
      for (const std::size_t joint : arm_)
        text += "," + number(frame.joint_position[joint]) + "," + number(frame.joint_velocity[joint]) + "," +
                number(frame.joint_effort[joint]);
      text += "\n";
    }
    write("joints.csv", text);
    add_stream({{"kind", "joints"}, {"file", "joints.csv"}});
  }

  void write_gripper() {
    if (robot_.fingers.empty()) return;
    std::string text = "time_s,opening_m\n";
    for (std::size_t i = 0; i < episode_.frames.size(); ++i)
      text += number(time_of(i)) + "," + number(episode_.frames[i].hands.at(0).opening) + "\n";
    write("gripper.csv", text);
    add_stream({{"kind", "gripper"}, {"file", "gripper.csv"}});
  }

  // An action holds from its frame on.
  void write_commands() {
    std::string text = "time_s";
    for (const TrackColumn& column : command_columns(robot_)) text += "," + column.name;
    text += "\n";
    bool any = false;
    for (std::size_t i = 0; i < episode_.frames.size(); ++i) {
      const auto& action = episode_.frames[i].action;
      if (!action || action->joint_position.size() != robot_.arm.size()) continue;
      any = true;
      text += number(time_of(i));
      for (const double position : action->joint_position) text += "," + number(position);
      text += "," + number(action->gripper) + "\n";
    }
    if (!any) return;
    write("command.csv", text);
    add_stream({{"kind", "command"}, {"file", "command.csv"}});
  }

  void write_wrench() {
    const auto sensor = std::find_if(stored_.scene->sensors.begin(), stored_.scene->sensors.end(),
                                     [](const Sensor& one) { return one.kind == "force_torque"; });
    for (const ChannelRecord& channel : episode_.channels) {
      if (channel.components.size() != 6 || channel.components[0] != "force_x") continue;
      std::string text = "time_s,force_x_n,force_y_n,force_z_n,torque_x_nm,torque_y_nm,torque_z_nm\n";
      for (std::size_t i = 0; i < channel.steps.size(); ++i) {
        text += number(coarse(static_cast<double>(channel.steps[i]) / episode_.physics_hz, kStamp));
        for (std::size_t c = 0; c < 6; ++c) text += "," + number(channel.values[6 * i + c]);
        text += "\n";
      }
      const int part = sensor == stored_.scene->sensors.end() ? robot_.tip_part : sensor->part;
      const std::string name = names_.take(channel.name) + ".csv";
      write(name, text);
      add_stream({{"kind", "wrench"},
                  {"name", channel.name},
                  {"link", robot_.body.parts[static_cast<std::size_t>(part)].name},
                  {"file", name}});
    }
  }

  void write_pictures() {
    std::map<std::pair<std::string, std::string>, std::string> times;  // camera, kind -> CSV
    std::map<std::pair<std::string, std::string>, std::string> folders;
    for (const ImageEntry& entry : catalogue_.images(stored_.id)) {
      if (entry.kind != "rgb" && entry.kind != "depth") continue;
      const Camera* camera = camera_of(entry.camera);
      if (camera == nullptr || (!camera->mount_body.empty() && camera->mount_body != robot_.name)) continue;
      const std::vector<std::uint8_t> bytes = catalogue_.read_image(stored_.id, entry.frame, entry.camera, entry.kind);
      const bool jpeg = bytes.size() > 1 && bytes[0] == 0xff && bytes[1] == 0xd8;
      const auto [place, is_new] = folders.try_emplace({entry.camera, entry.kind});
      if (is_new) place->second = names_.take(entry.camera + "_" + entry.kind);
      const std::string name = std::to_string(1'000'000 + entry.frame).substr(1) + (jpeg ? ".jpg" : ".png");
      write(place->second + "/" + name, {bytes.begin(), bytes.end()});
      std::string& csv = times[{entry.camera, entry.kind}];
      if (csv.empty()) csv = "time_s,file\n";
      csv += number(taken_at(entry)) + "," + name + "\n";
      sizes_[entry.camera] = {entry.width, entry.height};
    }
    for (const auto& [which, csv] : times) {
      const std::string& name = folders.at(which);
      write(name + ".csv", csv);
      OrderedJson stream = {
          {"kind", which.second}, {"camera", which.first}, {"folder", name}, {"times", name + ".csv"}};
      if (which.second == "depth") stream["unit_m"] = kDepthUnit;
      add_stream(std::move(stream));
    }
  }
  double taken_at(const ImageEntry& entry) const {
    for (const ImageTimeRecord& one : episode_.image_times)
      if (one.frame == entry.frame && one.kind == entry.kind &&
          episode_.scene.cameras.at(static_cast<std::size_t>(one.camera)).name == entry.camera)
        return one.time_s;
    return time_of(static_cast<std::size_t>(entry.frame));
  }
  const Camera* camera_of(const std::string& name) const {
    for (const Camera& camera : episode_.scene.cameras)
      if (camera.name == name) return &camera;
    return nullptr;
  }

  // Stand-ins for cameras that nobody calibrated would come back as if somebody had.
  void write_cameras() {
    if (episode_.made.options.contains("uncalibrated")) return;
    OrderedJson list = OrderedJson::array();
    for (const Camera& own : episode_.scene.cameras) {
      const bool on_robot = own.mount_body == robot_.name;
      if (!own.mount_body.empty() && !on_robot) continue;
      const auto size = sizes_.find(own.name);
      const Camera c = size == sizes_.end() ? own : resized(own, size->second[0], size->second[1]);
      OrderedJson matrix = OrderedJson::array();
      for (int row = 0; row < 4; ++row) {
        OrderedJson line = OrderedJson::array();
        for (int column = 0; column < 4; ++column)
          line.push_back(coarse(c.mount_from_camera.matrix()(row, column), kPose));
        matrix.push_back(std::move(line));
      }
      const std::string link = on_robot ? robot_.body.parts[static_cast<std::size_t>(c.mount_part)].name : "";
      list.push_back({{"name", c.name},
                      {"width", c.width},
                      {"height", c.height},
                      {"camera_matrix", {{c.focal_x, 0, c.centre_x}, {0, c.focal_y, c.centre_y}, {0, 0, 1}}},
                      {"distortion", c.distortion},
                      {"mount", on_robot ? "robot." + link : "world"},
                      {"mount_from_camera", std::move(matrix)},
                      {"near", c.near_m},
                      {"far", c.far_m},
                      {"pixel_centres", "half"}});
    }
    has_cameras_ = !list.empty();
    if (has_cameras_) write("cameras.json", OrderedJson{{"cameras", std::move(list)}}.dump(1) + "\n");
  }

  // Nor does what begins at the last frame, where the episode ends.
  bool takes_no_frame(std::int64_t first, std::int64_t end) const {
    return first >= end || first + 1 >= static_cast<std::int64_t>(episode_.frames.size());
  }

  void write_labels() {
    OrderedJson segments = OrderedJson::array(), facts = OrderedJson::array(), language = OrderedJson::array();
    for (const SegmentRecord& s : episode_.labels.segments) {
      if (s.span.start_step >= s.span.end_step || takes_no_frame(s.span.first_frame, s.span.end_frame)) continue;
      segments.push_back({{"kind", to_string(s.kind)},
                          {"name", s.skill},
                          {"arguments", s.arguments},
                          {"first_frame", s.span.first_frame},
                          {"end_frame", s.span.end_frame},
                          {"outcome", s.outcome == Outcome::success ? "success" : "failure"}});
      if (s.outcome == Outcome::failure) segments.back()["reason"] = to_string(s.reason);
      if (!s.label.empty()) segments.back()["label"] = s.label;
    }
    std::set<std::pair<std::string, std::int64_t>> ends;
    for (const FactRecord& f : episode_.labels.facts) {
      if (takes_no_frame(f.first_frame, f.end_frame) || f.fact.arguments.size() > 4) continue;
      OrderedJson words = OrderedJson::array({f.fact.predicate});
      for (const std::string& word : f.fact.arguments) words.push_back(word);
      facts.push_back({{"fact", std::move(words)}, {"first_frame", f.first_frame}, {"end_frame", f.end_frame}});
    }
    for (const LanguageRecord& l : episode_.labels.language)
      if (l.segment < 0) language.push_back({{"level", to_string(l.level)}, {"text", l.text}});
    if (segments.empty() && facts.empty() && language.empty()) return;
    has_labels_ = true;
    OrderedJson root = {{"labelled_by", "model"},
                        {"model", "simulator"},
                        {"segments", std::move(segments)},
                        {"facts", std::move(facts)},
                        {"language", std::move(language)}};
    if (episode_.real && !episode_.labels.segments.empty() &&
        episode_.labels.segments[0].labelled_by == Labeller::person) {
      root["labelled_by"] = "person";
      root.erase("model");
    }
    write("labels.json", root.dump(1) + "\n");
  }

  void write_root() {
    Pose base = to_pose(robot_.body.world_from_body);
    for (double& value : base.position) value = coarse(value, kPose);
    for (double& value : base.quaternion) value = coarse(value, kPose);
    OrderedJson root = {{"stampede_recording", 1},
                        {"task", episode_.task},
                        {"outcome", episode_.outcome == Outcome::success ? "success" : "failure"}};
    if (episode_.outcome == Outcome::failure) root["reason"] = to_string(episode_.reason);
    if (!episode_.detail.empty()) root["detail"] = episode_.detail;
    if (episode_.world != "none") root["world"] = episode_.world;
    root["frame_hz"] = episode_.frame_hz;
    root["robot"] = {{"name", robot_.name}, {"base", {{"position", base.position}, {"quaternion", base.quaternion}}}};
    root["streams"] = streams_;
    if (has_cameras_) root["cameras"] = "cameras.json";
    if (has_labels_) root["labels"] = "labels.json";
    const auto recorded = episode_.made.options.find("recording");
    root["source"] = episode_.real && recorded != episode_.made.options.end()
                         ? recorded->second
                         : "exported from episode " + std::to_string(stored_.id) + ", key " + episode_.made.key;
    write("recording.json", root.dump(1) + "\n");
  }

  const Catalogue& catalogue_;
  const StoredEpisode& stored_;
  const EpisodeRecord& episode_;
  const Robot& robot_;
  const OutputFolder folder_;
  FileNames names_{{"joints", "gripper", "command", "cameras", "labels", "recording"}};
  std::vector<std::size_t> arm_;  // places of its joints in the episode's
  OrderedJson streams_ = OrderedJson::array();
  std::map<std::string, std::array<int, 2>> sizes_;  // of stored pictures, by camera
  bool has_cameras_ = false, has_labels_ = false;
  std::int64_t files_ = 0;
};

}  // namespace

std::int64_t export_recording(const Catalogue& catalogue, const StoredEpisode& stored, const fs::path& folder) {
  return Exporter(catalogue, stored, folder).run();
}

}  // namespace stampede
