#include "engine/model/scene_poses.h"

#include "engine/model/kinematics.h"

namespace stampede {
namespace {

std::vector<double> initial_positions(const Body& body) {
  std::vector<double> positions;
  for (const Part& part : body.parts)
    positions.push_back(part.parent < 0 || part.joint.kind == JointKind::fixed ? 0 : part.joint.initial);
  return positions;
}

}  // namespace

SceneState initial_state(const Scene& scene) {
  SceneState state;
  for (const Body& body : scene.bodies) {
    state.world_from_body.push_back(body.world_from_body);
    state.joint_position.push_back(initial_positions(body));
  }
  state.robot_position = initial_positions(scene.robot.body);
  for (const Region& region : scene.regions) state.world_from_region.push_back(region.part_from_region);
  return state;
}

ShownFacts facts_that_show(const Scene& scene) {
  ShownFacts facts;
  for (const Body& body : scene.bodies)
    for (const Part& part : body.parts)
      for (const Shape& shape : part.shapes)
        if (!shape.shown_by.empty()) facts.insert(shape.shown_by);
  return facts;
}

ScenePoses scene_poses(const Scene& scene, const SceneState& state) {
  ScenePoses poses;
  poses.facts = state.facts;
  poses.world_from_part.resize(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    forward_kinematics(scene.bodies[i], state.world_from_body[i], state.joint_position[i], poses.world_from_part[i]);
  forward_kinematics(scene.robot.body, scene.robot.body.world_from_body, state.robot_position,
                     poses.world_from_robot_part);
  for (std::size_t i = 0; i < scene.regions.size(); ++i) {
    const Region& region = scene.regions[i];
    if (region.body.empty()) {
      poses.world_from_region.push_back(state.world_from_region[i]);
      continue;
    }
    const int body = scene.body_index(region.body);
    const auto& parts = body < 0 ? poses.world_from_robot_part : poses.world_from_part[static_cast<std::size_t>(body)];
    poses.world_from_region.push_back(parts[static_cast<std::size_t>(region.part)] * region.part_from_region);
  }
  return poses;
}

Transform world_from_camera(const Scene& scene, const ScenePoses& poses, const Camera& camera) {
  if (camera.mount_body.empty()) return camera.mount_from_camera;
  const int body = scene.body_index(camera.mount_body);
  const auto& parts = body < 0 ? poses.world_from_robot_part : poses.world_from_part[static_cast<std::size_t>(body)];
  return parts.at(static_cast<std::size_t>(camera.mount_part)) * camera.mount_from_camera;
}

}  // namespace stampede
