// World, robot and object definitions as one Scene.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/model/scene.h"
#include "engine/symbolic/symbols.h"
#include "scripting/runtime/body_builder.h"

namespace stampede {

// Collects the parts of a scene. Throws Error.
class SceneBuilder {
 public:
  SceneBuilder(std::string world, const Colours& colours) : colours_(colours) { scene_.world = std::move(world); }

  void set_robot(Robot robot);                   // and its hand's object, `panda.hand` of type hand
  void add_fixture(const ObjectSource& source);  // stands where `at` says, by default at the origin
  void add_object(const ObjectSource& source);
  // Of a small thing to be taken and put down, of a type that is no kind of what the scene has, nor the other way (but
  // of clutter), so that no goal and no sentence can mean it. False: it is not such a thing, and was not added.
  bool add_clutter(const ObjectSource& source, const Domain& domain);
  void add_region(const std::string& name, const Value& fields);  // of the world
  void add_camera(const std::string& name, const Value& fields);  // after all bodies: it may look at one, or ride on it
  void set_rates(int physics_hz, int frame_hz, const Vector3& gravity);
  void add_sensor(const std::string& name, const Value& fields);  // after the robot and the rates
  void set_light(const Value& fields);
  void add_drawn(const DrawnAssets& drawn) { drawn_.join(drawn); }
  void set_classes(std::vector<std::string> classes);              // Scene::classes, in any order
  void add_class(const std::string& name);                         // behind those, where it is not among them
  std::optional<double> top_of(const std::string& fixture) const;  // highest z of its shapes, m; nothing: there is none
  std::string hand() const { return scene_.robot.name + "." + scene_.robot.hand; }

  std::vector<std::string> unplaced() const { return unplaced_; }
  Scene build();  // in the order that Scene asks for

 private:
  void add(BuiltObject built, std::vector<Body>& bodies);
  Vector3 point_of(const Value& value) const;  // { x, y, z }, or where a named thing is
  int robot_part(const Value& name) const;     // `robot.LINK`; throws Error with the nearest name
  bool on_robot(const std::string& name) const;
  Transform mount(const Value& name, Camera& camera) const;  // sets what it is mounted on; mount_from_frame
  void set_pose(const Value& fields, Camera& camera) const;

  const Colours& colours_;
  Scene scene_;
  std::vector<Body> fixtures_, bodies_;
  std::vector<std::string> unplaced_;
  std::set<std::string> types_;  // of what is no clutter
  DrawnAssets drawn_;
};

// `body`: as its URDF has it. `fields`: of its Lua file.
// The engine drives two jaws along one line, and measures what is between them. `listed`: the robot's `fingers`.
void check_fingers(const Value& listed, const Robot& robot);
Robot build_robot(const std::string& name, const Value& fields, Body body, const Transform& world_from_base,
                  const Colours& colours);

// `joints`: positions by joint or link, at which the arm starts instead of at home.
void set_start(const Value& joints, Robot& robot);

}  // namespace stampede
