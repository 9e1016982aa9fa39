#include "scripting/commands/object_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/geometry/corners.h"
#include "engine/model/camera.h"
#include "engine/render/renderer.h"
#include "scripting/commands/render_output.h"
#include "scripting/runtime/object_scene.h"

namespace stampede::program {
namespace {

constexpr int kSide = 176, kGap = 10, kLetters = 12, kCaption = 3 * (kLetters + 4) + 6;
constexpr std::array<std::uint8_t, 3> kPaper{250, 250, 248}, kInk{30, 32, 36}, kFaint{110, 114, 120};

struct Bounds {
  Vector3 lower = Vector3::Constant(1e9), upper = Vector3::Constant(-1e9);
  void add(const Vector3& point) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  void add(const Transform& pose, const Vector3& low, const Vector3& high) {
    for (const Vector3& corner : box_corners(low, high)) add(pose * corner);
  }
};

Bounds bounds_of(const Scene& scene, const ScenePoses& poses) {
  Bounds bounds;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    for (std::size_t p = 0; p < scene.bodies[b].parts.size(); ++p) {
      const Part& part = scene.bodies[b].parts[p];
      if (part.shapes.empty()) continue;
      const auto [low, high] = bounding_box(part);
      bounds.add(poses.world_from_part[b][p], low, high);
    }
  const bool empty = bounds.lower.x() > bounds.upper.x();  // a region and nothing else: its place, seen or not
  for (std::size_t i = 0; i < scene.regions.size(); ++i)
    if (scene.regions[i].visible || empty)
      bounds.add(poses.world_from_region[i], -scene.regions[i].size / 2, scene.regions[i].size / 2);
  return bounds;
}

double mass_of(const Scene& scene) {
  double mass = 0;
  for (const Body& body : scene.bodies)
    for (const Part& part : body.parts) mass += part.mass;
  return mass;
}

// From the front right, above; so far away that a ball around it fits.
View view_of(const Bounds& bounds) {
  constexpr double kField = 0.5;  // rad
  const Vector3 centre = (bounds.lower + bounds.upper) / 2;
  const double radius = std::max(0.01, (bounds.upper - bounds.lower).norm() / 2);
  const double distance = 1.02 * radius / std::sin(kField / 2);
  View view;
  set_field_of_view(view.camera, kField, kSide, kSide);
  view.camera.near_m = distance / 20;
  view.camera.far_m = distance * 4;
  view.world_from_camera = looking_at(centre + distance * Vector3(-0.68, -0.48, 0.55).normalized(), centre);
  return view;
}

Picture portrait(Renderer& renderer, Scene& scene, const Bounds& bounds) {
  const ScenePoses poses = scene_poses(scene, initial_state(scene));
  scene.light.direction = {0.55, 0.1, -1};  // over the viewer's shoulder
  renderer.load(std::make_shared<const Scene>(scene));
  DrawOptions options;
  options.kinds = {true, false, false, false};
  options.shadows = true;
  options.samples = 3;
  std::vector<Picture> pictures;
  const View view = view_of(bounds);
  renderer.draw(poses, {&view, 1}, options, pictures);
  return std::move(pictures.front());
}

}  // namespace

void draw_objects(std::shared_ptr<const Library> library, const std::vector<std::string>& names,
                  const std::filesystem::path& file, const OutputRules& rules) {
  const auto renderer = make_renderer();
  const int count = static_cast<int>(names.size());
  const int square = static_cast<int>(std::ceil(std::sqrt(1.4 * count)));  // about
  const int columns = std::min(count, std::max(7, square));
  const int rows = (count + columns - 1) / columns;
  Canvas canvas(columns * (kSide + kGap) + kGap, rows * (kSide + kCaption + kGap) + kGap, kPaper);
  for (std::size_t i = 0; i < names.size(); ++i) {
    Scene scene = object_scene(library, names[i]);
    const Bounds bounds = bounds_of(scene, scene_poses(scene, initial_state(scene)));
    const int x = kGap + static_cast<int>(i) % columns * (kSide + kGap);
    const int y = kGap + static_cast<int>(i) / columns * (kSide + kCaption + kGap);
    canvas.put(x, y, portrait(*renderer, scene, bounds));
    canvas.text(x, y + kSide + kLetters + 4, names[i], kLetters + 2, kInk);
    const Vector3 size = 100 * (bounds.upper - bounds.lower);
    const double mass = mass_of(scene);
    const std::string facts = fmt::format("{:.3g} × {:.3g} × {:.3g} cm", size.x(), size.y(), size.z());
    canvas.text(x, y + kSide + 2 * (kLetters + 4) + 2, facts, kLetters, kFaint);
    if (mass > 0)
      canvas.text(x, y + kSide + 3 * (kLetters + 4) + 2,
                  mass < 1 ? fmt::format("{:.3g} g", 1000 * mass) : fmt::format("{:.3g} kg", mass), kLetters, kFaint);
  }
  std::vector<Canvas> page;
  page.push_back(std::move(canvas));
  write_sheet(file, page, rules);
}

}  // namespace stampede::program
