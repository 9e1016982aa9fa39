#include "scripting/commands/torque_noise_file.h"

#include <set>

#include "engine/base/error.h"
#include "engine/base/read_json.h"

namespace stampede::program {
namespace {

using Json = nlohmann::json;

constexpr const char* kVersion = "stampede_torque_noise";
constexpr const char* kRefit = "write it with `python -m stampede.torque_noise RECORDING --out FILE.json`";

enum class Range { any, not_negative, positive };

double number_in(const Json& object, const std::string& place, const char* name, Range range) {
  const auto found = object.find(name);
  if (found == object.end() || !found->is_number())
    throw Error(place, std::string("'") + name + "' is no number", kRefit);
  const auto value = found->get<double>();
  if ((range == Range::positive && value <= 0) || (range == Range::not_negative && value < 0))
    throw Error(place,
                std::string("'") + name + "' must " + (range == Range::positive ? "be above 0" : "not be negative"),
                kRefit);
  return value;
}

JointTorqueNoise joint_from(const Json& object, const std::string& place) {
  if (!object.is_object() || !object.contains("joint") || !object["joint"].is_string())
    throw Error(place, "an object with the name of a 'joint' is expected", kRefit);
  require_known_fields(
      object, {"joint", "coulomb_nm", "smooth_rad_s", "viscous_nm_s_rad", "offset_nm", "drift_nm", "white_nm"}, place);
  JointTorqueNoise noise;
  noise.joint = object["joint"].get<std::string>();
  if (noise.joint.empty() || noise.joint.find_first_of(" ,") != std::string::npos)
    throw Error(place, "'" + noise.joint + "' is no name of a joint", "name it as the URDF does");
  noise.coulomb = number_in(object, place, "coulomb_nm", Range::not_negative);
  noise.smooth = number_in(object, place, "smooth_rad_s", Range::positive);
  noise.viscous = number_in(object, place, "viscous_nm_s_rad", Range::not_negative);
  noise.offset = number_in(object, place, "offset_nm", Range::any);
  noise.drift = number_in(object, place, "drift_nm", Range::any);
  noise.white = number_in(object, place, "white_nm", Range::not_negative);
  return noise;
}

}  // namespace

TorqueNoise load_torque_noise(const std::filesystem::path& file) {
  const Json json = json_from_file(file, kRefit);
  const std::string place = file.string();
  if (!json.is_object() || !json.contains(kVersion) || json[kVersion] != 1)
    throw Error(place, std::string("it is no torque noise: '") + kVersion + "' is not 1", kRefit);
  require_known_fields(json, {kVersion, "drift_time_s", "fitted_to", "recorded_s", "joints"}, place);
  TorqueNoise noise;
  noise.drift_time_s = number_in(json, place, "drift_time_s", Range::positive);
  noise.recorded_s = number_in(json, place, "recorded_s", Range::not_negative);
  const auto joints = json.find("joints");
  if (joints == json.end() || !joints->is_array() || joints->empty())
    throw Error(place, "a list of 'joints' is expected", kRefit);
  std::set<std::string> names;
  for (std::size_t i = 0; i < joints->size(); ++i) {
    const std::string at = place + " at joints[" + std::to_string(i) + "]";
    noise.joints.push_back(joint_from((*joints)[i], at));
    if (!names.insert(noise.joints.back().joint).second)
      throw Error(at, "joint '" + noise.joints.back().joint + "' is there twice", "remove one");
  }
  return noise;
}

}  // namespace stampede::program
