// Worlds: rates, cameras, sensors, light, randomisation, and what is observed.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/motion/planner.h"
#include "engine/record/observation.h"
#include "engine/render/picture.h"
#include "scripting/library/builder.h"
#include "scripting/library/naming.h"
#include "scripting/library/rates.h"

namespace stampede {
namespace {

constexpr int kMostPixels = 4096;

int rate_or(const Value& node, int otherwise) { return node.is_number() ? static_cast<int>(node.number) : otherwise; }

template <typename Named>
std::vector<std::string> names_of(const Named& named) {
  std::vector<std::string> names;
  for (const auto& [name, unused] : named) names.push_back(name);
  return names;
}

bool all_numbers(const Value& list) {
  return list.is_table() &&
         std::all_of(list.items.begin(), list.items.end(), [](const Value& item) { return item.is_number(); });
}

bool size_fits(const Value& size) {
  return std::all_of(size.items.begin(), size.items.end(), [](const Value& side) {
    return !side.is_number() ||
           (side.number >= 1 && side.number <= kMostPixels && side.number == std::floor(side.number));
  });
}

bool on_robot(const std::string& name, const std::string& robot) {
  return name.starts_with("robot.") || name.starts_with(robot + ".");
}

}  // namespace

void LibraryBuilder::check_one_of(const Definition& definition, const std::string& path, const Value& text,
                                  const char* what, const std::vector<std::string>& known) {
  if (!text.is_text() || std::find(known.begin(), known.end(), text.text) != known.end()) return;
  complain(definition, path, std::string("there is no ") + what + " '" + text.text + "'",
           did_you_mean(text.text, known));
}

void LibraryBuilder::check_worlds() {
  for (const auto& [name, definition] : of(DefinitionKind::world)) {
    const Value& node = definition.node;
    if (node["robot"].is_table()) check_entry(definition, node["robot"], "robot", "robot");
    for (const auto& [fixture, entry] : node["fixtures"].fields) {
      check_entry(definition, entry, "fixtures." + fixture, "object");
      if (const auto fault = name_fault(fixture)) {
        complain(definition, "fixtures." + fixture, "the name '" + fixture + "' " + *fault,
                 "such as '" + proposed_name(fixture) + "'");
      }
    }
    check_rates(definition);
    check_sensors(definition);
    const SceneObjects objects = world_objects(name);
    for (const auto& [camera, entry] : node["cameras"].fields)
      check_camera(definition, entry, "cameras." + camera, objects);
    check_light(definition);
    check_randomise(definition, objects);
    check_observe(definition, node);
    check_motion(definition);
  }
}

void LibraryBuilder::check_rates(const Definition& definition) {
  const int physics = rate_or(definition.node["physics_hz"], 240), frames = rate_or(definition.node["frame_hz"], 20);
  if (physics > kFastestPhysics) {
    return complain(
        definition, "physics_hz",
        std::to_string(physics) + " Hz is beyond what is simulated, " + std::to_string(kFastestPhysics) + " Hz at most",
        "240 Hz serve most scenes");
  }
  if (physics > 0 && frames > 0 && physics % frames == 0) return;
  complain(definition, "frame_hz", std::to_string(frames) + " Hz does not divide " + std::to_string(physics) + " Hz",
           divisors_of(physics));
}

void LibraryBuilder::check_motion(const Definition& definition) {
  const Value& planner = definition.node["motion"]["planner"];
  if (planner.is_text()) try {
      check_motion_planner(planner.text, "motion.planner");
    } catch (const Error& error) {
      complain(definition, "motion.planner", error.message(), error.hint());
    }
}

void LibraryBuilder::check_sensors(const Definition& definition) {
  const int physics = rate_or(definition.node["physics_hz"], 240);
  for (const auto& [name, sensor] : definition.node["sensors"].fields) {
    const std::string path = "sensors." + name;
    if (name == kMargins) complain(definition, path, "the signed margins of facts are called so", "another name");
    if (sensor.items.size() != 1 || !sensor.items[0].is_text()) {
      complain(definition, path, "a sensor begins with its kind",
               "such as { \"force_torque\", on = \"robot.hand\", rate = 120 }");
      continue;
    }
    check_one_of(definition, path, sensor.items[0], "sensor of kind", {"force_torque", "joint_torque"});
    if (sensor.items[0].text == "joint_torque" && sensor["on"].present())
      complain(definition, path + ".on", "joint_torque is of all joints of the arm", "leave `on` out");
    const int rate = rate_or(sensor["rate"], 120);
    if (rate <= 0 || physics <= 0 || physics % rate != 0)
      complain(definition, path + ".rate",
               std::to_string(rate) + " Hz does not divide " + std::to_string(physics) + " Hz", divisors_of(physics));
  }
}

void LibraryBuilder::check_camera(const Definition& definition, const Value& camera, const std::string& path,
                                  const SceneObjects& objects) {
  const std::vector<std::string> known = names_of(objects);
  const std::string hand = hand_of(definition.file->name), robot = hand.substr(0, hand.rfind('.'));
  check_one_of(definition, path + ".look_at", camera["look_at"], "object", known);
  if (camera["mount"].is_text()) {
    std::vector<std::string> mounts = known;
    mounts.emplace_back("robot.hand");
    if (!on_robot(camera["mount"].text, robot))  // its links: known when its URDF is read
      check_one_of(definition, path + ".mount", camera["mount"], "object or link", mounts);
    if (camera["look_at"].is_text())
      complain(definition, path + ".look_at", "a camera that moves looks at a point of its mount's frame",
               "look_at = { x, y, z }, or rpy");
  }
  if (!size_fits(camera["size"]))
    complain(definition, path + ".size", "a picture has 1 to 4096 whole pixels a side", "size = { 128, 128 }");
  const Value& fov = camera["fov"];
  if (fov.is_number() && !(fov.number > 0 && fov.number < std::numbers::pi))
    complain(definition, path + ".fov", "a field of view lies between 0 and pi rad", "fov = deg(40)");
  if (fov.present() && camera["focal"].present())
    complain(definition, path + ".focal", "focal says the field of view, and fov says another",
             "leave one of them out");
  const auto pair = [&](const char* field, bool positive, const char* example) {
    const Value& list = camera[field];
    if (!all_numbers(list)) return;
    const bool sound = list.items.size() == 2 && (!positive || (list.items[0].number > 0 && list.items[1].number > 0));
    if (!sound)
      complain(definition, path + "." + field, positive ? "expects two numbers above 0" : "expects two numbers",
               example);
  };
  pair("focal", true, "focal = { 600, 600 }");
  pair("centre", false, "centre = { 320, 240 }");
  if (camera["centre"].present() && !camera["focal"].present())
    complain(definition, path + ".centre", "a centre belongs to focal lengths", "focal = { 600, 600 }");
  if (camera["distortion"].is_table() && camera["distortion"].items.size() != 5)
    complain(definition, path + ".distortion", "expects five numbers", "distortion = { k1, k2, p1, p2, k3 }");
  const double near_m = camera["near"].is_number() ? camera["near"].number : 0.01;
  const double far_m = camera["far"].is_number() ? camera["far"].number : 4.5;
  if (!(near_m > 0 && near_m < far_m))
    complain(definition, path + (camera["near"].present() ? ".near" : ".far"), "near must be above 0 and far beyond it",
             "near = 0.01, far = 4.5");
}

void LibraryBuilder::check_light(const Definition& definition) {
  const Value& light = definition.node["light"];
  for (const char* share : {"ambient", "diffuse", "specular"}) {
    if (light[share].is_number() && light[share].number < 0)
      complain(definition, std::string("light.") + share, "a share of brightness is not negative", "0 … 1");
  }
  const Value& direction = light["direction"];
  if (all_numbers(direction) &&
      std::all_of(direction.items.begin(), direction.items.end(), [](const Value& item) { return item.number == 0; }))
    complain(definition, "light.direction", "has no length", "direction = { 0, 0, -1 } shines straight down");
}

void LibraryBuilder::check_randomise(const Definition& definition, const SceneObjects& objects) {
  const Value& node = definition.node["randomise"];
  std::vector<std::string> things = names_of(objects);
  for (const ScriptFile* file : library_->files(DefinitionKind::object)) things.push_back(file->name);
  things.insert(things.end(), {"robot", "*"});
  for (const char* field : {"looks", "dynamics"}) {
    for (const Value& item : node[field].items)
      check_one_of(definition, std::string("randomise.") + field, item, "object", things);
  }
  for (const Value& item : node["textures"].items)
    check_one_of(definition, "randomise.textures", item, "kind of texture", {"checker", "stripes", "noise", "plain"});
  const auto colours = of(DefinitionKind::colours).find("colours");
  if (colours != of(DefinitionKind::colours).end()) {
    for (const Value& item : node["colours"].items)
      check_one_of(definition, "randomise.colours", item, "colour", names_of(colours->second.node.fields));
  }
  for (const char* field : {"ambient", "diffuse", "mass", "friction", "damping"}) {
    const Value& range = node[field];
    if (!all_numbers(range) || range.items.size() != 2) continue;
    const bool factor = std::string_view(field) == "mass";
    if (range.items[0].number > range.items[1].number)
      complain(definition, std::string("randomise.") + field, "its lower end lies above its upper", "swap them");
    else if (range.items[0].number < 0 || (factor && range.items[0].number == 0))
      complain(definition, std::string("randomise.") + field, factor ? "must be above 0" : "is negative");
  }
  for (const char* field : {"light_direction", "camera_position", "camera_rotation"}) {
    if (node[field].is_number() && node[field].number < 0)
      complain(definition, std::string("randomise.") + field, "is negative", "it is the greatest amount either way");
  }
}

// Of a world, or of a task in that world.
void LibraryBuilder::check_observe(const Definition& definition, const Value& world) {
  const Value& node = definition.node["observe"];
  if (node["images"].is_text() && !which_frames_from(node["images"].text))
    check_one_of(definition, "observe.images", node["images"], "choice of frames", {"none", "keyframes", "all"});
  std::vector<std::string> kinds;
  for (const PictureKind kind : kPictureKinds) kinds.emplace_back(to_string(kind));
  for (const Value& kind : node["kinds"].items) {
    if (kind.is_text() && kind.text == "points")
      complain(definition, "observe.kinds", "point clouds are asked for by themselves", "points = true");
    else
      check_one_of(definition, "observe.kinds", kind, "kind of picture", kinds);
  }
  if (!size_fits(node["size"]))
    complain(definition, "observe.size", "a picture has 1 to 4096 whole pixels a side", "size = { 128, 128 }");
  if (!world["calibration"].present()) {  // which may bring cameras of its own
    for (const Value& camera : node["cameras"].items)
      check_one_of(definition, "observe.cameras", camera, "camera", names_of(world["cameras"].fields));
  }
  std::vector<std::string> channels = names_of(world["sensors"].fields);
  channels.emplace_back(kMargins);
  for (const Value& channel : node["channels"].items) {
    if (channel.text != "*") check_one_of(definition, "observe.channels", channel, "sensor", channels);
  }
  for (const char* noise : {"rgb", "depth", "torque"}) {
    if (node["noise"][noise].is_number() && node["noise"][noise].number < 0)
      complain(definition, std::string("observe.noise.") + noise, "a standard deviation is not negative");
  }
}

}  // namespace stampede
