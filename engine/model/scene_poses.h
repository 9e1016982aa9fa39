// Where every part of a scene is at one moment, by kinematics alone.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "engine/model/scene.h"

namespace stampede {

using ShownFacts = std::set<std::vector<std::string>>;  // that hold, of those that shapes are shown by

// What must be known of a moment: the pose of each body's base and the position of each part's joint.
struct SceneState {
  std::vector<Transform> world_from_body;           // per Scene::bodies
  std::vector<std::vector<double>> joint_position;  // per Scene::bodies and part; 0 for parts without a joint
  std::vector<double> robot_position;               // per part of the robot
  std::vector<Transform> world_from_region;         // per Scene::regions; used for those of the world (body empty)
  ShownFacts facts;                                 // none of them holds unless it is said
};

SceneState initial_state(const Scene& scene);

struct ScenePoses {
  std::vector<std::vector<Transform>> world_from_part;  // per Scene::bodies and part
  std::vector<Transform> world_from_robot_part;
  std::vector<Transform> world_from_region;  // centre of the box
  ShownFacts facts;
};

ShownFacts facts_that_show(const Scene& scene);  // which shapes are shown by

// Repeatable: the same doubles, the same poses, whoever simulated them.
ScenePoses scene_poses(const Scene& scene, const SceneState& state);

Transform world_from_camera(const Scene& scene, const ScenePoses& poses, const Camera& camera);

}  // namespace stampede
