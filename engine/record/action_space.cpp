#include "engine/record/action_space.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/model/operation.h"

namespace stampede {
namespace {

constexpr double kToolSpeed = 1.7, kToolTurn = 2.5;            // m/s, rad/s
constexpr double kReach_m = 1.5;                               // of any pose, from the robot's base
constexpr double kFarthest_m = 3, kHalfTurn = 3.1416;          // of a path
constexpr double kLeastStiffness = 10, kMostStiffness = 3000;  // N/m
constexpr double kSlack = 1e-9;                                // of bounds: a sum of deltas may miss them by a digit
constexpr double kSinglePrecision = 1.2e-7;  // share of a bound by which it may be missed that was stored as a float
constexpr double kOverStop = 1e-3;           // rad, m: where an arm or a hand stands may be asked for again

using Components = std::vector<ActionComponent>;

void add(Components& components, std::initializer_list<const char*> names, const char* unit, double most) {
  for (const char* name : names) components.push_back({name, unit, -most, most});
}

Components pose_components(const Vector3& base) {
  Components components;
  const std::array<const char*, 3> names = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    components.push_back({names[static_cast<std::size_t>(i)], "m", base[i] - kReach_m, base[i] + kReach_m});
  add(components, {"qx", "qy", "qz", "qw"}, "1", 1);
  return components;
}

Components twist_components(const char* metres, double way, const char* radians, double turn) {
  Components components;
  add(components, {"x", "y", "z"}, metres, way);
  add(components, {"rx", "ry", "rz"}, radians, turn);
  return components;
}

struct NamedLimits {
  std::string name;
  JointLimits limits;
};

std::vector<ActionSpace> all_spaces(const std::vector<NamedLimits>& joints, const Vector3& base, double frame_s,
                                    double opening_max) {
  Components positions, deltas, velocities, torques;
  for (const auto& [name, limits] : joints) {
    positions.push_back({name, "rad", limits.lower, limits.upper});
    deltas.push_back({name, "rad", -limits.velocity * frame_s, limits.velocity * frame_s});
    velocities.push_back({name, "rad/s", -limits.velocity, limits.velocity});
    torques.push_back({name, "N m", -limits.effort, limits.effort});
  }
  const Components pose = pose_components(base);
  Components soft = pose;
  soft.push_back({"stiffness", "N/m", kLeastStiffness, kMostStiffness});
  return {{"joint_position", positions},
          {"joint_delta", deltas},
          {"joint_velocity", velocities},
          {"joint_torque", torques},
          {"tool_pose", pose},
          {"tool_delta", twist_components("m", kToolSpeed * frame_s, "rad", kToolTurn * frame_s)},
          {"tool_velocity", twist_components("m/s", kToolSpeed, "rad/s", kToolTurn)},
          {"tool_impedance", soft},
          {"tool_path", pose},
          {"tool_path_delta", twist_components("m", kFarthest_m, "rad", kHalfTurn)},
          {"gripper", {{"opening", "m", 0, opening_max}}},
          {"release", {}},
          {"hold", {}},
          {"skill", {}},
          {"go_on", {}}};
}

std::string number(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6).ptr};
}

const ActionSpace* named_space(const std::vector<ActionSpace>& spaces, std::string_view name) {
  const auto found =
      std::find_if(spaces.begin(), spaces.end(), [&](const ActionSpace& one) { return one.name == name; });
  return found == spaces.end() ? nullptr : &*found;
}

std::optional<ActionRefusal> mistake_in_value(const ActionComponent& component, double value, double over = 0) {
  if (!std::isfinite(value)) return ActionRefusal{component.name + " is not a finite number", "give a number"};
  const auto slack = [&](double bound) { return over + kSlack + kSinglePrecision * std::abs(bound); };
  if (value >= component.lower - slack(component.lower) && value <= component.upper + slack(component.upper))
    return std::nullopt;
  return ActionRefusal{component.name + " is out of its bounds: " + number(value) + " " + component.unit,
                       "it goes from " + number(component.lower) + " to " + number(component.upper)};
}

std::optional<ActionRefusal> mistake_in_values(const AgentAction& action, const ActionSpace& space) {
  if (action.values.size() != space.components.size())
    return ActionRefusal{action.space + " has " + std::to_string(space.components.size()) + " values, not " +
                             std::to_string(action.values.size()),
                         "spaces() lists them"};
  const double over = action.space == "joint_position" || action.space == "gripper" ? kOverStop : 0;
  const bool pose = action.space == "tool_pose" || action.space == "tool_path" || action.space == "tool_impedance";
  for (std::size_t i = 0; i < action.values.size(); ++i) {
    ActionComponent component = space.components[i];
    if (pose && action.frame == "tool" && i < 3) component.lower = -kReach_m, component.upper = kReach_m;
    if (auto refusal = mistake_in_value(component, action.values[i], over)) return refusal;
  }
  if (pose && Eigen::Vector4d(action.values[3], action.values[4], action.values[5], action.values[6]).norm() < 1e-3)
    return ActionRefusal{"its quaternion has no length", "x y z, then the quaternion x y z w: 0 0 0 1"};
  return std::nullopt;
}

}  // namespace

bool is_of_tool(std::string_view space) { return space.starts_with("tool_"); }

bool is_planned(std::string_view space) { return space == "tool_path" || space == "tool_path_delta"; }

bool lasts_a_frame(std::string_view space) {
  return !is_planned(space) && space != "skill" && space != "hold" && space != "go_on";
}

std::vector<ActionSpace> action_spaces(const Scene& scene) {
  std::vector<NamedLimits> joints;
  for (std::size_t j = 0; j < scene.robot.arm.size(); ++j) {
    const auto part = static_cast<std::size_t>(scene.robot.arm[j]);
    joints.push_back({scene.robot.name + "." + scene.robot.body.parts[part].joint.name, scene.robot.limits[j]});
  }
  return all_spaces(joints, scene.robot.body.world_from_body.translation(), 1.0 / scene.frame_hz,
                    scene.robot.opening_max);
}

std::vector<ActionSpace> named_spaces(const std::vector<std::string>& joints) {
  std::vector<NamedLimits> limits;
  for (const std::string& name : joints) limits.push_back({name, {}});
  std::vector<ActionSpace> spaces = all_spaces(limits, Vector3::Zero(), 1, 0);
  for (ActionSpace& space : spaces)
    for (ActionComponent& one : space.components) one = {one.name, one.unit};
  return spaces;
}

std::optional<ActionRefusal> mistake_in(const AgentAction& action, const std::vector<ActionSpace>& spaces) {
  const ActionSpace* space = named_space(spaces, action.space);
  if (space == nullptr)
    return ActionRefusal{"there is no action space '" + action.space + "'",
                         did_you_mean(action.space, names_of(spaces))};
  if (action.frame != "world" && action.frame != "tool")
    return ActionRefusal{"there is no frame of reference '" + action.frame + "'", "say world or tool"};
  if (auto refusal = mistake_in_values(action, *space)) return refusal;
  if (action.gripper)
    if (auto refusal = mistake_in_value(named_space(spaces, "gripper")->components.front(), *action.gripper, kOverStop))
      return refusal;
  if (!action.controller.empty() && !controller_from(action.controller))
    return ActionRefusal{"there is no controller '" + action.controller + "'",
                         did_you_mean(action.controller, controller_names())};
  if (action.frames < 0) return ActionRefusal{"a number of frames is not negative", "0: to its end"};
  return std::nullopt;
}

}  // namespace stampede
