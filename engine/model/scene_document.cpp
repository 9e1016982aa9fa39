// The canonical document of a scene. One list of fields serves writing and reading, so they cannot drift apart.
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/base64.h"
#include "engine/base/error.h"
#include "engine/base/read_json.h"
#include "engine/model/scene.h"

namespace stampede {
namespace {

using Json = nlohmann::json;  // keys sorted; doubles written so that they read back to the last bit

constexpr int kFormat = 2;
constexpr std::array kShapeNames{"box", "sphere", "cylinder", "capsule", "cone", "hull", "mesh"};
constexpr std::array kTextureNames{"image", "checker", "stripes", "noise"};
constexpr std::array kJointNames{"fixed", "hinge", "slider", "screw"};
constexpr std::array kObjectNames{"body", "part", "region", "hand"};

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error("scene document" + (path.empty() ? "" : " at " + path), what,
              "the document is damaged: generate it again");
}

template <typename Archive>
void fields(Archive& a, Colour& c) {
  a("red", c.red), a("green", c.green), a("blue", c.blue), a("alpha", c.alpha);
}

template <typename Archive>
void fields(Archive& a, Shape& s) {
  a.choice("kind", s.kind, kShapeNames), a("size", s.size), a("radius", s.radius), a("length", s.length);
  a("points", s.points), a("mesh", s.mesh), a("part_from_shape", s.part_from_shape), a("colour", s.colour);
  a("texture", s.texture), a("collides", s.collides), a("visible", s.visible);
  a.optional("shown_by", s.shown_by, std::vector<std::string>()), a.optional("shown_without", s.shown_without, false);
}

template <typename Archive>
void fields(Archive& a, Surface& s) {
  a("friction", s.friction), a("rolling", s.rolling), a("spinning", s.spinning);
  a("restitution", s.restitution), a("anchor", s.anchor);
}

template <typename Archive>
void fields(Archive& a, Joint& j) {
  a("name", j.name), a.choice("kind", j.kind, kJointNames), a("axis", j.axis);
  a("parent_from_joint", j.parent_from_joint), a("lower", j.lower), a("upper", j.upper), a("initial", j.initial);
  a("damping", j.damping), a("friction", j.friction), a("effort", j.effort), a("velocity", j.velocity);
  a("spring_force", j.spring_force), a("spring_target", j.spring_target), a("detent", j.detent);
  a("latch_key", j.latch_key), a("latch_open", j.latch_open), a("latch_close", j.latch_close);
  a.optional("stiffness", j.stiffness, 0.0), a.optional("follows", j.follows, std::string());
  a.optional("follow_ratio", j.follow_ratio, 1.0), a.optional("follow_offset", j.follow_offset, 0.0);
  a.optional("pitch", j.pitch, 0.0), a.optional("lets_go", j.lets_go, std::numeric_limits<double>::infinity());
}

template <typename Archive>
void fields(Archive& a, Part& p) {
  a("name", p.name), a("parent", p.parent), a("joint", p.joint), a("shapes", p.shapes), a("mass", p.mass);
  a("centre_of_mass", p.centre_of_mass), a("inertia", p.inertia), a("surface", p.surface);
  a("instance", p.instance);
}

template <typename Archive>
void fields(Archive& a, Body& b) {
  a("name", b.name), a("free", b.free), a("fixture", b.fixture), a("parts", b.parts);
  a("world_from_body", b.world_from_body);
  a.optional("joined_to", b.joined_to, std::string()), a.optional("joined_part", b.joined_part, 0);
}

template <typename Archive>
void fields(Archive& a, Region& r) {
  a("name", r.name), a("body", r.body), a("part", r.part), a("part_from_region", r.part_from_region);
  a("size", r.size), a("visible", r.visible), a("colour", r.colour), a("instance", r.instance);
}

template <typename Archive>
void fields(Archive& a, Camera& c) {
  a("name", c.name), a("mount_body", c.mount_body), a("mount_part", c.mount_part);
  a("mount_from_camera", c.mount_from_camera), a("width", c.width), a("height", c.height);
  a("focal_x", c.focal_x), a("focal_y", c.focal_y), a("centre_x", c.centre_x), a("centre_y", c.centre_y);
  a("distortion", c.distortion), a("near_m", c.near_m), a("far_m", c.far_m);
}

template <typename Archive>
void fields(Archive& a, Texture& t) {
  a.choice("kind", t.kind, kTextureNames), a("image", t.image), a("first", t.first), a("second", t.second);
  a("size_m", t.size_m), a("seed", t.seed);
}

template <typename Archive>
void fields(Archive& a, Light& l) {
  a("direction", l.direction), a("colour", l.colour), a("ambient", l.ambient), a("diffuse", l.diffuse);
  a("specular", l.specular);
}

template <typename Archive>
void fields(Archive& a, Grasp& g) {
  a("object_from_tip", g.object_from_tip), a("width", g.width), a("approach", g.approach), a("force", g.force);
}

template <typename Archive>
void fields(Archive& a, Object& o) {
  a("name", o.name), a.choice("kind", o.kind, kObjectNames), a("class_name", o.class_name), a("type", o.type);
  a("traits", o.traits), a("attributes", o.attributes), a("body", o.body), a("part", o.part), a("size", o.size);
  a("grasps", o.grasps), a("numbers", o.numbers);
}

template <typename Archive>
void fields(Archive& a, JointLimits& l) {
  a("lower", l.lower), a("upper", l.upper), a("velocity", l.velocity), a("acceleration", l.acceleration);
  a("jerk", l.jerk), a("effort", l.effort);
}

template <typename Archive>
void fields(Archive& a, Robot& r) {
  a("name", r.name), a("body", r.body), a("arm", r.arm), a("limits", r.limits), a("home", r.home);
  a("fingers", r.fingers), a("pads", r.pads), a("tip_part", r.tip_part), a("tip_part_from_tip", r.tip_part_from_tip);
  a("opening_max", r.opening_max), a("grip_force", r.grip_force), a("finger_speed", r.finger_speed);
  a("hand", r.hand), a("checked_pairs", r.checked_pairs);
}

template <typename Archive>
void fields(Archive& a, Sensor& s) {
  a("name", s.name), a("kind", s.kind), a("part", s.part), a("rate_hz", s.rate_hz);
}

template <typename Archive>
void fields(Archive& a, Scene& s) {
  a("world", s.world), a("robot", s.robot), a("bodies", s.bodies), a("regions", s.regions), a("cameras", s.cameras);
  a("sensors", s.sensors), a("light", s.light), a("meshes", s.meshes), a("textures", s.textures),
      a("classes", s.classes);
  a("objects", s.objects), a("gravity", s.gravity), a("physics_hz", s.physics_hz), a("frame_hz", s.frame_hz);
}

class Writer {
 public:
  explicit Writer(std::string path = {}) : path_(std::move(path)) {}
  template <typename Value>
  void operator()(const char* key, Value& value) {
    json_[key] = write(value, path_ + "." + key);
  }
  // Left out where it is as it was before there was such a field: documents of earlier releases lack it.
  template <typename Value>
  void optional(const char* key, Value& value, const Value& before) {
    if (value != before) (*this)(key, value);
  }
  template <typename Choice, std::size_t N>
  void choice(const char* key, Choice& value, const std::array<const char*, N>& names) {
    json_[key] = names.at(static_cast<std::size_t>(value));
  }
  Json take() { return std::move(json_); }

 private:
  static Json write(bool value, const std::string&) { return value; }
  static Json write(int value, const std::string&) { return value; }
  static Json write(const std::string& value, const std::string&) { return value; }
  static Json write(double value, const std::string& path) {
    if (!std::isfinite(value))
      throw Error("scene" + path, "a number of the scene is not finite", "check the sizes, masses and limits");
    return value;
  }
  static Json write(const std::pair<int, int>& value, const std::string&) { return {value.first, value.second}; }
  static Json write(const Vector3& value, const std::string& path) {
    return {write(value.x(), path), write(value.y(), path), write(value.z(), path)};
  }
  static Json write(const Matrix3& value, const std::string& path) {
    Json list = Json::array();  // row by row
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) list.push_back(write(value(row, column), path));
    return list;
  }
  // Rotations as matrices: a quaternion would round them.
  static Json write(const Transform& value, const std::string& path) {
    return {{"origin", write(Vector3(value.translation()), path)}, {"rotation", write(Matrix3(value.linear()), path)}};
  }
  static Json write(std::array<double, 5>& list, const std::string& path) {
    Json json = Json::array();
    for (const double value : list) json.push_back(write(value, path));
    return json;
  }
  // Large and shared by many scenes: a catalogue keeps what stands under `drawn` once.
  static Json write(std::shared_ptr<const DrawnMesh>& mesh, const std::string&) {
    return {{"drawn", {{"base64", to_base64(to_bytes(*mesh))}}}};
  }
  static Json write(std::shared_ptr<const Image>& image, const std::string&) {
    if (!image) return nullptr;
    const std::string_view bytes(reinterpret_cast<const char*>(image->rgba.data()), image->rgba.size());
    return {{"width", image->width}, {"height", image->height}, {"drawn", {{"base64", to_base64(bytes)}}}};
  }
  template <typename Item>
  static Json write(std::vector<Item>& list, const std::string& path) {
    Json json = Json::array();
    for (std::size_t i = 0; i < list.size(); ++i) json.push_back(write(list[i], path + "[" + std::to_string(i) + "]"));
    return json;
  }
  template <typename Item>
  static Json write(std::map<std::string, Item>& map, const std::string& path) {
    Json json = Json::object();
    for (auto& [key, item] : map) json[key] = write(item, path + "." + key);
    return json;
  }
  template <typename Struct>
  requires requires(Writer& archive, Struct& item) { fields(archive, item); }
  static Json write(Struct& value, const std::string& path) {
    Writer writer(path);
    fields(writer, value);
    return writer.take();
  }

  std::string path_;
  Json json_ = Json::object();
};

class Reader {
 public:
  Reader(const Json& json, std::string path) : json_(json), path_(std::move(path)) {
    if (!json_.is_object()) fail(path_, "an object is expected");
  }
  template <typename Value>
  void operator()(const char* key, Value& value) {
    read(at(key), value, path_ + "." + key);
  }
  template <typename Value>
  void optional(const char* key, Value& value, const Value& before) {
    value = before;
    if (json_.contains(key)) (*this)(key, value);
  }
  template <typename Choice, std::size_t N>
  void choice(const char* key, Choice& value, const std::array<const char*, N>& names) {
    const Json& json = at(key);
    for (std::size_t i = 0; i < N; ++i) {
      if (json != names.at(i)) continue;
      value = static_cast<Choice>(i);
      return;
    }
    fail(path_ + "." + key, "no known kind");
  }
  void finish() const {
    if (json_.size() != known_) fail(path_, "there are fields that this version does not know");
  }

 private:
  const Json& at(const char* key) {
    const auto found = json_.find(key);
    if (found == json_.end()) fail(path_, std::string("the field '") + key + "' is missing");
    ++known_;
    return *found;
  }
  static void read(const Json& json, bool& value, const std::string& path) {
    if (!json.is_boolean()) fail(path, "true or false is expected");
    value = json.get<bool>();
  }
  static void read(const Json& json, int& value, const std::string& path) {
    if (!json.is_number_integer()) fail(path, "a whole number is expected");
    const auto wide = json.get<std::int64_t>();
    value = static_cast<int>(wide);
    if (value != wide) fail(path, "the number is too large");
  }
  static void read(const Json& json, double& value, const std::string& path) {
    if (!json.is_number()) fail(path, "a number is expected");
    value = json.get<double>();
  }
  static void read(const Json& json, std::string& value, const std::string& path) {
    if (!json.is_string()) fail(path, "a text is expected");
    value = json.get<std::string>();
  }
  static const Json& list(const Json& json, std::size_t size, const std::string& path) {
    if (!json.is_array() || json.size() != size) fail(path, "a list of " + std::to_string(size) + " is expected");
    return json;
  }
  static void read(const Json& json, std::pair<int, int>& value, const std::string& path) {
    list(json, 2, path);
    read(json[0], value.first, path);
    read(json[1], value.second, path);
  }
  static void read(const Json& json, Vector3& value, const std::string& path) {
    list(json, 3, path);
    for (int i = 0; i < 3; ++i) read(json[static_cast<std::size_t>(i)], value[i], path);
  }
  static void read(const Json& json, Matrix3& value, const std::string& path) {
    list(json, 9, path);
    for (int i = 0; i < 9; ++i) read(json[static_cast<std::size_t>(i)], value(i / 3, i % 3), path);
  }
  static void read(const Json& json, Transform& value, const std::string& path) {
    Reader reader(json, path);
    Vector3 origin;
    Matrix3 rotation;
    reader("origin", origin), reader("rotation", rotation);
    reader.finish();
    value = Transform::Identity();
    value.translation() = origin;
    value.linear() = rotation;
  }
  static void read(const Json& json, std::array<double, 5>& value, const std::string& path) {
    list(json, 5, path);
    for (std::size_t i = 0; i < 5; ++i) read(json[i], value[i], path);
  }
  static std::string drawn(const Json& json, const std::string& path) {
    if (!json.is_object() || !json.contains("drawn") || !json["drawn"].is_object() || !json["drawn"].contains("base64"))
      fail(path, "{ drawn = { base64 } } is expected");
    std::string text;
    read(json["drawn"]["base64"], text, path);
    return from_base64(text);
  }
  static void read(const Json& json, std::shared_ptr<const DrawnMesh>& value, const std::string& path) {
    value = std::make_shared<const DrawnMesh>(mesh_from_bytes(drawn(json, path)));
  }
  static void read(const Json& json, std::shared_ptr<const Image>& value, const std::string& path) {
    value.reset();
    if (json.is_null()) return;
    const std::string bytes = drawn(json, path);
    Image image;
    if (json.size() != 3 || !json.contains("width") || !json.contains("height")) fail(path, "an image is expected");
    read(json["width"], image.width, path), read(json["height"], image.height, path);
    image.rgba.assign(bytes.begin(), bytes.end());
    if (image.width < 1 || image.height < 1 ||
        static_cast<std::int64_t>(image.rgba.size()) != std::int64_t{4} * image.width * image.height)
      fail(path, "the size of an image does not agree with its pixels");
    value = std::make_shared<const Image>(std::move(image));
  }
  template <typename Item>
  static void read(const Json& json, std::vector<Item>& value, const std::string& path) {
    if (!json.is_array()) fail(path, "a list is expected");
    value.resize(json.size());
    for (std::size_t i = 0; i < value.size(); ++i) read(json[i], value[i], path + "[" + std::to_string(i) + "]");
  }
  template <typename Item>
  static void read(const Json& json, std::map<std::string, Item>& value, const std::string& path) {
    if (!json.is_object()) fail(path, "an object is expected");
    value.clear();
    for (const auto& [key, item] : json.items()) read(item, value[key], path + "." + key);
  }
  template <typename Struct>
  requires requires(Reader& archive, Struct& item) { fields(archive, item); }
  static void read(const Json& json, Struct& value, const std::string& path) {
    Reader reader(json, path);
    fields(reader, value);
    reader.finish();
  }

  const Json& json_;
  std::string path_;
  std::size_t known_ = 0;
};

void check_index(int index, std::size_t size, const std::string& path) {
  if (index < 0 || static_cast<std::size_t>(index) >= size) fail(path, "it names a part that is not there");
}

void check_shape(const Scene& scene, const Shape& shape, const std::string& path) {
  if (shape.kind == ShapeKind::mesh && (shape.collides || !scene.meshes.contains(shape.mesh)))
    fail(path, "a mesh is drawn only and must be among the scene's meshes");
  if (!shape.texture.empty() && !scene.textures.contains(shape.texture))
    fail(path, "there is no texture '" + shape.texture + "'");
}

void check_body(const Scene& scene, const Body& body, const std::string& path) {
  if (body.parts.empty()) fail(path, "a body needs a part");
  for (const Part& part : body.parts)
    for (const Shape& shape : part.shapes) check_shape(scene, shape, path);
  for (std::size_t i = 0; i < body.parts.size(); ++i)
    if (body.parts[i].parent < (i == 0 ? -1 : 0) || body.parts[i].parent >= static_cast<int>(i))
      fail(path, "a part's parent must come before it");
}

// What users of a scene index without asking.
void check(const Scene& scene) {
  for (const Body& body : scene.bodies) check_body(scene, body, "body " + body.name);
  for (const auto& [name, texture] : scene.textures)
    if (texture.kind == TextureKind::image && !texture.image) fail("texture " + name, "it has no image");
  for (const Camera& camera : scene.cameras)
    if (camera.width < 1 || camera.height < 1 || !(camera.focal_x > 0) || !(camera.focal_y > 0))
      fail("camera " + camera.name, "size and focal lengths must be above 0");
  const Robot& robot = scene.robot;
  const std::size_t parts = robot.body.parts.size();
  if (parts == 0 && robot.arm.empty()) return;  // a scene without a robot
  check_body(scene, robot.body, "the robot");
  for (const std::vector<int>* list : {&robot.arm, &robot.fingers, &robot.pads})
    for (const int part : *list) check_index(part, parts, "the robot");
  for (const auto& [a, b] : robot.checked_pairs)
    check_index(a, parts, "checked_pairs"), check_index(b, parts, "checked_pairs");
  check_index(robot.tip_part, parts, "the robot's tip");
  for (const Sensor& sensor : scene.sensors) check_index(sensor.part, parts, "sensor " + sensor.name);
  if (robot.limits.size() != robot.arm.size() || robot.home.size() != robot.arm.size())
    fail("the robot", "limits and home need one entry for each arm part");
}

}  // namespace

std::string scene_to_document(const Scene& scene) {
  Writer writer;
  Scene copy = scene;  // the shared list of fields takes values that could change
  int format = kFormat;
  writer("format", format);
  fields(writer, copy);
  try {
    return writer.take().dump();
  } catch (const Json::exception& error) {
    throw Error("scene", std::string("a text of the scene is not UTF-8: ") + error.what(), "use UTF-8 in names");
  }
}

Scene scene_from_document(std::string_view document) {
  JsonLimits limits;
  limits.depth = 16;  // a scene needs eight
  const Json json = json_from_text(document, "scene document", "the document is damaged: generate it again", limits);
  Scene scene;
  Reader reader(json, "");
  int format = 0;
  reader("format", format);
  if (format != kFormat) fail("format", "format " + std::to_string(format) + " is not known to this version");
  fields(reader, scene);
  reader.finish();
  check(scene);
  return scene;
}

}  // namespace stampede
