#include "tests/support/lab.h"

#include <unistd.h>

#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "engine/model/masks.h"
#include "engine/render/png.h"
#include "tests/support/panda.h"

namespace stampede::test {

namespace fs = std::filesystem;

RecordingStager panda_stager() {
  return [](const RecordingFile& recording) {
    RecordingStage stage;
    stage.scene = table_scene(0);
    stage.scene.world = "none";
    stage.scene.bodies.clear();
    std::erase_if(stage.scene.objects, [](const Object& object) { return object.kind != ObjectKind::hand; });
    stage.scene.robot.body.world_from_body = recording.world_from_base;
    number_masks(stage.scene, RandomKey("lab"));
    return stage;
  };
}

double swing(double time, int joint) {
  constexpr std::array<double, 7> kHome{0, -0.785, 0, -2.356, 0, 1.571, 0.785};
  return kHome.at(static_cast<std::size_t>(joint)) + 0.2 * std::sin(2 * time + joint);
}

namespace {

std::string joints_csv() {
  std::string text = "time_s";
  for (int j = 1; j <= 7; ++j) text += ",joint" + std::to_string(j) + "_position_rad";
  for (int row = 0; row <= 200; ++row) {
    text += "\n" + std::to_string(100 + row * 0.01);
    for (int j = 0; j < 7; ++j) text += "," + std::to_string(swing(row * 0.01, j));
  }
  return text + "\n";
}

const char* const kRecording = R"({
  "stampede_recording": 1, "task": "swing", "outcome": "success", "frame_hz": 20,
  "robot": { "name": "panda", "base": { "position": [0, 0, 0.5] } },
  "clocks": { "arm": {} },
  "streams": [ { "kind": "joints", "file": "joints.csv", "clock": "arm" },
               { "kind": "gripper", "file": "gripper.csv", "clock": "arm" } ],
  "cameras": "cameras.json" })";

const char* const kCameras = R"({ "cameras": [
  { "name": "front", "width": 160, "height": 120, "camera_matrix": [[150, 0, 80], [0, 150, 60], [0, 0, 1]],
    "distortion": [0.05, -0.08, 0.0005, -0.0008, 0], "mount": "world",
    "mount_from_camera": [[0, 0, -1, 1.9], [1, 0, 0, 0], [0, -1, 0, 0.9], [0, 0, 0, 1]], "near": 0.05, "far": 5 },
  { "name": "wrist", "width": 160, "height": 120, "camera_matrix": [[120, 0, 80], [0, 120, 60], [0, 0, 1]],
    "mount": "robot.hand", "mount_from_camera": [[1, 0, 0, 0.07], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]] } ] })";

}  // namespace

Lab::Lab() {
  std::string name = (fs::temp_directory_path() / "stampede_lab_XXXXXX").string();
  folder_ = ::mkdtemp(name.data());
  write("recording.json", kRecording);
  write("cameras.json", kCameras);
  write("joints.csv", joints_csv());
  std::string gripper = "time_s,opening_m\n";
  for (int row = 0; row <= 100; ++row)
    gripper += std::to_string(100 + row * 0.02) + "," + (row < 50 ? "0.08" : "0.02") + "\n";
  write("gripper.csv", gripper);
}

Lab::~Lab() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void Lab::write(const std::string& name, const std::string& text) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string Lab::read(const std::string& name) const {
  std::ifstream file(folder_ / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void Lab::change(const std::function<void(nlohmann::json&)>& edit) const {
  nlohmann::json json = nlohmann::json::parse(read("recording.json"));
  edit(json);
  write("recording.json", json.dump());
}

void Lab::replace(const std::string& name, const std::string& from, const std::string& to) const {
  std::string text = read(name);
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error(name + " does not hold " + from);
  write(name, text.replace(at, from.size(), to));
}

void Lab::add_pictures(const std::string& camera, int count, double first_s, double hz, int width, int height) const {
  std::string times = "time_s,file\n";
  for (int i = 0; i < count; ++i) {
    const std::vector<std::uint8_t> rgb(static_cast<std::size_t>(3 * width * height), static_cast<std::uint8_t>(i));
    const Bytes png = png_of(width, height, rgb);
    const std::string name = std::to_string(i) + ".png";
    write(camera + "/" + name, {png.begin(), png.end()});
    times += std::to_string(first_s + i / hz) + "," + name + "\n";
  }
  write(camera + ".csv", times);
  change([&](nlohmann::json& json) {
    json["streams"].push_back({{"kind", "rgb"}, {"camera", camera}, {"folder", camera}, {"times", camera + ".csv"}});
  });
}

}  // namespace stampede::test
