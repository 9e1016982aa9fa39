#include "scripting/library/new_robot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "engine/base/error.h"
#include "engine/geometry/corners.h"
#include "engine/model/kinematics.h"
#include "engine/model/urdf.h"

namespace stampede {
namespace {

// Joints, each with the link that it moves: name, axis, where it is on the link before, lower, upper, rad/s, N m.
struct Axis {
  const char *link, *joint, *axis;
  double up;
  double lower, upper, velocity, effort;
  const char* shape;
  double shape_up, mass;
};
constexpr Axis kAxes[] = {
    {"shoulder", "pan", "0 0 1", 0.10, -3.0, 3.0, 2.5, 150, R"(<cylinder radius="0.055" length="0.10"/>)", 0.05, 3},
    {"upper_arm", "lift", "0 1 0", 0.10, -2.0, 2.0, 2.5, 150, R"(<box size="0.09 0.09 0.40"/>)", 0.19, 5},
    {"forearm", "elbow", "0 1 0", 0.39, -2.7, 2.7, 2.5, 100, R"(<box size="0.07 0.07 0.32"/>)", 0.17, 3},
    {"wrist", "roll", "0 0 1", 0.34, -3.0, 3.0, 3.5, 40, R"(<cylinder radius="0.032" length="0.06"/>)", 0.02, 1},
    {"wrist_fork", "bend", "0 1 0", 0.06, -2.0, 2.0, 3.5, 40, R"(<box size="0.055 0.055 0.06"/>)", 0.02, 1},
    {"flange", "turn", "0 0 1", 0.06, -3.0, 3.0, 3.5, 30, R"(<cylinder radius="0.032" length="0.03"/>)", 0.01, 0.5},
};

std::string link(std::string_view name, std::string_view shape, double up, double mass) {
  const std::string geometry = fmt::format(R"(<origin xyz="0 0 {}"/><geometry>{}</geometry>)", up, shape);
  const double inertia = mass * 0.01;
  return fmt::format(R"(  <link name="{0}">
    <inertial><origin xyz="0 0 {1}"/><mass value="{2}"/><inertia ixx="{3}" iyy="{3}" izz="{3}" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual>{4}</visual>
    <collision>{4}</collision>
  </link>
)",
                     name, up, mass, inertia, geometry);
}

std::string finger(std::string_view side, int sign) {
  return link(std::string(side) + "_finger", R"(<box size="0.02 0.01 0.06"/>)", 0.03, 0.05) +
         fmt::format(R"(  <joint name="{0}_slide" type="prismatic">
    <parent link="hand"/><child link="{0}_finger"/><origin xyz="0 {2} 0.06"/><axis xyz="0 {1} 0"/>
    <limit lower="0" upper="0.04" velocity="0.2" effort="40"/>
  </joint>
)",
                     side, sign, 0.005 * sign);
}

const Part& part_of(const Body& body, int part) { return body.parts[static_cast<std::size_t>(part)]; }

// Two sliding joints of one link that move against each other.
std::vector<int> fingers_of(const Body& body) {
  const auto axis = [&](int part) {
    const Joint& joint = part_of(body, part).joint;
    return Vector3(joint.parent_from_joint.linear() * joint.axis);
  };
  for (int b = static_cast<int>(body.parts.size()) - 1; b > 0; --b)
    for (int a = b - 1; a > 0; --a)
      if (part_of(body, a).joint.kind == JointKind::slider && part_of(body, b).joint.kind == JointKind::slider &&
          part_of(body, a).parent == part_of(body, b).parent && axis(a).dot(axis(b)) < -0.9)
        return {a, b};
  return {};
}

// The joints that move a link, from the base on.
std::vector<int> chain_to(const Body& body, int part) {
  std::vector<int> chain;
  for (; part > 0; part = part_of(body, part).parent)
    if (part_of(body, part).joint.kind != JointKind::fixed) chain.insert(chain.begin(), part);
  return chain;
}

int furthest_link(const Body& body) {
  int furthest = 0;
  for (int part = 1; part < static_cast<int>(body.parts.size()); ++part)
    if (chain_to(body, part).size() > chain_to(body, furthest).size()) furthest = part;
  return furthest;
}

// How far shapes of a part reach along z of the frame that it is given in.
double reach_along_z(const Part& part, const Transform& frame_from_part) {
  if (part.shapes.empty()) return frame_from_part.translation().z();
  const auto [low, high] = bounding_box(part);
  double most = -1e9;
  for (const Vector3& corner : box_corners(low, high)) most = std::max(most, (frame_from_part * corner).z());
  return most;
}

Robot robot_of(Body body) {
  Robot robot;
  robot.body = std::move(body);
  robot.fingers = fingers_of(robot.body);
  robot.tip_part = robot.fingers.empty() ? furthest_link(robot.body) : part_of(robot.body, robot.fingers[0]).parent;
  robot.arm = chain_to(robot.body, robot.tip_part);
  double end = 0, closing = std::numbers::pi / 2;
  if (robot.fingers.empty()) {
    end = reach_along_z(part_of(robot.body, robot.tip_part), Transform::Identity());
  } else {
    const Part& one = part_of(robot.body, robot.fingers[0]);
    const Vector3 axis = one.joint.parent_from_joint.linear() * one.joint.axis;
    constexpr double kPads = 0.01;  // m before the fingers' ends
    end = reach_along_z(one, one.joint.parent_from_joint) - kPads;
    closing = std::atan2(axis.y(), axis.x());
    robot.opening_max = one.joint.upper + part_of(robot.body, robot.fingers[1]).joint.upper;
  }
  robot.tip_part_from_tip = translation(0, 0, end) * rotation_rpy(0, 0, closing - std::numbers::pi / 2);
  for (const int part : robot.arm) {
    const Joint& joint = part_of(robot.body, part).joint;
    robot.limits.push_back({joint.lower, joint.upper, joint.velocity, 10, 5000, joint.effort});
    robot.home.push_back((joint.lower + joint.upper) / 2);
  }
  return robot;
}

// The hand pointing down, in front of the arm at half of its reach.
void set_home(Robot& robot) {
  double reach = robot.tip_part_from_tip.translation().norm();
  for (std::size_t i = 1; i < robot.arm.size(); ++i)
    reach += part_of(robot.body, robot.arm[i]).joint.parent_from_joint.translation().norm();
  const Arm arm(robot);
  std::optional<JointVector> found;
  for (const double out : {0.5, 0.4, 0.3})
    for (const double turn : {0.0, 0.5, 1.0, 1.5})  // of the hand about the vertical, in half turns
      if (!found)
        found = arm.solve(
            translation(out * reach, 0, 0.3 * reach) * rotation_rpy(0, std::numbers::pi, turn * std::numbers::pi),
            arm.home(), RandomKey("new robot"));
  if (!found) return;
  for (std::size_t i = 0; i < robot.home.size(); ++i)
    robot.home[i] = std::clamp(std::round(1000 * (*found)[static_cast<Eigen::Index>(i)]) / 1000, robot.limits[i].lower,
                               robot.limits[i].upper);
}

std::string part_names(const Body& body, const std::vector<int>& parts) {
  std::vector<std::string> names;
  for (const int part : parts) names.push_back('"' + part_of(body, part).joint.name + '"');
  return fmt::format("{{ {} }}", fmt::join(names, ", "));
}

}  // namespace

std::string small_arm_urdf(std::string_view name) {
  std::string text = fmt::format("<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n", name);
  text += link("base", R"(<cylinder radius="0.08" length="0.10"/>)", 0.05, 5);
  const char* before = "base";
  for (const Axis& axis : kAxes) {
    text += link(axis.link, axis.shape, axis.shape_up, axis.mass);
    text += fmt::format(R"(  <joint name="{}" type="revolute">
    <parent link="{}"/><child link="{}"/><origin xyz="0 0 {}"/><axis xyz="{}"/>
    <limit lower="{}" upper="{}" velocity="{}" effort="{}"/>
  </joint>
)",
                        axis.joint, before, axis.link, axis.up, axis.axis, axis.lower, axis.upper, axis.velocity,
                        axis.effort);
    before = axis.link;
  }
  text += link("hand", R"(<box size="0.04 0.14 0.05"/>)", 0.03, 0.6);
  text += fmt::format(
      "  <joint name=\"mount\" type=\"fixed\"><parent link=\"{}\"/><child link=\"hand\"/><origin xyz=\"0 0 "
      "0.02\"/></joint>\n",
      before);
  return text + finger("left", 1) + finger("right", -1) + "</robot>\n";
}

std::string robot_file(const std::filesystem::path& urdf) {
  Robot robot = robot_of(read_urdf(urdf).body);
  const Body& body = robot.body;
  if (robot.arm.empty())
    throw Error(urdf.string(), "nothing in it turns or slides", "an arm has revolute or prismatic joints with limits");
  set_home(robot);
  const Vector3 at = robot.tip_part_from_tip.translation();
  const double yaw = std::atan2(robot.tip_part_from_tip.linear()(1, 0), robot.tip_part_from_tip.linear()(0, 0));
  std::string text =
      fmt::format("-- An arm of {} joints: say here in one line what it is.\nreturn robot {{\n", robot.arm.size());
  text += fmt::format("  urdf = \"{}\",\n  arm = {}, -- from base to tip\n", urdf.filename().string(),
                      part_names(body, robot.arm));
  if (!robot.fingers.empty()) {
    text += fmt::format("  fingers = {0},\n  pads = {{ \"{1}\", \"{2}\" }}, -- links whose contact is touch\n",
                        part_names(body, robot.fingers), part_of(body, robot.fingers[0]).name,
                        part_of(body, robot.fingers[1]).name);
    text += fmt::format("  opening = {:.4g}, grip_force = 20, -- m, N\n", robot.opening_max);
  }
  text += fmt::format("  tip = {{ link = \"{}\", at = {{ 0, 0, {:.4g} }}", part_of(body, robot.tip_part).name, at.z());
  if (std::abs(yaw) > 1e-6) text += fmt::format(", rpy = {{ 0, 0, {:.5g} }}", yaw);
  text += " }, -- z out of the hand, y along the closing axis\n";
  text += fmt::format("  home = {{ {:.4g} }}, -- rad\n", fmt::join(robot.home, ", "));
  return text +
         "  limits = { acceleration = 10, jerk = 5000 }, -- rad/s^2, rad/s^3; speeds and torques are the URDF's\n}\n";
}

}  // namespace stampede
