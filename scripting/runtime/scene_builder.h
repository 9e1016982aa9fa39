// World, robot and object definitions as one Scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/model/scene.h"
#include "scripting/runtime/body_builder.h"

namespace stampede {

// Collects the parts of a scene. Throws Error.
class SceneBuilder {
 public:
  SceneBuilder(std::string world, const Colours& colours) : colours_(colours) { scene_.world = std::move(world); }

  void set_robot(Robot robot);                   // and its hand's object, `panda.hand` of type hand
  void add_fixture(const ObjectSource& source);  // stands where `at` says, by default at the origin
  void add_object(const ObjectSource& source);
  void add_region(const std::string& name, const Value& fields);  // of the world
  void add_camera(const std::string& name, const Value& fields);  // after all bodies: it may look at one
  void set_rates(int physics_hz, int frame_hz, const Vector3& gravity);
  std::string hand() const { return scene_.robot.name + "." + scene_.robot.hand; }

  std::vector<std::string> unplaced() const { return unplaced_; }
  Scene build();  // in the order that Scene asks for

 private:
  void add(BuiltObject built, std::vector<Body>& bodies);
  Vector3 point_of(const Value& value) const;  // { x, y, z }, or where a named thing is

  const Colours& colours_;
  Scene scene_;
  std::vector<Body> fixtures_, bodies_;
  std::vector<std::string> unplaced_;
};

// `body`: as its URDF has it. `fields`: of its Lua file.
Robot build_robot(const std::string& name, const Value& fields, Body body, const Transform& world_from_base,
                  const Colours& colours);

}  // namespace stampede
