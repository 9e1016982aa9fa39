// One of every shape on a floor, and a camera that sees them.
#pragma once

#include <memory>

#include "engine/render/renderer.h"
#include "tests/engine/render/five_cameras.h"

namespace stampede {

inline Body free_body(const std::string& name, const Shape& shape, const Transform& world_from_body) {
  Body body;
  body.name = name;
  body.free = true;
  body.world_from_body = world_from_body;
  body.parts.resize(1);
  body.parts[0].name = name;
  body.parts[0].shapes.push_back(shape);
  return body;
}

inline Shape shape_of(ShapeKind kind, double radius, double length, const Colour& colour = {}) {
  Shape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.length = length;
  shape.colour = colour;
  return shape;
}

inline Shape box_of(const Vector3& size, const Colour& colour = {}) {
  Shape shape;
  shape.size = size;
  shape.colour = colour;
  return shape;
}

// No robot. Bodies: box capsule cone cylinder floor hull sphere.
inline Scene all_shapes() {
  Scene scene;
  scene.world = "shapes";
  const auto at = [](double x, double y, double z) { return translation(x, y, z) * rotation_rpy(0.4, 0.3, 0.7); };
  Shape hull;
  hull.kind = ShapeKind::hull;
  hull.colour = {0.3, 0.7, 0.7, 1};
  for (int i = 0; i < 5; ++i) {  // a pentagon below, a triangle above
    const double angle = 2 * std::numbers::pi * i / 5;
    hull.points.push_back({0.08 * std::cos(angle), 0.08 * std::sin(angle), -0.05});
    if (i < 3) hull.points.push_back({0.04 * std::cos(angle), 0.04 * std::sin(angle), 0.07});
  }
  scene.bodies.push_back(free_body("box", box_of({0.1, 0.15, 0.2}, {0.8, 0.2, 0.2, 1}), at(-0.25, -0.2, 0.2)));
  scene.bodies.push_back(
      free_body("capsule", shape_of(ShapeKind::capsule, 0.04, 0.12, {0.2, 0.7, 0.2, 1}), at(0, -0.2, 0.2)));
  scene.bodies.push_back(
      free_body("cone", shape_of(ShapeKind::cone, 0.08, 0.2, {0.9, 0.8, 0.2, 1}), at(0.25, -0.2, 0.2)));
  scene.bodies.push_back(
      free_body("cylinder", shape_of(ShapeKind::cylinder, 0.06, 0.2, {0.2, 0.3, 0.8, 1}), at(-0.25, 0.2, 0.2)));
  scene.bodies.push_back(free_body("floor", box_of({2, 2, 0.02}, {0.6, 0.6, 0.6, 1}), translation(0, 0, -0.01)));
  scene.bodies.push_back(free_body("hull", hull, at(0, 0.2, 0.2)));
  scene.bodies.push_back(
      free_body("sphere", shape_of(ShapeKind::sphere, 0.09, 0, {0.8, 0.4, 0.8, 1}), at(0.25, 0.2, 0.2)));
  number_masks(scene, RandomKey("all shapes"));
  return scene;
}

inline View view_from(const Vector3& from, const Vector3& to, double fov_deg, int width, int height) {
  View view;
  view.camera = camera_at("eye", from, to, fov_deg, 16);
  set_field_of_view(view.camera, fov_deg * std::numbers::pi / 180, width, height);
  view.world_from_camera = view.camera.mount_from_camera;
  return view;
}

inline View view_of_shapes(int width = 200, int height = 150) {
  return view_from({0.1, -1.0, 0.8}, {0, 0, 0.15}, 45, width, height);
}

// A renderer with a scene loaded, and its poses at the start.
struct Studio {
  explicit Studio(Scene scene_)
      : scene(std::make_shared<Scene>(std::move(scene_))),
        poses(scene_poses(*scene, initial_state(*scene))),
        renderer(make_renderer()) {
    renderer->load(scene);
  }
  std::vector<Picture> draw(const std::vector<View>& views, const DrawOptions& options = {}) {
    std::vector<Picture> pictures;
    renderer->draw(poses, views, options, pictures);
    return pictures;
  }
  Picture draw(const View& view, const DrawOptions& options = {}) { return draw(std::vector{view}, options).at(0); }

  std::shared_ptr<const Scene> scene;
  ScenePoses poses;
  std::unique_ptr<Renderer> renderer;
};

}  // namespace stampede
