#include <algorithm>

#include "engine/base/nearest.h"
#include "engine/sim/self_pairs.h"
#include "scripting/runtime/evaluate.h"
#include "scripting/runtime/scene_builder.h"

namespace stampede {
namespace {

// A part is named by its link or by the joint that moves it.
int part_index_of(const Body& body, const std::string& name, const Value& where) {
  for (std::size_t i = 0; i < body.parts.size(); ++i) {
    if (body.parts[i].name == name || body.parts[i].joint.name == name) return static_cast<int>(i);
  }
  std::vector<std::string> known;
  for (const Part& part : body.parts) {
    known.push_back(part.name);
    if (!part.joint.name.empty()) known.push_back(part.joint.name);
  }
  throw Error(where.place, "the URDF has no link or joint '" + name + "'", did_you_mean(name, known));
}

int part_named(const Body& body, const Value& value) { return part_index_of(body, value.as_text(), value); }

const Value& either(const Value& fields, std::string_view name, std::string_view other) {
  return fields[name].present() ? fields[name] : fields[other];
}

std::vector<int> parts_named(const Body& body, const Value& list) {
  std::vector<int> parts;
  for (const Value& item : list.items) parts.push_back(part_named(body, item));
  return parts;
}

// One number for each joint of the arm, or one for all.
std::vector<double> per_joint(const Value& fields, std::string_view name, std::size_t joints) {
  const Value& value = fields[name];
  if (!value.present()) return {};
  if (value.kind == Value::Kind::number) return std::vector<double>(joints, value.number);
  std::vector<double> numbers = value.as_numbers();
  if (numbers.size() != joints) value.expected(std::to_string(joints) + " numbers, one for each joint of the arm");
  return numbers;
}

// A mesh in millimetres makes a link of hundreds of metres.
void check_sizes(const Body& body, const Value& where) {
  constexpr double kLargestLink = 5;  // m
  for (const Part& part : body.parts) {
    if (part.shapes.empty()) continue;
    const auto [low, high] = bounding_box(part);
    const double largest = (high - low).maxCoeff();
    if (!(largest <= kLargestLink) && largest > -1)
      throw Error(where.place,
                  "link '" + part.name + "' of the URDF is " + std::to_string(static_cast<long>(largest)) + " m long",
                  "sizes are in metres: scale=\"0.001 0.001 0.001\" at meshes in millimetres");
  }
}

// Driven joints: what moves and is no finger, in the order of the URDF, unless the file lists them.
std::vector<int> arm_parts(const Value& fields, const Robot& robot) {
  const Value& listed = fields["arm"];
  if (listed.present()) return parts_named(robot.body, listed);
  std::vector<int> parts;
  for (std::size_t i = 1; i < robot.body.parts.size(); ++i) {
    const int part = static_cast<int>(i);
    const bool finger = std::find(robot.fingers.begin(), robot.fingers.end(), part) != robot.fingers.end();
    if (robot.body.parts[i].joint.kind != JointKind::fixed && !finger) parts.push_back(part);
  }
  return parts;
}

void read_limits(const Value& fields, Robot& robot) {
  const std::size_t joints = robot.arm.size();
  const Value& written = fields["limits"].present() ? fields["limits"] : fields;
  const std::vector<double> acceleration = per_joint(written, "acceleration", joints);
  const std::vector<double> jerk = per_joint(written, "jerk", joints);
  const std::vector<double> velocity = per_joint(written, "velocity", joints);
  const std::vector<double> effort = per_joint(written, "effort", joints);
  for (std::size_t i = 0; i < joints; ++i) {
    const Joint& joint = robot.body.parts[static_cast<std::size_t>(robot.arm[i])].joint;
    JointLimits limits{joint.lower, joint.upper, joint.velocity, 10, 5000, joint.effort};
    if (!velocity.empty()) limits.velocity = velocity[i];
    if (!acceleration.empty()) limits.acceleration = acceleration[i];
    if (!jerk.empty()) limits.jerk = jerk[i];
    if (!effort.empty()) limits.effort = effort[i];
    robot.limits.push_back(limits);
  }
  robot.home = per_joint(fields, "home", joints);
  if (robot.home.empty()) robot.home.assign(joints, 0.0);
  for (std::size_t i = 0; i < joints; ++i) {
    if (robot.home[i] < robot.limits[i].lower || robot.home[i] > robot.limits[i].upper) {
      throw Error(fields["home"].place, "joint " + std::to_string(i + 1) + " is outside its limits");
    }
    robot.body.parts[static_cast<std::size_t>(robot.arm[i])].joint.initial = robot.home[i];
  }
}

void read_hand(const Value& fields, Robot& robot) {
  const Value& tip = fields["tip"];
  const Value& tip_part = either(tip, "link", "part");
  robot.tip_part =
      tip_part.present() ? part_named(robot.body, tip_part) : static_cast<int>(robot.body.parts.size()) - 1;
  robot.tip_part_from_tip = transform_from(tip);
  robot.pads = fields["pads"].present() ? parts_named(robot.body, fields["pads"]) : robot.fingers;
  robot.opening_max = fields.number_or("opening", robot.opening_max);
  robot.grip_force = fields.number_or("grip_force", robot.grip_force);
  robot.finger_speed = fields.number_or("finger_speed", robot.finger_speed);
  robot.hand = fields.text_or("hand", robot.hand);
  // Measured: the anchor and a little spinning and rolling friction hold thin and round things best.
  const Surface pad = surface_from(fields["pad"], {fields.number_or("pad_friction", 1.0), 0.01, 0.01, 0, true});
  for (const int part : robot.pads) robot.body.parts[static_cast<std::size_t>(part)].surface = pad;
}

void read_pairs(const Value& fields, Robot& robot) {
  const auto ends = [&](const Value& pair) {
    if (pair.items.size() != 2) pair.expected("a pair { link, link }");
    const int a = part_named(robot.body, pair.items[0]), b = part_named(robot.body, pair.items[1]);
    return std::pair(std::min(a, b), std::max(a, b));
  };
  // Found by looking at the arm all over its range, unless the file says that a pair may touch; or is to be checked
  // too.
  robot.checked_pairs = pairs_that_meet(robot);
  for (const Value& pair : either(fields, "checked", "checked_pairs").items) robot.checked_pairs.push_back(ends(pair));
  for (const Value& pair : either(fields, "allowed", "allowed_pairs").items)
    std::erase(robot.checked_pairs, ends(pair));
  std::sort(robot.checked_pairs.begin(), robot.checked_pairs.end());
  robot.checked_pairs.erase(std::unique(robot.checked_pairs.begin(), robot.checked_pairs.end()),
                            robot.checked_pairs.end());
}

}  // namespace

void check_fingers(const Value& listed, const Robot& robot) {
  if (robot.fingers.empty()) return;
  if (robot.fingers.size() != 2)
    throw Error(listed.place, "a hand closes two sliding joints, not " + std::to_string(robot.fingers.size()),
                "name two prismatic joints, or none for an arm without a hand");
  for (std::size_t i = 0; i < 2; ++i) {
    const Joint& joint = robot.body.parts[static_cast<std::size_t>(robot.fingers[i])].joint;
    if (joint.kind != JointKind::slider)
      throw Error(listed.place,
                  "finger '" + listed.items[i].as_text() + "' " +
                      (joint.kind == JointKind::fixed ? "does not move" : "turns") +
                      ": a hand closes two sliding joints",
                  "name two prismatic joints, or put sliding jaws in the place of the turning ones");
  }
}

Robot build_robot(const std::string& name, const Value& fields, Body body, const Transform& world_from_base,
                  const Colours& colours) {
  Robot robot;
  robot.name = name;
  robot.body = std::move(body);
  robot.body.name = name;
  robot.body.free = false;
  robot.body.world_from_body = world_from_base;
  robot.fingers = parts_named(robot.body, fields["fingers"]);
  check_sizes(robot.body, fields["urdf"].present() ? fields["urdf"] : fields);
  robot.arm = arm_parts(fields, robot);
  read_limits(fields, robot);
  read_hand(fields, robot);
  read_pairs(fields, robot);
  for (const int finger : robot.fingers) {  // an episode starts with the hand open
    Joint& joint = robot.body.parts[static_cast<std::size_t>(finger)].joint;
    joint.initial = std::min(joint.upper, robot.opening_max / static_cast<double>(robot.fingers.size()));
  }
  for (const auto& [link, colour] : fields["colours"].fields) {
    const int part = part_index_of(robot.body, link, colour);
    for (Shape& shape : robot.body.parts[static_cast<std::size_t>(part)].shapes) {
      shape.colour = colour_from(colour, colours);
    }
  }
  return robot;
}

void set_start(const Value& joints, Robot& robot) {
  for (const auto& [name, value] : joints.fields) {
    const int part = part_index_of(robot.body, name, value);
    const auto found = std::find(robot.arm.begin(), robot.arm.end(), part);
    if (found == robot.arm.end()) throw Error(value.place, "'" + name + "' is no joint of the arm");
    const JointLimits& limits = robot.limits[static_cast<std::size_t>(found - robot.arm.begin())];
    Joint& joint = robot.body.parts[static_cast<std::size_t>(part)].joint;
    joint.initial = value.as_number();
    if (joint.initial < limits.lower || joint.initial > limits.upper) value.expected("a position within its limits");
  }
}

}  // namespace stampede
