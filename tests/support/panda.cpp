#include "tests/support/panda.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "engine/base/error.h"
#include "engine/model/urdf.h"

namespace stampede {
namespace {

constexpr std::array<double, 7> kAcceleration{15, 7.5, 10, 12.5, 15, 20, 20};       // rad/s^2
constexpr std::array<double, 7> kJerk{7500, 3750, 5000, 6250, 7500, 10000, 10000};  // rad/s^3
constexpr double kCube = 0.04;                                                      // m

std::vector<std::pair<int, int>> self_collision_pairs(const Body& body) {
  const std::vector<std::string> outer{"link7", "hand", "left_finger", "right_finger"};
  std::vector<std::pair<int, int>> pairs;
  const auto add = [&](const char* inner, const std::vector<std::string>& others) {
    for (const std::string& other : others) pairs.emplace_back(body.part_index(inner), body.part_index(other));
  };
  for (const char* inner : {"link0", "link1"}) {
    add(inner, {"link5", "link6"});
    add(inner, outer);
  }
  add("link2", {"link5"});
  add("link2", outer);
  add("link5", outer);
  return pairs;
}

Body box_body(const std::string& name, const Vector3& size, const Vector3& centre, const Colour& colour) {
  Shape shape;
  shape.size = size;
  shape.colour = colour;
  Part part;
  part.name = name;
  part.shapes.push_back(shape);
  Body body;
  body.name = name;
  body.parts.push_back(part);
  body.world_from_body = translation(centre);
  return body;
}

Object object_of(const Body& body, const std::string& type, std::vector<std::string> traits) {
  Object object;
  object.name = object.body = body.name;
  object.class_name = object.type = type;
  object.traits = std::move(traits);
  object.size = body.parts[0].shapes[0].size;
  return object;
}

}  // namespace

Robot panda_robot(const Transform& world_from_base) {
  constexpr double pi = std::numbers::pi;
  Robot robot;
  robot.name = "panda";
  robot.body = read_urdf(STAMPEDE_SOURCE_DIR "/worlds/robots/panda.urdf").body;
  robot.body.world_from_body = world_from_base;
  for (std::size_t i = 0; i < 7; ++i) {
    const int index = robot.body.part_index("link" + std::to_string(i + 1));
    const Joint& joint = robot.body.parts[static_cast<std::size_t>(index)].joint;
    robot.arm.push_back(index);
    robot.limits.push_back({joint.lower, joint.upper, joint.velocity, kAcceleration[i], kJerk[i], joint.effort});
  }
  robot.home = {0, -pi / 4, 0, -3 * pi / 4, 0, pi / 2, pi / 4};
  for (std::size_t i = 0; i < 7; ++i)
    robot.body.parts[static_cast<std::size_t>(robot.arm[i])].joint.initial = robot.home[i];
  robot.fingers = {robot.body.part_index("left_finger"), robot.body.part_index("right_finger")};
  robot.pads = robot.fingers;
  for (const int finger : robot.fingers) {
    Part& part = robot.body.parts[static_cast<std::size_t>(finger)];
    part.joint.initial = part.joint.upper;
    part.surface = {.friction = 1.0, .spinning = 0.1, .anchor = true};  // what keeps a grasped cube from creeping
  }
  robot.tip_part = robot.body.part_index("hand");
  robot.tip_part_from_tip = translation(0, 0, 0.1034);
  robot.checked_pairs = self_collision_pairs(robot.body);
  return robot;
}

Scene table_scene(int cubes) {
  if (cubes < 0 || cubes > 30) throw Error("table_scene", "0 to 30 cubes fit on the table");
  Scene scene;
  scene.world = "test_table";
  scene.robot = panda_robot();
  scene.bodies.push_back(box_body("table", {0.8, 1.2, 0.05}, {0.55, 0, -0.025}, {0.6, 0.45, 0.3, 1}));
  scene.objects.push_back(object_of(scene.bodies[0], "table", {"surface"}));
  for (int i = 0; i < cubes; ++i) {
    const Vector3 centre(0.4 + 0.09 * (i / 5), 0.1 * (i % 5) - 0.2, kCube / 2);
    Body cube = box_body("cube" + std::to_string(i + 1), Vector3::Constant(kCube), centre, {0.8, 0.2, 0.2, 1});
    cube.free = true;
    set_uniform_mass(cube.parts[0], 0.1);
    scene.objects.push_back(object_of(cube, "cube", {"graspable", "movable", "surface"}));
    scene.bodies.push_back(std::move(cube));
  }
  Object hand;
  hand.name = "panda.hand";
  hand.kind = ObjectKind::hand;
  hand.class_name = hand.type = "hand";
  scene.objects.push_back(hand);
  const auto by_name = [](const auto& a, const auto& b) { return a.name < b.name; };
  std::sort(scene.bodies.begin() + 1, scene.bodies.end(), by_name);  // fixtures stay in front
  std::sort(scene.objects.begin(), scene.objects.end(), by_name);
  return scene;
}

}  // namespace stampede
