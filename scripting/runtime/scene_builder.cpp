#include "scripting/runtime/scene_builder.h"

#include <algorithm>
#include <iterator>
#include <numbers>

#include "engine/model/camera.h"

namespace stampede {
namespace {

constexpr double kFieldOfView = 40 * std::numbers::pi / 180;  // vertical

template <typename Named>
void sort_by_name(std::vector<Named>& list) {
  std::sort(list.begin(), list.end(), [](const Named& a, const Named& b) { return a.name < b.name; });
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
}

void SceneBuilder::add_fixture(const ObjectSource& source) {
  BuiltObject built = build_object(source, colours_);
  if (built.body && built.body->free) built.body->free = false;
  add(std::move(built), fixtures_);
}

void SceneBuilder::add_object(const ObjectSource& source) {
  BuiltObject built = build_object(source, colours_);
  if (!built.placed && built.stands_still) {
    throw Error(source.fields.place, "'" + source.name + "' stands still, so the task must say where",
                source.name + " = { \"" + source.class_name + "\", at = { x, y, z } }");
  }
  if (!built.placed) unplaced_.push_back(source.name);
  add(std::move(built), bodies_);
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

void SceneBuilder::add_camera(const std::string& name, const Value& fields) {
  Camera camera;
  camera.name = name;
  if (const std::string mount = fields.text_or("mount", ""); !mount.empty()) {
    const Object* object = scene_.object(mount == "robot.hand" ? hand() : mount);
    if (object == nullptr) throw Error(fields["mount"].place, "there is nothing named '" + mount + "' to mount it on");
    camera.mount_body = object->body;
    camera.mount_part = object->part;
    camera.mount_from_camera = transform_from(fields);
  } else if (fields["look_at"].present()) {
    try {
      camera.mount_from_camera =
          looking_at(fields["at"].as_vector(), point_of(fields["look_at"]), fields.vector_or("up", Vector3::UnitZ()));
    } catch (const Error& error) {
      throw Error(fields.place, error.message(), "let `look_at` differ from `at`");
    }
  } else {
    camera.mount_from_camera = transform_from(fields);
  }
  camera.near_m = fields.number_or("near", camera.near_m);
  camera.far_m = fields.number_or("far", camera.far_m);
  int width = 128, height = 128;
  if (fields["size"].present()) {
    const std::vector<double> size = fields["size"].as_numbers();
    if (size.size() != 2 || size[0] < 1 || size[1] < 1) fields["size"].expected("{ width, height } in pixels");
    width = static_cast<int>(size[0]);
    height = static_cast<int>(size[1]);
  }
  set_field_of_view(camera, fields.number_or("fov", kFieldOfView), width, height);
  scene_.cameras.push_back(camera);
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
  sort_by_name(scene_.objects);
  return std::move(scene_);
}

}  // namespace stampede
