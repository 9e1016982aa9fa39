#include "engine/model/randomise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/base/error.h"
#include "engine/base/nearest.h"

namespace stampede {
namespace {

constexpr const char* kRobot = "robot";
constexpr const char* kAll = "*";
constexpr const char* kPlain = "plain";
constexpr std::array kProcedural{"checker", "stripes", "noise"};
constexpr Range kRepeat{0.02, 0.2};    // of drawn textures, m
constexpr Range kChannel{0.05, 0.95};  // of colours where none are listed

const Object* whole_object(const Scene& scene, const std::string& body) {
  for (const Object& object : scene.objects)
    if (object.kind == ObjectKind::body && object.body == body) return &object;
  return nullptr;
}

bool is_of_class(const Scene& scene, const std::string& body, const std::string& class_name) {
  const Object* object = whole_object(scene, body);
  return object != nullptr && object->class_name == class_name;
}

// Its colour tells it from others: instructions name it.
bool has_telling_colour(const Scene& scene, const std::string& body, int part) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
    const bool meant = object.kind == ObjectKind::body || (object.kind == ObjectKind::part && object.part == part);
    return meant && object.body == body && object.attributes.contains("colour");
  });
}

// Which things a list of names means. `all` is set by `*`.
struct Meant {
  bool all = false, robot = false;
  std::set<std::string> bodies;
};

Meant meant_by(const Scene& scene, const std::vector<std::string>& names, const char* field) {
  Meant meant;
  std::vector<std::string> known{kAll, kRobot};
  for (const Body& body : scene.bodies) {
    known.push_back(body.name);
    if (const Object* object = whole_object(scene, body.name)) known.push_back(object->class_name);
  }
  for (const std::string& name : names) {
    if (name.empty() || std::find(known.begin(), known.end(), name) == known.end())
      throw Error(std::string("randomise.") + field, "the scene has no thing named '" + name + "'",
                  did_you_mean(name, known));
    meant.all |= name == kAll;
    meant.robot |= name == kRobot;
    for (const Body& body : scene.bodies)
      if (body.name == name || is_of_class(scene, body.name, name)) meant.bodies.insert(body.name);
  }
  return meant;
}

void check_range(const Range& range, const char* name, double least) {
  if (!std::isfinite(range[0]) || !std::isfinite(range[1]) || range[0] > range[1] || range[0] < least)
    throw Error(std::string("randomise.") + name, "its range needs a lower and an upper end, neither below the least",
                "write { 0.8, 1.2 }");
}

void check_reach(double value, const char* name) {
  if (!std::isfinite(value) || value < 0)
    throw Error(std::string("randomise.") + name, "it must be a finite number, not negative", "0 leaves it alone");
}

void check(const Scene& scene, const Randomisation& ranges) {
  constexpr double kLeastMass = 1e-3;
  check_range(ranges.mass, "mass", kLeastMass);
  check_range(ranges.friction, "friction", 0);
  check_range(ranges.damping, "damping", 0);
  check_range(ranges.ambient, "ambient", 0);
  check_range(ranges.diffuse, "diffuse", 0);
  check_reach(ranges.light_direction_rad, "light_direction_rad");
  check_reach(ranges.camera_position_m, "camera_position_m");
  check_reach(ranges.camera_rotation_rad, "camera_rotation_rad");
  std::vector<std::string> known(kProcedural.begin(), kProcedural.end());
  known.push_back(kPlain);
  for (const auto& [name, texture] : scene.textures) known.push_back(name);
  for (const std::string& name : ranges.textures)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Error("randomise.textures", "there is no texture '" + name + "'", did_you_mean(name, known));
}

std::size_t index_below(std::size_t size, Random& random) {
  return static_cast<std::size_t>(random.below(static_cast<std::int64_t>(size)));
}

double draw(const Range& range, RandomKey key) { return Random(key).between(range[0], range[1]); }

Vector3 direction(Random& random) {  // uniform on the sphere (Archimedes)
  const double z = random.between(-1, 1), angle = random.between(0, 2 * std::numbers::pi);
  const double radius = std::sqrt(std::max(0.0, 1 - z * z));
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

// --- looks

// Two different ones where the list has two.
std::array<Colour, 2> two_colours(const std::vector<Colour>& colours, Random& random) {
  std::array<Colour, 2> drawn;
  if (colours.empty()) {
    for (Colour& colour : drawn)
      for (double* channel : {&colour.red, &colour.green, &colour.blue})
        *channel = random.between(kChannel[0], kChannel[1]);
    return drawn;
  }
  const std::size_t first = index_below(colours.size(), random);
  const std::size_t step = colours.size() > 1 ? 1 + index_below(colours.size() - 1, random) : 0;
  return {colours[first], colours[(first + step) % colours.size()]};
}

std::string free_name(const Scene& scene, const std::string& wish) {
  std::string name = wish;
  for (int i = 2; scene.textures.contains(name); ++i) name = wish + "_" + std::to_string(i);
  return name;
}

// One draw for each part, so that a drawer can still be told from its chest.
void draw_looks(Scene& scene, Part& part, const std::string& wish, const Randomisation& ranges, RandomKey key) {
  const auto visible = [](const Shape& shape) { return shape.visible; };
  if (std::none_of(part.shapes.begin(), part.shapes.end(), visible)) return;
  Random random(key);
  const std::array<Colour, 2> colours = two_colours(ranges.colours, random);
  std::string texture = ranges.textures.empty() ? kPlain : ranges.textures[index_below(ranges.textures.size(), random)];
  const bool plain = texture == kPlain;
  const auto kind = std::find(kProcedural.begin(), kProcedural.end(), texture);
  if (kind != kProcedural.end()) {
    Texture drawn;
    drawn.kind = std::array{TextureKind::checker, TextureKind::stripes, TextureKind::noise}.at(
        static_cast<std::size_t>(kind - kProcedural.begin()));
    drawn.first = colours[0], drawn.second = colours[1];
    drawn.size_m = random.between(kRepeat[0], kRepeat[1]);
    drawn.seed = static_cast<int>(random.below(1 << 30));
    texture = free_name(scene, wish);
    scene.textures[texture] = drawn;
  }
  for (Shape& shape : part.shapes) {
    if (!shape.visible) continue;
    const double alpha = shape.colour.alpha;
    shape.colour = plain ? colours[0] : Colour{1, 1, 1, 1};
    shape.colour.alpha = alpha;
    shape.texture = plain ? "" : texture;
  }
}

void draw_body_looks(Scene& scene, Body& body, const std::string& name, bool all_only, const Randomisation& ranges,
                     RandomKey key) {
  for (std::size_t i = 0; i < body.parts.size(); ++i) {
    if (all_only && has_telling_colour(scene, name, static_cast<int>(i))) continue;
    Part& part = body.parts[i];
    const std::string wish = "random_" + name + (i == 0 ? "" : "_" + part.name);
    draw_looks(scene, part, wish, ranges, key.with(name).with(part.name));
  }
}

void randomise_looks(Scene& scene, const Randomisation& ranges, RandomKey key) {
  const Meant meant = meant_by(scene, ranges.looks, "looks");
  for (Body& body : scene.bodies)
    if (const bool named = meant.bodies.contains(body.name); named || meant.all)
      draw_body_looks(scene, body, body.name, !named, ranges, key);
  if (meant.robot || meant.all)
    draw_body_looks(scene, scene.robot.body, scene.robot.name, !meant.robot, ranges, key.with(kRobot));
}

// --- light and cameras

void randomise_light(Light& light, const Randomisation& ranges, RandomKey key) {
  const Randomisation untouched;
  if (ranges.ambient != untouched.ambient) light.ambient = draw(ranges.ambient, key.with("ambient"));
  if (ranges.diffuse != untouched.diffuse) light.diffuse = draw(ranges.diffuse, key.with("diffuse"));
  if (!(ranges.light_direction_rad > 0) || !(light.direction.norm() > 0)) return;
  Random random(key.with("direction"));
  const Vector3 way = light.direction.normalized();
  const Vector3 across = way.unitOrthogonal();
  const Vector3 axis = Eigen::AngleAxisd(random.between(0, 2 * std::numbers::pi), way) * across;
  const double tilt = ranges.light_direction_rad * std::sqrt(random.uniform());  // evenly over the cap
  light.direction = Eigen::AngleAxisd(tilt, axis) * light.direction;
}

void jitter(Camera& camera, const Randomisation& ranges, RandomKey key) {
  Random random(key.with(camera.name));
  const Vector3 offset = direction(random) * (ranges.camera_position_m * std::cbrt(random.uniform()));
  const Vector3 axis = direction(random);
  const double angle = ranges.camera_rotation_rad * random.uniform();
  if (ranges.camera_position_m > 0) camera.mount_from_camera.pretranslate(offset);
  if (ranges.camera_rotation_rad > 0) camera.mount_from_camera.rotate(Eigen::AngleAxisd(angle, axis));
}

// --- dynamics

void scale_weight(Body& body, const Randomisation& ranges, RandomKey key) {
  const double mass = draw(ranges.mass, key.with("mass")), friction = draw(ranges.friction, key.with("friction"));
  for (Part& part : body.parts) {
    part.mass *= mass;
    part.inertia *= mass;
    part.surface.friction *= friction;
  }
}

void scale_damping(Body& body, const Randomisation& ranges, RandomKey key) {
  const double damping = draw(ranges.damping, key.with("damping"));
  for (Part& part : body.parts) part.joint.damping *= damping;
}

void randomise_dynamics(Scene& scene, const Randomisation& ranges, RandomKey key) {
  const Meant meant = meant_by(scene, ranges.dynamics, "dynamics");
  for (Body& body : scene.bodies) {
    const bool named = meant.bodies.contains(body.name);
    if (named || (meant.all && body.free)) scale_weight(body, ranges, key.with(body.name));
    if (named || meant.all) scale_damping(body, ranges, key.with(body.name));
  }
  if (!meant.robot) return;
  scale_weight(scene.robot.body, ranges, key.with(kRobot).with(scene.robot.name));
  scale_damping(scene.robot.body, ranges, key.with(kRobot).with(scene.robot.name));
}

}  // namespace

Randomisation default_randomisation() {
  Randomisation ranges;
  ranges.looks = {kAll};
  ranges.textures = {kPlain, "checker", "stripes", "noise"};
  ranges.ambient = {0.35, 0.6};
  ranges.diffuse = {0.4, 0.75};
  ranges.light_direction_rad = 0.5;
  ranges.camera_position_m = 0.02;
  ranges.camera_rotation_rad = 0.03;
  ranges.dynamics = {kAll};
  ranges.mass = {0.8, 1.25};
  ranges.friction = {0.85, 1.2};
  ranges.damping = {0.7, 1.4};
  return ranges;
}

void randomise(Scene& scene, const Randomisation& ranges, RandomKey key) {
  check(scene, ranges);
  Scene drawn = scene;  // an error leaves the scene as it was
  randomise_looks(drawn, ranges, key.with("looks"));
  randomise_light(drawn.light, ranges, key.with("light"));
  for (Camera& camera : drawn.cameras) jitter(camera, ranges, key.with("camera"));
  randomise_dynamics(drawn, ranges, key.with("dynamics"));
  scene = std::move(drawn);
}

}  // namespace stampede
