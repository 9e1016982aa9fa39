#include "scripting/runtime/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "engine/base/nearest.h"
#include "engine/model/camera.h"
#include "engine/model/kinematics.h"
#include "scripting/library/rates.h"
#include "scripting/runtime/evaluate.h"
#include "scripting/runtime/world_reader.h"

namespace stampede {
namespace {

constexpr double kFieldOfView = 40 * std::numbers::pi / 180;  // vertical

template <typename Named>
void sort_by_name(std::vector<Named>& list) {
  std::sort(list.begin(), list.end(), [](const Named& a, const Named& b) { return a.name < b.name; });
}

// Sizes and lens of a camera.
void set_optics(const Value& fields, Camera& camera) {
  camera.near_m = fields.number_or("near", camera.near_m);
  camera.far_m = fields.number_or("far", camera.far_m);
  if (!(camera.near_m > 0 && camera.near_m < camera.far_m))
    throw Error(fields.place, "near must be above 0 and far beyond it", "near = 0.01, far = 4.5");
  std::array<int, 2> size = {128, 128};
  if (fields["size"].present()) size = picture_size_from(fields["size"]);
  const double fov = fields.number_or("fov", kFieldOfView);
  if (!(fov > 0 && fov < std::numbers::pi)) fields["fov"].expected("an angle between 0 and pi rad, such as deg(40)");
  set_field_of_view(camera, fov, size[0], size[1]);
  if (const Value& focal = fields["focal"]; focal.present()) {
    const std::vector<double> lengths = focal.as_numbers();
    if (lengths.size() != 2 || !(lengths[0] > 0) || !(lengths[1] > 0)) focal.expected("two focal lengths above 0");
    if (fields["fov"].present()) throw Error(focal.place, "focal and fov both say the field of view", "leave one out");
    camera.focal_x = lengths[0];
    camera.focal_y = lengths[1];
  }
  if (const Value& centre = fields["centre"]; centre.present()) {
    const std::vector<double> point = centre.as_numbers();
    if (point.size() != 2) centre.expected("two numbers { cx, cy }");
    camera.centre_x = point[0];
    camera.centre_y = point[1];
  }
  if (const Value& distortion = fields["distortion"]; distortion.present()) {
    const std::vector<double> terms = distortion.as_numbers();
    if (terms.size() != camera.distortion.size()) distortion.expected("five numbers { k1, k2, p1, p2, k3 }");
    std::copy(terms.begin(), terms.end(), camera.distortion.begin());
  }
}

}  // namespace

void SceneBuilder::set_robot(Robot robot) {
  Object hand;
  hand.name = robot.name + "." + robot.hand;
  hand.kind = ObjectKind::hand;
  hand.class_name = robot.name;
  hand.type = "hand";
  hand.body = robot.name;
  hand.part = robot.tip_part;
  scene_.objects.push_back(hand);
  scene_.robot = std::move(robot);
}

void SceneBuilder::add(BuiltObject built, std::vector<Body>& bodies) {
  for (Object& object : built.objects) {
    if (scene_.object(object.name) != nullptr) {
      throw Error(object.name, "two things of this scene have this name");
    }
    scene_.objects.push_back(std::move(object));
    sort_by_name(scene_.objects);  // Scene::object() searches a sorted list
  }
  std::move(built.regions.begin(), built.regions.end(), std::back_inserter(scene_.regions));
  if (built.body) bodies.push_back(std::move(*built.body));
  std::move(built.loose.begin(), built.loose.end(), std::back_inserter(bodies));
  if (bodies_.size() + fixtures_.size() > kMostBodies)
    throw Error(bodies.back().name, "a scene of more than " + std::to_string(kMostBodies) + " things",
                "lower the counts: each is simulated, and plans speak of each");
  drawn_.join(built.drawn);
}

void SceneBuilder::add_fixture(const ObjectSource& source) {
  BuiltObject built = build_object(source, colours_);
  if (built.body && built.body->free) built.body->free = false;
  add(std::move(built), fixtures_);
}

std::optional<double> SceneBuilder::top_of(const std::string& fixture) const {
  const auto body =
      std::find_if(fixtures_.begin(), fixtures_.end(), [&](const Body& one) { return one.name == fixture; });
  if (body == fixtures_.end()) return std::nullopt;
  std::optional<double> top;
  std::vector<Transform> world_from_part;
  forward_kinematics(*body, body->world_from_body, std::vector<double>(body->parts.size()), world_from_part);
  for (std::size_t i = 0; i < body->parts.size(); ++i) {
    const auto [lower, upper] = bounding_box(body->parts[i]);
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 point((corner & 1) != 0 ? upper.x() : lower.x(), (corner & 2) != 0 ? upper.y() : lower.y(),
                          (corner & 4) != 0 ? upper.z() : lower.z());
      top = std::max(top.value_or(-1e9), (world_from_part[i] * point).z());
    }
  }
  return top;
}

void SceneBuilder::add_object(const ObjectSource& source) {
  BuiltObject built = build_object(source, colours_);
  if (!built.placed && built.stands_still) {
    throw Error(source.fields.place, "'" + source.name + "' stands still, so the task must say where",
                source.name + " = { \"" + source.class_name + "\", at = { x, y, z } }");
  }
  if (!built.placed) unplaced_.push_back(source.name);
  for (const Object& object : built.objects) types_.insert(object.type);
  add(std::move(built), bodies_);
}

bool SceneBuilder::add_clutter(const ObjectSource& source, const Domain& domain) {
  constexpr double kWidest = 0.11, kHighest = 0.20;  // m
  BuiltObject built = build_object(source, colours_);
  if (!built.body || built.placed || built.stands_still || built.objects.size() != 1) return false;
  const Object& object = built.objects[0];
  const bool plain = object.traits.size() == 2 && std::ranges::count(object.traits, "movable") == 1 &&
                     std::ranges::count(object.traits, "graspable") == 1;
  const bool small = std::max(object.size.x(), object.size.y()) <= kWidest && object.size.z() <= kHighest;
  const bool alike = std::ranges::any_of(
      types_, [&](const std::string& own) { return domain.is_a(object.type, own) || domain.is_a(own, object.type); });
  if (!plain || !small || alike) return false;
  unplaced_.push_back(source.name);
  add(std::move(built), bodies_);
  return true;
}

void SceneBuilder::add_region(const std::string& name, const Value& fields) {
  ObjectSource source{name, "region", Value{}, {}};
  source.fields = fields;
  if (!fields["region"].present()) source.fields.fields["region"] = fields;
  if (!fields["at"].present()) source.fields.expected("at = { x, y, z } for a region of the world");
  add(build_object(source, colours_), fixtures_);
}

Vector3 SceneBuilder::point_of(const Value& value) const {
  if (value.kind != Value::Kind::text) return value.as_vector();
  for (const auto* list : {&fixtures_, &bodies_}) {
    for (const Body& body : *list) {
      if (body.name == value.text) return body.world_from_body.translation();
    }
  }
  const int region = scene_.region_index(value.text);
  if (region < 0 || !scene_.regions[static_cast<std::size_t>(region)].body.empty()) {
    throw Error(value.place, "there is nothing named '" + value.text + "' to look at");
  }
  return scene_.regions[static_cast<std::size_t>(region)].part_from_region.translation();
}

bool SceneBuilder::on_robot(const std::string& name) const {
  return name == "robot" || name == scene_.robot.name || name.starts_with("robot.") ||
         name.starts_with(scene_.robot.name + ".");
}

int SceneBuilder::robot_part(const Value& name) const {
  const Robot& robot = scene_.robot;
  const std::size_t dot = name.as_text().find('.');
  const std::string link = dot == std::string::npos ? "" : name.text.substr(dot + 1);
  if (on_robot(name.text)) {
    if (link.empty()) return 0;
    if (const int part = robot.body.part_index(link); part >= 0) return part;
    if (link == robot.hand) return robot.tip_part;
  }
  std::vector<std::string> known;
  for (const Part& part : robot.body.parts) known.push_back("robot." + part.name);
  if (robot.body.part_index(robot.hand) < 0) known.push_back("robot." + robot.hand);
  throw Error(name.place, "the robot has no link '" + (link.empty() ? name.text : link) + "'",
              did_you_mean("robot." + (link.empty() ? name.text : link), known));
}

Transform SceneBuilder::mount(const Value& name, Camera& camera) const {
  if (on_robot(name.as_text())) {
    camera.mount_body = scene_.robot.name;
    camera.mount_part = robot_part(name);
    return Transform::Identity();
  }
  const Object* object = scene_.object(name.text);
  if (object == nullptr) {
    std::vector<std::string> known = {"robot.hand"};
    for (const Object& one : scene_.objects) known.push_back(one.name);
    throw Error(name.place, "there is nothing named '" + name.text + "' to mount it on",
                did_you_mean(name.text, known));
  }
  camera.mount_body = object->body;
  camera.mount_part = object->part;
  if (object->kind != ObjectKind::region) return Transform::Identity();
  return scene_.regions[static_cast<std::size_t>(scene_.region_index(object->name))].part_from_region;
}

void SceneBuilder::set_pose(const Value& fields, Camera& camera) const {
  const Value &mounted = fields["mount"], &target = fields["look_at"];
  const Transform mount_from_frame = mounted.present() ? mount(mounted, camera) : Transform::Identity();
  if (!target.present()) {
    camera.mount_from_camera = mount_from_frame * transform_from(fields);
    return;
  }
  if (mounted.present() && target.kind == Value::Kind::text)
    throw Error(target.place, "a camera that moves looks at a point of its mount's frame", "look_at = { x, y, z }");
  const Vector3 at = fields["at"].as_vector(), to = point_of(target);
  try {
    camera.mount_from_camera = mount_from_frame * looking_at(at, to, fields.vector_or("up", Vector3::UnitZ()));
  } catch (const Error& error) {
    throw Error(fields.place, error.message(), "let `look_at` differ from `at`");
  }
}

void SceneBuilder::add_camera(const std::string& name, const Value& fields) {
  Camera camera;
  camera.name = name;
  set_pose(fields, camera);
  set_optics(fields, camera);
  scene_.cameras.push_back(camera);
}

void SceneBuilder::add_sensor(const std::string& name, const Value& fields) {
  Sensor sensor;
  sensor.name = name;
  if (fields.items.empty()) fields.expected("a sensor such as { \"force_torque\", on = \"robot.hand\", rate = 120 }");
  sensor.kind = fields.items[0].as_text();
  if (sensor.kind == "force_torque") {
    sensor.part = fields["on"].present() ? robot_part(fields["on"]) : scene_.robot.tip_part;
  } else if (sensor.kind != "joint_torque") {
    throw Error(fields.place, "there is no sensor of kind '" + sensor.kind + "'",
                did_you_mean(sensor.kind, {"force_torque", "joint_torque"}));
  }
  const double rate = fields.number_or("rate", sensor.rate_hz);
  if (!(rate >= 1) || rate != std::floor(rate) || rate > scene_.physics_hz ||
      scene_.physics_hz % static_cast<int>(rate) != 0) {
    throw Error(fields["rate"].present() ? fields["rate"].place : fields.place,
                "its rate does not divide " + std::to_string(scene_.physics_hz) + " Hz",
                divisors_of(scene_.physics_hz));
  }
  sensor.rate_hz = static_cast<int>(rate);
  scene_.sensors.push_back(sensor);
}

void SceneBuilder::set_light(const Value& fields) { scene_.light = light_from(fields, colours_); }

void SceneBuilder::set_classes(std::vector<std::string> classes) {
  std::sort(classes.begin(), classes.end());
  classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
  scene_.classes = std::move(classes);
}

void SceneBuilder::add_class(const std::string& name) {
  const std::vector<std::string>& classes = scene_.classes;
  if (std::find(classes.begin(), classes.end(), name) == classes.end()) scene_.classes.push_back(name);
}

void SceneBuilder::set_rates(int physics_hz, int frame_hz, const Vector3& gravity) {
  if (physics_hz < 1 || frame_hz < 1 || physics_hz % frame_hz != 0) {
    throw Error(scene_.world,
                "frame_hz " + std::to_string(frame_hz) + " does not divide physics_hz " + std::to_string(physics_hz));
  }
  scene_.physics_hz = physics_hz;
  scene_.frame_hz = frame_hz;
  scene_.gravity = gravity;
}

Scene SceneBuilder::build() {
  sort_by_name(fixtures_);
  sort_by_name(bodies_);
  for (Body& body : fixtures_) body.fixture = true;
  scene_.bodies = std::move(fixtures_);
  std::move(bodies_.begin(), bodies_.end(), std::back_inserter(scene_.bodies));
  sort_by_name(scene_.regions);
  sort_by_name(scene_.cameras);
  sort_by_name(scene_.sensors);
  sort_by_name(scene_.objects);
  scene_.meshes = std::move(drawn_.meshes);
  scene_.textures = std::move(drawn_.textures);
  return std::move(scene_);
}

}  // namespace stampede
