// Worlds: rates, cameras, sensors, light, randomisation.
#include <algorithm>
#include <numbers>

#include "engine/motion/planner.h"
#include "engine/record/observation.h"
#include "engine/record/record.h"
#include "scripting/library/checks.h"
#include "scripting/library/rates.h"
#include "scripting/library/scene_outline.h"

namespace stampede {
namespace {

int rate_or(const Value& node, int otherwise) { return node.is_number() ? static_cast<int>(node.number) : otherwise; }

bool lists_numbers(const Value& list) {
  return list.is_table() &&
         std::all_of(list.items.begin(), list.items.end(), [](const Value& item) { return item.is_number(); });
}

void check_rates(const Definition& definition) {
  const int physics = rate_or(definition.node["physics_hz"], 240), frames = rate_or(definition.node["frame_hz"], 20);
  if (physics > kFastestPhysics) {
    return definition.complain(
        "physics_hz",
        std::to_string(physics) + " Hz is beyond what is simulated, " + std::to_string(kFastestPhysics) + " Hz at most",
        "240 Hz serve most scenes");
  }
  if (physics > 0 && frames > 0 && physics % frames == 0) return;
  definition.complain("frame_hz", std::to_string(frames) + " Hz does not divide " + std::to_string(physics) + " Hz",
                      divisors_of(physics));
}

void check_motion(const Definition& definition) {
  const Value& planner = definition.node["motion"]["planner"];
  if (planner.is_text()) try {
      check_motion_planner(planner.text, "motion.planner");
    } catch (const Error& error) {
      definition.complain("motion.planner", error.message(), error.hint());
    }
}

void check_sensors(const Definition& definition) {
  const int physics = rate_or(definition.node["physics_hz"], 240);
  for (const auto& [name, sensor] : definition.node["sensors"].fields) {
    const std::string path = "sensors." + name;
    if (name == kMargins) definition.complain(path, "the signed margins of facts are called so", "another name");
    if (sensor.items.size() != 1 || !sensor.items[0].is_text()) {
      definition.complain(path, "a sensor begins with its kind",
                          "such as { \"force_torque\", on = \"robot.hand\", rate = 120 }");
      continue;
    }
    definition.require_known(path, "sensor of kind", sensor.items[0], {"force_torque", "joint_torque"});
    if (sensor.items[0].text == "joint_torque" && sensor["on"].present())
      definition.complain(path + ".on", "joint_torque is of all joints of the arm", "leave `on` out");
    const int rate = rate_or(sensor["rate"], 120);
    if (rate <= 0 || physics <= 0 || physics % rate != 0)
      definition.complain(path + ".rate",
                          std::to_string(rate) + " Hz does not divide " + std::to_string(physics) + " Hz",
                          divisors_of(physics));
  }
}

void check_mount(const Definition& definition, const Value& camera, const std::string& path,
                 const SceneOutline& scene) {
  const std::vector<std::string> known = keys_of(scene.things);
  definition.require_known(path + ".look_at", "object", camera["look_at"], known);
  const Value& mount = camera["mount"];
  if (!mount.is_text()) return;
  std::vector<std::string> mounts = known;
  mounts.emplace_back("robot.hand");
  const std::string robot = scene.hand.substr(0, scene.hand.rfind('.'));
  if (!mount.text.starts_with("robot.") && !mount.text.starts_with(robot + "."))  // links: known when its URDF is read
    definition.require_known(path + ".mount", "object or link", mount, mounts);
  if (camera["look_at"].is_text())
    definition.complain(path + ".look_at", "a camera that moves looks at a point of its mount's frame",
                        "look_at = { x, y, z }, or rpy");
}

void check_lens(const Definition& definition, const Value& camera, const std::string& path) {
  const Value &fov = camera["fov"], &focal = camera["focal"], &centre = camera["centre"];
  if (fov.is_number() && !(fov.number > 0 && fov.number < std::numbers::pi))
    definition.complain(path + ".fov", "a field of view lies between 0 and pi rad", "fov = deg(40)");
  if (fov.present() && focal.present())
    definition.complain(path + ".focal", "focal says the field of view, and fov says another", "leave one of them out");
  const auto above_zero = [](const Value& item) { return item.number > 0; };
  if (lists_numbers(focal) &&
      (focal.items.size() != 2 || !std::all_of(focal.items.begin(), focal.items.end(), above_zero)))
    definition.complain(path + ".focal", "expects two numbers above 0", "focal = { 600, 600 }");
  if (lists_numbers(centre) && centre.items.size() != 2)
    definition.complain(path + ".centre", "expects two numbers", "centre = { 320, 240 }");
  if (centre.present() && !focal.present())
    definition.complain(path + ".centre", "a centre belongs to focal lengths", "focal = { 600, 600 }");
  const Value& distortion = camera["distortion"];
  if (distortion.is_table() && distortion.items.size() != 5)
    definition.complain(path + ".distortion", "expects five numbers", "distortion = { k1, k2, p1, p2, k3 }");
}

void check_camera(const Definition& definition, const Value& camera, const std::string& path,
                  const SceneOutline& scene) {
  check_mount(definition, camera, path, scene);
  check_size(definition, camera["size"], path + ".size");
  check_lens(definition, camera, path);
  const double near_m = camera["near"].is_number() ? camera["near"].number : 0.01;
  const double far_m = camera["far"].is_number() ? camera["far"].number : 4.5;
  if (!(near_m > 0 && near_m < far_m))
    definition.complain(path + (camera["near"].present() ? ".near" : ".far"), "near must be above 0 and far beyond it",
                        "near = 0.01, far = 4.5");
}

void check_light(const Definition& definition) {
  const Value& light = definition.node["light"];
  for (const char* share : {"ambient", "diffuse", "specular"}) {
    if (light[share].is_number() && light[share].number < 0)
      definition.complain(std::string("light.") + share, "a share of brightness is not negative", "0 … 1");
  }
  const Value& direction = light["direction"];
  if (lists_numbers(direction) &&
      std::all_of(direction.items.begin(), direction.items.end(), [](const Value& item) { return item.number == 0; }))
    definition.complain("light.direction", "has no length", "direction = { 0, 0, -1 } shines straight down");
}

void check_randomise(const LibraryDraft& draft, const Definition& definition, const SceneOutline& scene) {
  const Value& node = definition.node["randomise"];
  std::vector<std::string> things = keys_of(scene.things);
  for (const ScriptFile* file : draft.library()->files(DefinitionKind::object)) things.push_back(file->name);
  things.insert(things.end(), {"robot", "*"});
  for (const char* field : {"looks", "dynamics"}) {
    for (const Value& item : node[field].items)
      definition.require_known(std::string("randomise.") + field, "object", item, things);
  }
  for (const Value& item : node["textures"].items)
    definition.require_known("randomise.textures", "kind of texture", item, {"checker", "stripes", "noise", "plain"});
  if (const Definition* colours = draft.find(DefinitionKind::colours, "colours"))
    for (const Value& item : node["colours"].items)
      definition.require_known("randomise.colours", "colour", item, keys_of(colours->node.fields));
  for (const char* field : {"ambient", "diffuse", "mass", "friction", "damping"}) {
    const Value& range = node[field];
    if (!lists_numbers(range) || range.items.size() != 2) continue;
    const bool factor = std::string_view(field) == "mass";
    if (range.items[0].number > range.items[1].number)
      definition.complain(std::string("randomise.") + field, "its lower end lies above its upper", "swap them");
    else if (range.items[0].number < 0 || (factor && range.items[0].number == 0))
      definition.complain(std::string("randomise.") + field, factor ? "must be above 0" : "is negative");
  }
  for (const char* field : {"light_direction", "camera_position", "camera_rotation"}) {
    if (node[field].is_number() && node[field].number < 0)
      definition.complain(std::string("randomise.") + field, "is negative", "it is the greatest amount either way");
  }
}

void check_world(LibraryDraft& draft, const Definition& definition) {
  const Value& node = definition.node;
  if (node["robot"].is_table()) check_entry(draft, definition, node["robot"], "robot", DefinitionKind::robot);
  for (const auto& [fixture, entry] : node["fixtures"].fields) {
    const std::string path = "fixtures." + fixture;
    check_entry(draft, definition, entry, path, DefinitionKind::object);
    check_name(fixture, path, definition.complainer());
  }
  check_rates(definition);
  check_sensors(definition);
  const SceneOutline scene = outline_of(definition.file->name, draft);
  for (const auto& [camera, entry] : node["cameras"].fields)
    check_camera(definition, entry, "cameras." + camera, scene);
  check_light(definition);
  check_randomise(draft, definition, scene);
  check_observe(definition, node);
  check_motion(definition);
}

}  // namespace

void check_worlds(LibraryDraft& draft) {
  for (const auto& [name, definition] : draft.of(DefinitionKind::world)) check_world(draft, definition);
}

}  // namespace stampede
