#include "engine/record/scene_record.h"

#include <algorithm>

namespace stampede {
namespace {

void add_joints(std::vector<JointName>& joints, const Body& body, int index, const std::vector<int>& driven) {
  const bool joined = !body.joined_to.empty();  // a body of its own, on the joint of another until that lets go of it
  for (std::size_t part = joined ? 0 : 1; part < body.parts.size(); ++part) {
    const Joint& joint = body.parts[part].joint;
    if (joint.kind == JointKind::fixed) continue;
    const std::string own = joint.name.empty() ? body.parts[part].name : joint.name;
    joints.push_back({part == 0 ? body.name : body.name + "." + own,
                      {index, static_cast<int>(part)},
                      joint.kind == JointKind::slider  ? "slider"
                      : joint.kind == JointKind::screw ? "screw"
                                                       : "hinge",
                      joint.kind == JointKind::slider ? "m" : "rad",
                      joint.lower,
                      joint.upper,
                      std::find(driven.begin(), driven.end(), static_cast<int>(part)) != driven.end()});
  }
}

}  // namespace

std::vector<JointName> joints_of(const Scene& scene) {
  std::vector<JointName> joints;
  std::vector<int> driven = scene.robot.arm;
  driven.insert(driven.end(), scene.robot.fingers.begin(), scene.robot.fingers.end());
  add_joints(joints, scene.robot.body, -1, driven);
  for (std::size_t body = 0; body < scene.bodies.size(); ++body)
    add_joints(joints, scene.bodies[body], static_cast<int>(body), {});
  return joints;
}

void describe_scene(const Scene& scene, EpisodeRecord& record) {
  record.world = scene.world;
  record.physics_hz = scene.physics_hz;
  record.frame_hz = scene.frame_hz;
  record.scene.document = scene_to_document(scene);
  record.scene.objects = scene.objects;
  record.scene.cameras = scene.cameras;
  record.scene.masks = mask_key(scene);
  record.scene.hands = {scene.robot.name + "." + scene.robot.hand};
}

}  // namespace stampede
