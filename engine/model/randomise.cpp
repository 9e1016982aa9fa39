#include "engine/model/randomise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/model/telling.h"

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

struct Look {
  std::string texture;  // a name of the scene's, of one of the procedural kinds, or plain
  std::array<Colour, 2> colours;
  double size_m = 0;
  int seed = 0;
};

bool is_procedural(const std::string& texture) {
  return std::find(kProcedural.begin(), kProcedural.end(), texture) != kProcedural.end();
}

Look drawn_look(const Randomisation& ranges, RandomKey key) {
  Random random(key);
  Look look;
  look.colours = two_colours(ranges.colours, random);
  look.texture = ranges.textures.empty() ? kPlain : ranges.textures[index_below(ranges.textures.size(), random)];
  if (!is_procedural(look.texture)) return look;
  look.size_m = random.between(kRepeat[0], kRepeat[1]);
  look.seed = static_cast<int>(random.below(1 << 30));
  return look;
}

std::vector<Colour> shown(const Look& look) {
  if (look.texture == kPlain) return {look.colours[0]};
  return is_procedural(look.texture) ? std::vector<Colour>{look.colours[0], look.colours[1]} : std::vector<Colour>{};
}

// By how much it stands out from all of these.
double clearance(const Look& look, const std::vector<Colour>& standing) {
  double least = std::numeric_limits<double>::infinity();
  for (const Colour& own : shown(look))
    for (const Colour& other : standing) least = std::min(least, difference(own, other));
  return least;
}

// The first that stands out enough, or else the one of many that does most.
Look look_apart(const std::vector<Colour>& standing, const Randomisation& ranges, RandomKey key) {
  constexpr double kEnough = 25;
  constexpr int kTries = 64;
  Look best = drawn_look(ranges, key);
  double most = clearance(best, standing);
  for (int i = 1; i < kTries && most < kEnough; ++i) {
    Look look = drawn_look(ranges, key.with(i));
    const double apart = clearance(look, standing);
    if (apart > most) best = std::move(look), most = apart;
  }
  return best;
}

// Draws looks for the bodies of a scene.
class Dresser {
 public:
  Dresser(Scene& scene, const Randomisation& ranges, const Telling& telling)
      : scene_(scene), ranges_(ranges), telling_(telling) {}
  void dress(Body& body, const Body& before, const std::string& name, RandomKey key);

 private:
  void wear(Part& part, const std::vector<std::size_t>& shapes, const Look& look, const std::string& wish);

  Scene& scene_;
  const Randomisation& ranges_;
  const Telling& telling_;
};

void Dresser::wear(Part& part, const std::vector<std::size_t>& shapes, const Look& look, const std::string& wish) {
  const bool plain = look.texture == kPlain;
  std::string texture = look.texture;
  const auto kind = std::find(kProcedural.begin(), kProcedural.end(), texture);
  if (kind != kProcedural.end()) {
    Texture drawn;
    drawn.kind = std::array{TextureKind::checker, TextureKind::stripes, TextureKind::noise}.at(
        static_cast<std::size_t>(kind - kProcedural.begin()));
    drawn.first = look.colours[0], drawn.second = look.colours[1];
    drawn.size_m = look.size_m, drawn.seed = look.seed;
    texture = free_name(scene_, wish);
    scene_.textures[texture] = drawn;
  }
  for (const std::size_t i : shapes) {
    Shape& shape = part.shapes[i];
    const double alpha = shape.colour.alpha;
    shape.colour = plain ? look.colours[0] : Colour{1, 1, 1, 1};
    shape.colour.alpha = alpha;
    shape.texture = plain ? "" : texture;
  }
}

// One draw for each part, so that a drawer can still be told from its chest.
void Dresser::dress(Body& body, const Body& before, const std::string& name, RandomKey key) {
  const std::vector<Colour> standing = telling_.standing(before);
  std::vector<std::vector<Colour>> worn(body.parts.size());
  for (std::size_t i = 0; i < body.parts.size(); ++i) {
    Part& part = body.parts[i];
    const std::vector<std::size_t> shapes = telling_.ground(before, i);
    if (shapes.empty()) continue;
    std::vector<Colour> others = standing;
    if (i > 0) {
      const std::vector<Colour>& parent = worn[static_cast<std::size_t>(std::max(part.parent, 0))];
      others.insert(others.end(), parent.begin(), parent.end());
    }
    const Look look = look_apart(others, ranges_, key.with(name).with(part.name));
    worn[i] = shown(look);
    wear(part, shapes, look, "random_" + name + (i == 0 ? "" : "_" + part.name));
  }
}

// `before`: the scene as it was.
void randomise_looks(const Scene& before, Scene& scene, const Randomisation& ranges, RandomKey key,
                     const std::vector<std::string>& said) {
  const Meant meant = meant_by(scene, ranges.looks, "looks");
  if (ranges.looks.empty()) return;
  const Telling telling(before, said);
  Dresser dresser(scene, ranges, telling);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (Body& body = scene.bodies[i]; meant.all || meant.bodies.contains(body.name))
      dresser.dress(body, before.bodies[i], body.name, key);
  if (meant.robot || meant.all) dresser.dress(scene.robot.body, before.robot.body, scene.robot.name, key.with(kRobot));
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
  const double way = ranges.camera_position_m * std::cbrt(random.uniform());  // evenly in the ball
  const Vector3 offset = way * direction(random);
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

void randomise(Scene& scene, const Randomisation& ranges, RandomKey key, const std::vector<std::string>& said) {
  check(scene, ranges);
  Scene drawn = scene;  // an error leaves the scene as it was
  randomise_looks(scene, drawn, ranges, key.with("looks"), said);
  randomise_light(drawn.light, ranges, key.with("light"));
  for (Camera& camera : drawn.cameras) jitter(camera, ranges, key.with("camera"));
  randomise_dynamics(drawn, ranges, key.with("dynamics"));
  scene = std::move(drawn);
}

}  // namespace stampede
