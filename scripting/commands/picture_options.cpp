#include "scripting/commands/picture_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"
#include "engine/rollout/sensors.h"
#include "scripting/commands/torque_noise_file.h"

namespace stampede::program {
namespace {

constexpr double kKinect = 0.00145;   // 1/m, see CameraNoise
constexpr double kMostTorque = 1000;  // N m

OptionRow text_option(const char* name, const char* value, const char* help, bool repeats = false) {
  return {name, value, help, Takes::text, "", {}, repeats};
}

void read_kinds(const std::string& text, ObservationChoice& choice) {
  choice.kinds = PictureKinds::none();
  choice.points = false;
  for (const std::string& name : split(text, ',')) {
    const auto kind = picture_kind_from(name);
    if (!kind && name != "points") {
      std::vector<std::string> all = {"points"};
      for (const PictureKind one : kPictureKinds) all.emplace_back(to_string(one));
      const auto near = nearest(name, all);
      throw UsageError("--kinds: there is no kind of picture '" + name + "'",
                       (near ? "did you mean '" + *near + "'? " : std::string()) +
                           "the kinds are rgb, depth, instance, semantic, points");
    }
    if (kind)
      choice.kinds->add(*kind);
    else
      choice.points = true;
  }
}

// `arm.json`, and no number.
bool is_file_name(const std::string& text) { return text.ends_with(".json") || text.find('/') != std::string::npos; }

void read_noise(const std::string& text, PictureUse use, ObservationChoice& choice) {
  const std::string cure = use == PictureUse::run ? "rgb=0.02,depth=kinect,torque=0.1" : "rgb=0.02,depth=kinect";
  for (const std::string& one : split(text, ',')) {
    const std::size_t equals = one.find('=');
    const std::string name = one.substr(0, equals);
    if (equals == std::string::npos) throw UsageError("--noise takes NAME=NUMBER, not '" + one + "'", cure);
    const std::string value = one.substr(equals + 1);
    if (name == "rgb") {
      choice.rgb_noise = number_in("--noise rgb", value, 0, 1);
    } else if (name == "depth") {
      choice.depth_noise = value == "kinect" ? kKinect : number_in("--noise depth", value, 0, 1);
    } else if (name == "torque" && use == PictureUse::run && is_file_name(value)) {
      choice.torque_model = load_torque_noise(value);
    } else if (name == "torque" && use == PictureUse::run) {
      choice.torque_noise = number_in("--noise torque", value, 0, kMostTorque);
    } else {
      throw UsageError("--noise: there is no noise of '" + name + "' here", cure);
    }
  }
}

std::vector<std::string> channels_from(const std::string& text) {
  if (text == "none") return {};
  std::vector<std::string> names = split(text, ',');
  std::replace(names.begin(), names.end(), std::string("all"), std::string("*"));
  return names;
}

}  // namespace

double number_in(const std::string& option, const std::string& text, double least, double most) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw UsageError(option + " takes a number, not '" + text + "'");
  if (value < least || value > most)
    throw UsageError(fmt::format("{} lies within {} and {}, not at {}", option, least, most, text));
  return value;
}

std::array<int, 2> size_from(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = split(text, 'x');
  std::array<int, 2> size{};
  if (parts.size() != 2) throw UsageError(option + " takes WIDTHxHEIGHT, not '" + text + "'", option + " 128x128");
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string& part = parts[i];
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), size[i]);
    const bool read = error == std::errc() && end == part.data() + part.size();
    if (!read && error != std::errc::result_out_of_range)
      throw UsageError(option + " takes WIDTHxHEIGHT, not '" + text + "'", option + " 128x128");
    if (!read || size[i] < 1 || size[i] > kLargestSide)
      throw UsageError(option + ": a picture has 1 to " + std::to_string(kLargestSide) + " pixels a side, not " + part);
  }
  return size;
}

std::vector<OptionRow> picture_options(PictureUse use) {
  const bool run = use == PictureUse::run;
  std::vector<OptionRow> rows;
  if (run)
    rows.push_back({"--images",
                    "WHICH",
                    "frames whose pictures are stored",
                    Takes::text,
                    "",
                    {"none", "keyframes", "all"},
                    false});
  rows.push_back(text_option("--camera", "NAME", "only this camera; default: all of the world", true));
  rows.push_back(text_option("--size", "WxH", "pixels; default: each camera's own"));
  rows.push_back(text_option("--kinds", "LIST", "of rgb, depth, instance, semantic, points; default: all but points"));
  rows.push_back(text_option("--noise", "LIST",
                             run ? "such as rgb=0.02,depth=kinect,torque=0.1: deviations of 0 … 1, 1/m, N m; "
                                   "torque=FILE.json: fitted to an arm"
                                 : "such as rgb=0.02,depth=kinect: deviations of 0 … 1 and 1/m"));
  rows.push_back({"--shadows", "", "the light casts shadows", Takes::flag, "", {}, false});
  rows.push_back({"--renderer",
                  "NAME",
                  "who draws: own, or osmesa, Mesa's OpenGL, to compare with",
                  Takes::text,
                  "own",
                  {"own", "osmesa"},
                  false});
  rows.push_back({"--camera-file",
                  "FILE",
                  "cameras as they were calibrated (JSON); they go before the world's",
                  Takes::path,
                  "",
                  {},
                  true});
  rows.push_back(text_option("--add-camera", "CAMERA",
                             "NAME=at:1,0,1.5;look:0.2,0,0.75, then as wanted ;fov:40;size:128x128;near:0.01;far:4.5;"
                             "up:0,0,1;mount:panda.hand (m and degrees, in the frame of the mount)",
                             true));
  if (run)
    rows.push_back(text_option("--channels", "LIST",
                               "sensors of the world to record, all or none; and margins: by how much each fact holds "
                               "or fails to (all,margins)"));
  return rows;
}

ObservationChoice picture_choice(const Arguments& arguments, PictureUse use) {
  ObservationChoice choice;
  if (use == PictureUse::run && arguments.has("--images"))
    choice.images = which_frames_from(arguments.text("--images"));
  if (arguments.has("--camera")) choice.cameras = arguments.list("--camera");
  if (arguments.has("--size")) choice.size = size_from("--size", arguments.text("--size"));
  if (arguments.has("--kinds")) read_kinds(arguments.text("--kinds"), choice);
  if (arguments.has("--noise")) read_noise(arguments.text("--noise"), use, choice);
  if (arguments.flag("--shadows")) choice.shadows = true;
  if (arguments.has("--renderer")) choice.renderer = drawn_by_from(arguments.text("--renderer"));
  if (use == PictureUse::run && arguments.has("--channels"))
    choice.channels = channels_from(arguments.text("--channels"));
  return choice;
}

void check_choice(const ObservationChoice& choice, const Scene& scene) {
  const std::vector<std::string> sensors = channel_names(scene);
  const std::vector<std::string> cameras = names_of(scene.cameras);
  for (const std::string& name : choice.cameras.value_or(std::vector<std::string>{}))
    if (std::find(cameras.begin(), cameras.end(), name) == cameras.end())
      throw UsageError("--camera: there is no camera '" + name + "'", did_you_mean(name, cameras));
  for (const std::string& name : choice.channels.value_or(std::vector<std::string>{}))
    if (name != "*" && std::find(sensors.begin(), sensors.end(), name) == sensors.end())
      throw UsageError("--channels: the world has no sensor '" + name + "'", did_you_mean(name, sensors));
  if (choice.torque_model) of_arm(*choice.torque_model, arm_joints(scene.robot));
}

}  // namespace stampede::program
