// The scene that render's tests and benchmark look at: Panda, table, cubes, and the five cameras of the standard world.
#pragma once

#include <memory>
#include <numbers>
#include <vector>

#include "engine/model/camera.h"
#include "engine/model/masks.h"
#include "engine/model/scene_poses.h"
#include "engine/render/picture.h"
#include "tests/support/panda.h"

namespace stampede {

inline Camera camera_at(const std::string& name, const Vector3& from, const Vector3& to, double fov_deg, int size) {
  Camera camera;
  camera.name = name;
  set_field_of_view(camera, fov_deg * std::numbers::pi / 180, size, size);
  camera.mount_from_camera = looking_at(from, to);
  return camera;
}

// Their places in the standard world, whose robot stands at (-0.30, 0, 0.75): here it stands at the origin.
inline void add_five_cameras(Scene& scene, int size) {
  const Vector3 robot(-0.30, 0, 0.75), table(0.25, 0, 0.80);
  const auto fixed = [&](const char* name, const Vector3& from) {
    scene.cameras.push_back(camera_at(name, from - robot, table - robot, 40, size));
  };
  fixed("front", {1.35, 0, 1.58});
  fixed("left_shoulder", {-0.175, 0.2, 1.98});
  fixed("overhead", {-0.175, 0, 2.43});
  fixed("right_shoulder", {-0.175, -0.2, 1.98});
  Camera wrist = camera_at("wrist", {0.07, 0, 0.04}, {0.02, 0, 0.3}, 60, size);
  wrist.mount_body = scene.robot.name;
  wrist.mount_part = scene.robot.body.part_index("hand");
  scene.cameras.push_back(wrist);
}

// Cubes of many colours, numbered for masks.
inline Scene scene_with_five_cameras(int cubes, int size = 128) {
  Scene scene = table_scene(cubes);
  const std::vector<Colour> colours{{0.85, 0.15, 0.15, 1}, {0.2, 0.65, 0.25, 1}, {0.15, 0.3, 0.85, 1},
                                    {0.95, 0.8, 0.15, 1},  {0.6, 0.2, 0.7, 1},   {0.95, 0.5, 0.1, 1}};
  for (std::size_t i = 1; i < scene.bodies.size(); ++i)
    scene.bodies[i].parts[0].shapes[0].colour = colours[i % colours.size()];
  scene.bodies[0].fixture = true;
  add_five_cameras(scene, size);
  number_masks(scene, RandomKey("render test"));
  return scene;
}

inline std::vector<View> views_of(const Scene& scene, const ScenePoses& poses) {
  std::vector<View> views;
  for (const Camera& camera : scene.cameras) views.push_back({camera, world_from_camera(scene, poses, camera)});
  return views;
}

}  // namespace stampede
