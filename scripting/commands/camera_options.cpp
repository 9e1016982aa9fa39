// Cameras that the command line brings along.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "engine/base/names.h"
#include "engine/base/naming.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"
#include "engine/model/camera.h"
#include "scripting/commands/picture_options.h"

namespace stampede::program {
namespace {

constexpr const char* kOption = "--add-camera";
constexpr const char* kExample = "NAME=at:1,0,1.5;look:0.2,0,0.75;fov:40;size:128x128";

// What a camera can be fixed to, by the names that people use.
struct Mount {
  std::string body;
  int part = 0;
};

std::map<std::string, Mount> mounts_of(const Scene& scene) {
  std::map<std::string, Mount> mounts = {{"world", {}}};
  const auto add = [&](const Body& body, const std::string& name, const std::string& shown) {
    mounts.try_emplace(shown, Mount{name, 0});
    for (std::size_t i = 0; i < body.parts.size(); ++i)
      mounts.try_emplace(shown + "." + body.parts[i].name, Mount{name, static_cast<int>(i)});
  };
  add(scene.robot.body, scene.robot.name, scene.robot.name);
  for (const Body& body : scene.bodies) add(body, body.name, body.name);
  return mounts;
}

Vector3 point_from(const std::string& name, const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 3) throw UsageError(fmt::format("{}: {} takes x,y,z, not '{}'", kOption, name, text), kExample);
  Vector3 point;
  for (std::size_t i = 0; i < 3; ++i)
    point[static_cast<Eigen::Index>(i)] = number_in(std::string(kOption) + " " + name, parts[i], -1000, 1000);
  return point;
}

std::map<std::string, std::string> fields_of(const std::string& text) {
  static const std::vector<std::string> known = {"at", "look", "up", "fov", "size", "near", "far", "mount"};
  std::map<std::string, std::string> fields;
  for (const std::string& one : split(text, ';')) {
    const std::size_t colon = one.find(':');
    const std::string name = one.substr(0, colon);
    if (colon == std::string::npos || std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError(fmt::format("{}: a camera has no '{}'", kOption, one), did_you_mean(name, known));
    if (!fields.emplace(name, one.substr(colon + 1)).second)
      throw UsageError(fmt::format("{}: '{}' is given twice", kOption, name));
  }
  for (const char* needed : {"at", "look"})
    if (!fields.contains(needed)) throw UsageError(fmt::format("{}: '{}' is missing", kOption, needed), kExample);
  return fields;
}

Camera camera_from(const std::string& text, const Scene& scene) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw UsageError(fmt::format("{} takes NAME=…, not '{}'", kOption, text), kExample);
  Camera camera;
  camera.name = text.substr(0, equals);
  if (name_fault(camera.name))
    throw UsageError(fmt::format("{}: '{}' cannot be a name", kOption, camera.name),
                     "small letters, digits and _, a letter first");
  std::map<std::string, std::string> fields = fields_of(text.substr(equals + 1));
  const auto number = [&](const char* name, double otherwise, double least, double most) {
    return fields.contains(name) ? number_in(fmt::format("{} {}", kOption, name), fields[name], least, most)
                                 : otherwise;
  };
  if (fields.contains("mount")) {
    const std::map<std::string, Mount> mounts = mounts_of(scene);
    const auto found = mounts.find(fields["mount"]);
    if (found == mounts.end())
      throw UsageError(fmt::format("{}: there is no '{}' to mount it on", kOption, fields["mount"]),
                       did_you_mean(fields["mount"], keys_of(mounts)));
    camera.mount_body = found->second.body;
    camera.mount_part = found->second.part;
  }
  const std::array<int, 2> size = fields.contains("size") ? size_from(kOption, fields["size"]) : std::array{128, 128};
  set_field_of_view(camera, number("fov", 40, 1, 170) * std::numbers::pi / 180, size[0], size[1]);
  camera.near_m = number("near", 0.01, 1e-4, 100);
  camera.far_m = number("far", 4.5, 1e-3, 1000);
  if (camera.near_m >= camera.far_m) throw UsageError(std::string(kOption) + ": near must be less than far");
  const Vector3 up = fields.contains("up") ? point_from("up", fields["up"]) : Vector3::UnitZ();
  const Vector3 at = point_from("at", fields["at"]), look = point_from("look", fields["look"]);
  if ((look - at).norm() < 1e-6) throw UsageError(std::string(kOption) + ": it cannot look at where it stands");
  camera.mount_from_camera = looking_at(at, look, up);
  return camera;
}

}  // namespace

std::vector<Camera> further_cameras(const Arguments& arguments, const Scene& scene) {
  std::vector<Camera> cameras;
  for (const std::string& file : arguments.list("--camera-file")) {
    const std::vector<Camera> calibrated = load_calibration(file, scene);
    cameras.insert(cameras.end(), calibrated.begin(), calibrated.end());
  }
  for (const std::string& text : arguments.list(kOption)) cameras.push_back(camera_from(text, scene));
  return cameras;
}

}  // namespace stampede::program
