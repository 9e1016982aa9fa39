// Cameras, sensors, light, randomisation and observation of a world, as they reach the scene and the episode.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <lua.hpp>

#include "engine/model/camera.h"
#include "engine/model/masks.h"
#include "engine/model/randomise.h"
#include "engine/record/observation.h"
#include "scripting/runtime/evaluate.h"
#include "scripting/runtime/scene_builder.h"
#include "scripts_fixture.h"

using namespace stampede;
using test::small_library;

namespace {

Value value_of(const std::string& table) {
  const std::unique_ptr<lua_State, void (*)(lua_State*)> state(luaL_newstate(), lua_close);
  REQUIRE(luaL_loadstring(state.get(), ("return " + table).c_str()) == LUA_OK);
  lua_call(state.get(), 0, 1);
  return read_value(state.get(), 1, {RandomKey("test"), 0, "worlds/lab.lua", {}}, "one");
}

// A robot of two links and a chest with a drawer.
class Lab {
 public:
  Lab() : builder_("lab", colours_) {
    Robot robot;
    robot.name = "mini";
    for (const char* name : {"base", "fore", "palm"}) {
      Part part;
      part.name = name;
      part.parent = static_cast<int>(robot.body.parts.size()) - 1;
      robot.body.parts.push_back(part);
    }
    robot.tip_part = 2;
    builder_.set_robot(robot);
    builder_.add_fixture(
        {"chest",
         "chest",
         value_of("{ at = { 1, 2, 3 }, shape = { shape = 'box', 1, 1, 1 }, parts = { drawer = { type = "
                  "'drawer', slider = { range = { 0, 1 } }, shape = { shape = 'box', 1, 1, 1 }, mass "
                  "= 1 } }, regions = { top = { at = { 0, 0, 0.5 }, size = { 1, 1, 1 } } } }"),
         {}});
    builder_.set_rates(240, 20, Vector3(0, 0, -9.81));
  }
  Camera camera(const std::string& table) {
    builder_.add_camera("one", value_of(table));
    return builder_.build().cameras.at(0);
  }
  Sensor sensor(const std::string& table) {
    builder_.add_sensor("one", value_of(table));
    return builder_.build().sensors.at(0);
  }

 private:
  Colours colours_;
  SceneBuilder builder_;
};

}  // namespace

TEST_CASE("a camera sees its target in the middle, with up upwards") {
  const Camera camera = Lab().camera("{ at = { 0, 0, 0 }, look_at = 'chest', size = { 200, 100 }, fov = 1 }");
  const Vector3 seen = camera.mount_from_camera.inverse() * Vector3(1, 2, 3);
  CHECK((seen - Vector3(0, 0, std::sqrt(14.0))).norm() < 1e-12);
  const Vector3 above = camera.mount_from_camera.inverse() * Vector3(1, 2, 3.1);
  CHECK(project(camera, above)[0] == Approx(100));
  CHECK(project(camera, above)[1] < 50);
  CHECK(vertical_field_of_view(camera) == Approx(1));
}

TEST_CASE("explicit intrinsics go into the scene as they are") {
  const Camera camera = Lab().camera(
      "{ at = { 0, 0, 1 }, size = { 640, 480 }, focal = { 600, 610 }, centre = { 321, 239 }, "
      "distortion = { 0.1, -0.2, 0.001, 0.002, 0.05 }, near = 0.2, far = 2 }");
  CHECK(std::array{camera.focal_x, camera.focal_y, camera.centre_x, camera.centre_y} ==
        std::array{600.0, 610.0, 321.0, 239.0});
  CHECK(camera.distortion == std::array{0.1, -0.2, 0.001, 0.002, 0.05});
  CHECK(std::array{camera.near_m, camera.far_m} == std::array{0.2, 2.0});
  CHECK(Lab().camera("{ at = { 0, 0, 1 }, size = { 640, 480 }, focal = { 600, 610 } }").centre_x == 320);
}

TEST_CASE("cameras ride on links, parts and regions") {
  const Camera hand =
      Lab().camera("{ mount = 'robot.hand', at = { 0.07, 0, 0 }, look_at = { 0.07, 0, 1 }, up = { 1, 0, 0 } }");
  CHECK(hand.mount_body == "mini");
  CHECK(hand.mount_part == 2);
  CHECK((hand.mount_from_camera * Vector3(0, 0, 1) - Vector3(0.07, 0, 1)).norm() < 1e-12);   // z forward
  CHECK((hand.mount_from_camera * Vector3(0, -1, 0) - Vector3(1.07, 0, 0)).norm() < 1e-12);  // y down
  CHECK(Lab().camera("{ mount = 'robot.fore', at = { 0, 0, 0 } }").mount_part == 1);
  CHECK(Lab().camera("{ mount = 'mini.palm', at = { 0, 0, 0 } }").mount_part == 2);
  const Camera drawer = Lab().camera("{ mount = 'chest.drawer', at = { 1, 0, 0 } }");
  CHECK(drawer.mount_body == "chest");
  CHECK(drawer.mount_part == 1);
  const Camera top = Lab().camera("{ mount = 'chest.top', at = { 1, 0, 0 } }");
  CHECK(top.mount_part == 0);
  CHECK((top.mount_from_camera.translation() - Vector3(1, 0, 0.5)).norm() < 1e-12);
}

TEST_CASE("mistakes of a camera are named with their cure") {
  using Catch::Contains;
  const auto said = [](const std::string& fields) {
    try {
      Lab().camera("{ at = { 0, 0, 1 }, " + fields + " }");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(said("mount = 'robot.for'"),
             Contains("one.mount") && Contains("no link 'for'") && Contains("'robot.fore'?"));
  CHECK_THAT(said("mount = 'chst'"), Contains("nothing named 'chst'") && Contains("'chest'?"));
  CHECK_THAT(said("mount = 'chest', look_at = 'chest'"), Contains("a point of its mount's frame"));
  CHECK_THAT(said("look_at = { 0, 0, 1 }"), Contains("let `look_at` differ from `at`"));
  for (const char* size : {"{ 0, 10 }", "{ 10, 4097 }", "{ 10.5, 10 }", "{ 10 }"})
    CHECK_THAT(said(std::string("size = ") + size), Contains("one.size") && Contains("1 to 4096 whole pixels"));
  CHECK_THAT(said("near = 0"), Contains("near must be above 0"));
  CHECK_THAT(said("near = 2, far = 2"), Contains("far beyond it"));
  CHECK_THAT(said("fov = 0"), Contains("one.fov") && Contains("between 0 and pi"));
  CHECK_THAT(said("fov = 3.2"), Contains("between 0 and pi"));
  CHECK_THAT(said("focal = { 100, -100 }"), Contains("one.focal") && Contains("above 0"));
  CHECK_THAT(said("focal = { 100, 100 }, fov = 1"), Contains("leave one out"));
  CHECK_THAT(said("distortion = { 1, 2 }"), Contains("five numbers"));
}

TEST_CASE("sensors sit on links and have rates that divide the physics rate") {
  const Sensor wrench = Lab().sensor("{ 'force_torque', on = 'robot.fore', rate = 60 }");
  CHECK(wrench.kind == "force_torque");
  CHECK(wrench.part == 1);
  CHECK(wrench.rate_hz == 60);
  CHECK(Lab().sensor("{ 'force_torque' }").part == 2);
  CHECK(Lab().sensor("{ 'joint_torque', rate = 20 }").rate_hz == 20);
  using Catch::Contains;
  CHECK_THROWS_WITH(Lab().sensor("{ 'force_torqe' }"),
                    Contains("no sensor of kind 'force_torqe'") && Contains("'force_torque'?"));
  CHECK_THROWS_WITH(Lab().sensor("{ 'force_torque', on = 'robot.plam' }"),
                    Contains("no link 'plam'") && Contains("'robot.palm'?"));
  CHECK_THROWS_WITH(Lab().sensor("{ 'force_torque', rate = 50 }"), Contains("one.rate") &&
                                                                       Contains("does not divide 240 Hz") &&
                                                                       Contains("these do: 1 2 3 4 5 6 8 10"));
}

TEST_CASE("a task's scene carries looks, light, sensors and measured cameras") {
  EpisodeScripts scripts(small_library(), "seen", "", 7);
  const Scene scene = scripts.task()(0).scene;
  REQUIRE(scene.cameras.size() == 2);
  CHECK(scene.cameras[0].name == "above");  // by the calibration file, not the world
  CHECK(scene.cameras[0].focal_y == 110);
  CHECK(scene.cameras[0].width == 80);
  CHECK(scene.cameras[0].distortion[0] == 0.1);
  CHECK(scene.cameras[1].mount_body == "mini");
  REQUIRE(scene.sensors.size() == 2);
  CHECK(scene.sensors[1].name == "wrench");
  CHECK(scene.robot.body.parts[static_cast<std::size_t>(scene.sensors[1].part)].name == "fore");
  CHECK(scene.light.direction == Vector3(0, 0, -1));
  CHECK(scene.light.ambient == 0.3);
  CHECK(scene.light.specular == 0);
  CHECK(scene.meshes.size() == 1);    // two wedges, one mesh
  CHECK(scene.textures.size() == 3);  // tiles, the task's checker, the checker that may be drawn
  for (const Body& body : scene.bodies)
    for (const Part& part : body.parts)
      for (const Shape& shape : part.shapes) {
        CHECK((shape.mesh.empty() || scene.meshes.contains(shape.mesh)));
        CHECK((shape.texture.empty() || scene.textures.contains(shape.texture)));
      }
  CHECK(scene_to_document(scene_from_document(scene_to_document(scene))) == scene_to_document(scene));
}

TEST_CASE("randomisation and observation are what world and task say, the task first") {
  EpisodeScripts scripts(small_library(), "seen", "", 7);
  const std::optional<Randomisation> ranges = scripts.task()(0).randomisation;
  REQUIRE(ranges);
  CHECK(ranges->looks == std::vector<std::string>{"bench", "wedge"});  // no chest in this task
  CHECK(ranges->colours.size() == 4);
  REQUIRE(ranges->textures.size() == 2);
  CHECK(ranges->textures[0] == "plain");
  CHECK(scripts.task()(0).scene.textures.contains(ranges->textures[1]));
  CHECK(ranges->ambient == Range{0.2, 0.6});
  CHECK(ranges->diffuse == Randomisation{}.diffuse);
  CHECK(ranges->light_direction_rad == Approx(0.349066).epsilon(1e-5));
  CHECK(ranges->mass == Range{0.5, 2});
  Scene scene = scripts.task()(0).scene;
  CHECK_NOTHROW(randomise(scene, *ranges, RandomKey("test")));

  const Observation seen = chosen(scripts.task()(0).observation);
  CHECK(seen.images == WhichFrames::all);  // the task's
  CHECK(seen.shadows);
  CHECK(seen.cameras == std::vector<std::string>{"above"});  // the world's
  CHECK(std::array{seen.width, seen.height} == std::array{32, 24});
  CHECK((seen.kinds.rgb && seen.kinds.depth && !seen.kinds.instance && !seen.kinds.semantic));
  CHECK(seen.noise.rgb == 0.02);
  CHECK(seen.channels == std::vector<std::string>{"wrench"});

  EpisodeScripts silent(small_library(), "steps", "", 7);
  CHECK_FALSE(silent.task()(0).randomisation);
  CHECK(silent.task()(0).observation.as_text().empty());
}

TEST_CASE("semantic numbers are the same for all tasks of one library") {
  const Scene one = EpisodeScripts(small_library(), "seen", "", 7).task()(0).scene;
  const Scene two = EpisodeScripts(small_library(), "steps", "", 7).task()(0).scene;
  CHECK(one.classes == two.classes);
  for (const char* name : {"bench", "chest", "cube", "drawer", "hand", "mini", "region", "spot", "wedge"})
    CHECK(std::count(one.classes.begin(), one.classes.end(), name) == 1);
  CHECK(std::is_sorted(one.classes.begin(), one.classes.end()));
  for (Scene scene : {one, two}) {
    number_masks(scene, RandomKey("test"));
    CHECK_NOTHROW(mask_key(scene));  // every part has its class among them
  }
}

TEST_CASE("a calibration file that is missing or has a wrong shape names the world's field, the file and the cure") {
  namespace fs = std::filesystem;
  char folder[] = "/tmp/stampede_world_XXXXXX";
  REQUIRE(mkdtemp(folder) != nullptr);
  const fs::path root = folder, file = root / "worlds/studio_cameras.json";
  fs::copy(STAMPEDE_SOURCE_DIR "/tests/scripting/data/runtime", root, fs::copy_options::recursive);
  const auto said = [&] {
    try {
      EpisodeScripts(Library::load({{root}}), "seen", "", 7);
    } catch (const Error& error) {
      CHECK(std::string(error.what()).find("\n    ") != std::string::npos);  // the cure
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(said() == "accepted");
  using Catch::Contains;
  std::ofstream(file) << "{ \"cameras\": [ { \"name\": \"above\", \"width\": 80, \"height\": 60, \"camera_matrix\": "
                         "[[100, 0], [0, 110]], \"mount\": \"world\" } ] }";
  CHECK_THAT(said(), Contains("worlds/studio.lua: calibration") && Contains("studio_cameras.json"));
  fs::remove(file);
  CHECK_THAT(said(), Contains("worlds/studio.lua: calibration") && Contains("studio_cameras.json"));
  fs::remove_all(root);
}
