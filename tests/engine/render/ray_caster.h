// What a renderer should see, by one exact ray through each pixel's centre. Slow, and knows nothing of triangles.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "engine/geometry/hull.h"
#include "engine/model/camera.h"
#include "engine/model/masks.h"
#include "engine/model/scene_poses.h"
#include "engine/render/picture.h"

namespace stampede {

// The stretch of a ray inside a convex solid: from + t * way, t in [in, out].
struct Stretch {
  double in = -std::numeric_limits<double>::infinity(), out = std::numeric_limits<double>::infinity();
  bool empty() const { return !(in < out); }
  void halfspace(double at_start, double slope) {  // where at_start + t * slope <= 0
    if (slope == 0) {
      if (at_start > 0) out = in;
    } else if (slope > 0) {
      out = std::min(out, -at_start / slope);
    } else {
      in = std::max(in, -at_start / slope);
    }
  }
  void quadric(double a, double b, double c) {  // where a t^2 + 2 b t + c <= 0, a > 0
    const double root = b * b - a * c;
    if (root <= 0) {
      out = in;
      return;
    }
    in = std::max(in, (-b - std::sqrt(root)) / a);
    out = std::min(out, (-b + std::sqrt(root)) / a);
  }
};

class RayCaster {
 public:
  RayCaster(const Scene& scene, const ScenePoses& poses) {
    std::vector<int> semantic(65536);
    for (const MaskEntry& entry : mask_key(scene)) semantic[static_cast<std::size_t>(entry.instance)] = entry.semantic;
    const auto add = [&](const Body& body, const std::vector<Transform>& world_from_part) {
      for (std::size_t i = 0; i < body.parts.size(); ++i)
        for (const Shape& shape : body.parts[i].shapes)
          if (shape.visible) add_shape(shape, world_from_part[i], body.parts[i].instance, semantic);
    };
    add(scene.robot.body, poses.world_from_robot_part);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) add(scene.bodies[i], poses.world_from_part[i]);
  }

  // Depth and ids; no colours.
  Picture draw(const View& view) const {
    Picture picture;
    picture.width = view.camera.width;
    picture.height = view.camera.height;
    for (int v = 0; v < picture.height; ++v)
      for (int u = 0; u < picture.width; ++u) {
        const auto direction = direction_of(view.camera, {u + 0.5, v + 0.5});
        const Vector3 way = view.world_from_camera.linear() * Vector3((*direction)[0], (*direction)[1], 1);
        const Solid* hit = nullptr;
        double depth = view.camera.far_m;
        for (const Solid& solid : solids_) {
          const double t = entry(solid, view.world_from_camera.translation(), way);
          if (t >= view.camera.near_m && t < depth) depth = t, hit = &solid;
        }
        picture.depth.push_back(hit == nullptr ? 0.0F : static_cast<float>(depth));
        picture.instance.push_back(static_cast<std::uint16_t>(hit == nullptr ? 0 : hit->instance));
        picture.semantic.push_back(static_cast<std::uint16_t>(hit == nullptr ? 0 : hit->semantic));
      }
    return picture;
  }

 private:
  struct Solid {
    Shape shape;
    Transform shape_from_world;
    std::vector<std::array<double, 4>> planes;  // hull: outward normal and offset
    int instance, semantic;
  };

  void add_shape(const Shape& shape, const Transform& world_from_part, int instance, const std::vector<int>& semantic) {
    Solid solid{shape,
                (world_from_part * shape.part_from_shape).inverse(),
                {},
                instance,
                semantic[static_cast<std::size_t>(instance)]};
    if (shape.kind == ShapeKind::hull) {
      const Hull hull = *convex_hull(shape.points);
      for (const auto& [a, b, c] : hull.triangles) {
        const auto at = [&](int i) { return hull.points[static_cast<std::size_t>(i)]; };
        const Vector3 normal = (at(b) - at(a)).cross(at(c) - at(a));
        if (normal.norm() > 1e-14) solid.planes.push_back({normal.x(), normal.y(), normal.z(), -normal.dot(at(a))});
      }
    }
    solids_.push_back(std::move(solid));
  }

  static Stretch ball(const Vector3& from, const Vector3& way, double radius) {
    Stretch stretch;
    stretch.quadric(way.squaredNorm(), from.dot(way), from.squaredNorm() - radius * radius);
    return stretch;
  }

  static Stretch pillar(const Vector3& from, const Vector3& way, double radius, double length) {
    Stretch stretch;
    const double a = way.head<2>().squaredNorm();
    if (a > 0)
      stretch.quadric(a, from.head<2>().dot(way.head<2>()), from.head<2>().squaredNorm() - radius * radius);
    else if (from.head<2>().norm() > radius)
      return {0, 0};
    stretch.halfspace(from.z() - length / 2, way.z());
    stretch.halfspace(-from.z() - length / 2, -way.z());
    return stretch;
  }

  // Where the ray enters; infinity where it does not.
  static double entry(const Solid& solid, const Vector3& world_from, const Vector3& world_way) {
    const Vector3 from = solid.shape_from_world * world_from, way = solid.shape_from_world.linear() * world_way;
    const Shape& shape = solid.shape;
    Stretch stretch;
    switch (shape.kind) {
      case ShapeKind::box:
        for (int i = 0; i < 3; ++i) {
          stretch.halfspace(from[i] - shape.size[i] / 2, way[i]);
          stretch.halfspace(-from[i] - shape.size[i] / 2, -way[i]);
        }
        break;
      case ShapeKind::sphere:
        stretch = ball(from, way, shape.radius);
        break;
      case ShapeKind::cylinder:
        stretch = pillar(from, way, shape.radius, shape.length);
        break;
      case ShapeKind::capsule: {
        double first = std::numeric_limits<double>::infinity();
        const Vector3 up(0, 0, shape.length / 2);
        for (const Stretch& part : {pillar(from, way, shape.radius, shape.length), ball(from - up, way, shape.radius),
                                    ball(from + up, way, shape.radius)})
          if (!part.empty()) first = std::min(first, part.in);
        return first;
      }
      case ShapeKind::cone:
        return cone_entry(shape, from, way);
      case ShapeKind::hull:
        for (const auto& [x, y, z, d] : solid.planes)
          stretch.halfspace(Vector3(x, y, z).dot(from) + d, Vector3(x, y, z).dot(way));
        break;
      case ShapeKind::mesh:
        return std::numeric_limits<double>::infinity();
    }
    return stretch.empty() ? std::numeric_limits<double>::infinity() : stretch.in;
  }

  // Apex up: x^2 + y^2 <= k^2 (top - z)^2 between bottom and top. Its first point is on the base or on the side.
  static double cone_entry(const Shape& shape, const Vector3& from, const Vector3& way) {
    const double k = shape.radius / shape.length, top = shape.length / 2;
    std::vector<double> candidates{(-top - from.z()) / way.z()};
    const double h = top - from.z();
    const double a = way.head<2>().squaredNorm() - k * k * way.z() * way.z();
    const double b = from.head<2>().dot(way.head<2>()) + k * k * h * way.z();
    const double c = from.head<2>().squaredNorm() - k * k * h * h;
    const double root = b * b - a * c;
    if (root >= 0 && a != 0)
      for (const double sign : {-1.0, 1.0}) candidates.push_back((-b + sign * std::sqrt(root)) / a);
    double first = std::numeric_limits<double>::infinity();
    for (const double t : candidates) {
      const Vector3 at = from + t * way;
      const double room = k * (top - at.z()) + 1e-9;
      if (at.z() > -top - 1e-9 && at.z() < top + 1e-9 && at.head<2>().norm() <= room) first = std::min(first, t);
    }
    return first;
  }

  std::vector<Solid> solids_;
};

}  // namespace stampede
