#include "engine/model/scene_poses.h"

#include <catch2/catch.hpp>

#include "engine/model/kinematics.h"
#include "tests/support/panda.h"

using namespace stampede;

namespace {

double distance(const Transform& a, const Transform& b) { return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff(); }

}  // namespace

TEST_CASE("at the start bodies are where the scene puts them and the robot is at home") {
  const Scene scene = table_scene(3);
  const ScenePoses poses = scene_poses(scene, initial_state(scene));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    CHECK(distance(poses.world_from_part[i].at(0), scene.bodies[i].world_from_body) == 0);
  const Arm arm(scene.robot);
  const Transform tip =
      poses.world_from_robot_part.at(static_cast<std::size_t>(scene.robot.tip_part)) * scene.robot.tip_part_from_tip;
  CHECK(distance(tip, arm.world_from_tip(arm.home())) < 1e-12);
}

TEST_CASE("any configuration of the arm puts the tip where its kinematics say") {
  const Scene scene = table_scene(0);
  const Arm arm(scene.robot);
  Random random(RandomKey("poses"));
  for (int i = 0; i < 20; ++i) {
    SceneState state = initial_state(scene);
    JointVector q(arm.joints());
    for (int k = 0; k < arm.joints(); ++k) {
      q[k] = random.between(scene.robot.limits[static_cast<std::size_t>(k)].lower,
                            scene.robot.limits[static_cast<std::size_t>(k)].upper);
      state.robot_position[static_cast<std::size_t>(scene.robot.arm[static_cast<std::size_t>(k)])] = q[k];
    }
    const ScenePoses poses = scene_poses(scene, state);
    const Transform tip =
        poses.world_from_robot_part[static_cast<std::size_t>(scene.robot.tip_part)] * scene.robot.tip_part_from_tip;
    CHECK(distance(tip, arm.world_from_tip(q)) < 1e-12);
  }
}

TEST_CASE("drawers, regions and cameras move with what they are fixed to") {
  Scene scene = table_scene(1);
  Part drawer;
  drawer.name = "drawer", drawer.parent = 0;
  drawer.joint.kind = JointKind::slider, drawer.joint.axis = Vector3::UnitY(), drawer.joint.initial = 0.1;
  drawer.joint.parent_from_joint = translation(0.2, 0, 0.3);
  scene.bodies[0].parts.push_back(drawer);
  scene.regions.push_back({"inside", "table", 1, translation(0, 0, 0.05), {1, 1, 1}, false, {}, 0});
  scene.regions.push_back({"spot", "", 0, translation(9, 8, 7), {1, 1, 1}, false, {}, 0});
  scene.regions.push_back(
      {"grip", scene.robot.name, scene.robot.tip_part, translation(0, 0, 0.1), {1, 1, 1}, false, {}, 0});
  SceneState state = initial_state(scene);
  const Transform world_from_table = scene.bodies[0].world_from_body;
  CHECK(distance(scene_poses(scene, state).world_from_part[0][1], world_from_table * translation(0.2, 0.1, 0.3)) <
        1e-12);
  state.joint_position[0][1] = 0.25;
  const ScenePoses poses = scene_poses(scene, state);
  const Transform world_from_drawer = world_from_table * translation(0.2, 0.25, 0.3);
  CHECK(distance(poses.world_from_part[0][1], world_from_drawer) < 1e-12);
  CHECK(distance(poses.world_from_region[0], world_from_drawer * translation(0, 0, 0.05)) < 1e-12);
  CHECK(distance(poses.world_from_region[1], translation(9, 8, 7)) == 0);
  const Transform& world_from_hand = poses.world_from_robot_part[static_cast<std::size_t>(scene.robot.tip_part)];
  CHECK(distance(poses.world_from_region[2], world_from_hand * translation(0, 0, 0.1)) < 1e-12);
  Camera camera;
  camera.mount_from_camera = translation(0.01, 0.02, 0.03);
  CHECK(distance(world_from_camera(scene, poses, camera), camera.mount_from_camera) == 0);
  camera.mount_body = scene.robot.name, camera.mount_part = scene.robot.tip_part;
  CHECK(distance(world_from_camera(scene, poses, camera), world_from_hand * camera.mount_from_camera) < 1e-12);
  camera.mount_body = "table", camera.mount_part = 1;
  CHECK(distance(world_from_camera(scene, poses, camera), world_from_drawer * camera.mount_from_camera) < 1e-12);
}

TEST_CASE("the same state gives the same poses to the last bit") {
  const Scene scene = table_scene(2);
  const ScenePoses a = scene_poses(scene, initial_state(scene)), b = scene_poses(scene, initial_state(scene));
  for (std::size_t i = 0; i < a.world_from_robot_part.size(); ++i)
    CHECK(distance(a.world_from_robot_part[i], b.world_from_robot_part[i]) == 0);
}
