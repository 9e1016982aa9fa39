// A picture such as a renderer gives, by a few rays: an arm of capsules, a table, cubes, a floor. For tests and
// benchmarks of what works on pictures, without a renderer.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/random.h"
#include "engine/model/camera.h"
#include "engine/render/picture.h"

namespace stampede {

class TracedScene {
 public:
  TracedScene() {
    boxes_.push_back({{0.35, 0, 0.7}, {0.4, 0.6, 0.05}, {0.75, 0.6, 0.45}, 12});  // table
    Random random(RandomKey("traced scene"));
    for (int i = 0; i < 10; ++i) {
      const Vector3 centre(random.between(0.1, 0.65), random.between(-0.4, 0.4), 0.77);
      const Vector3 colour(random.uniform(), random.uniform(), random.uniform());
      boxes_.push_back({centre, {0.02, 0.02, 0.02}, colour, 13 + (7 * i) % 10});
    }
    const std::array<Vector3, 8> joints{{{-0.3, 0, 0.75},
                                         {-0.3, 0, 1.08},
                                         {-0.1, 0.02, 1.3},
                                         {0, 0.03, 1.32},
                                         {0.2, 0.05, 1.25},
                                         {0.28, 0.06, 1.2},
                                         {0.28, 0.06, 1.1},
                                         {0.28, 0.1, 1.05}}};
    for (std::size_t i = 0; i + 1 < joints.size(); ++i)
      capsules_.push_back({joints[i], joints[i + 1], 0.07 - 0.006 * static_cast<double>(i), static_cast<int>(i) + 1});
  }

  Picture draw(const View& view) const {
    Picture picture;
    picture.width = view.camera.width;
    picture.height = view.camera.height;
    for (int v = 0; v < picture.height; ++v)
      for (int u = 0; u < picture.width; ++u) pixel(view, u, v, picture);
    return picture;
  }

  // One of five views around the table, numbered from 0.
  static View view(int number, int width = 128, int height = 128) {
    constexpr std::array<std::array<double, 3>, 5> kFrom{
        {{1.35, 0, 1.58}, {0.32, 0.81, 1.79}, {0.32, -0.81, 1.79}, {0.27, 0.01, 1.99}, {0.3, 0.1, 1.1}}};
    const auto& [x, y, z] = kFrom.at(static_cast<std::size_t>(number));
    View view;
    set_field_of_view(view.camera, 1.05, width, height);
    view.world_from_camera = looking_at({x, y, z}, {0.2, 0, 0.9});
    return view;
  }

 private:
  struct Box {
    Vector3 centre, half, colour;
    int id;
  };
  struct Capsule {
    Vector3 a, b;
    double radius;
    int id;
  };
  struct Hit {
    double t = 1e9;
    Vector3 normal{0, 0, 1}, colour{0.5, 0.52, 0.55};
    int id = 0;
  };

  static void hit_box(const Box& box, const Vector3& from, const Vector3& way, Hit& hit) {
    double near = 1e-6, far = hit.t;
    int axis = -1;
    for (int i = 0; i < 3; ++i) {
      const double reach = way[i] > 0 ? box.half[i] : -box.half[i];
      const double in = (box.centre[i] - reach - from[i]) / way[i], out = (box.centre[i] + reach - from[i]) / way[i];
      if (in > near) near = in, axis = i;
      far = std::min(far, out);
    }
    if (axis < 0 || near >= far) return;
    hit = {near, Vector3::Unit(axis) * (way[axis] > 0 ? -1.0 : 1.0), box.colour, box.id};
  }

  static void hit_sphere(const Vector3& centre, const Capsule& capsule, const Vector3& from, const Vector3& way,
                         Hit& hit) {
    const Vector3 o = from - centre;
    const double a = way.squaredNorm(), b = o.dot(way), c = o.squaredNorm() - capsule.radius * capsule.radius;
    const double root = b * b - a * c;
    if (root < 0) return;
    const double t = (-b - std::sqrt(root)) / a;
    if (t > 1e-6 && t < hit.t) hit = {t, (o + t * way).normalized(), {0.92, 0.92, 0.94}, capsule.id};
  }

  static void hit_capsule(const Capsule& capsule, const Vector3& from, const Vector3& way, Hit& hit) {
    const Vector3 axis = (capsule.b - capsule.a).normalized(), o = from - capsule.a;
    const Vector3 d = way - axis * axis.dot(way), p = o - axis * axis.dot(o);
    const double a = d.squaredNorm(), b = d.dot(p), c = p.squaredNorm() - capsule.radius * capsule.radius;
    const double root = b * b - a * c;
    if (a > 1e-12 && root >= 0) {
      const double t = (-b - std::sqrt(root)) / a, along = axis.dot(o + t * way);
      if (t > 1e-6 && t < hit.t && along >= 0 && along <= (capsule.b - capsule.a).norm())
        hit = {t, (p + t * d).normalized(), {0.92, 0.92, 0.94}, capsule.id};
    }
    hit_sphere(capsule.a, capsule, from, way, hit);
    hit_sphere(capsule.b, capsule, from, way, hit);
  }

  void pixel(const View& view, int u, int v, Picture& picture) const {
    const auto direction = direction_of(view.camera, {u + 0.5, v + 0.5});
    const Vector3 from = view.world_from_camera.translation();
    const Vector3 way = view.world_from_camera.linear() * Vector3((*direction)[0], (*direction)[1], 1);  // t is z
    Hit hit;
    if (way.z() < 0) hit.t = -from.z() / way.z(), hit.id = 11;
    for (const Box& box : boxes_) hit_box(box, from, way, hit);
    for (const Capsule& capsule : capsules_) hit_capsule(capsule, from, way, hit);
    const bool seen = hit.t < view.camera.far_m;
    const Vector3 light = Vector3(0.35, -0.3, 1).normalized();
    const double bright = 0.5 + 0.6 * std::max(0.0, hit.normal.dot(light)) +
                          0.15 * std::pow(std::max(0.0, hit.normal.dot((light - way.normalized()).normalized())), 20);
    for (int i = 0; i < 3; ++i)
      picture.rgb.push_back(
          static_cast<std::uint8_t>(std::lround(255 * std::min(1.0, seen ? hit.colour[i] * bright : 0.8))));
    picture.depth.push_back(seen ? static_cast<float>(hit.t) : 0.0F);
    picture.instance.push_back(static_cast<std::uint16_t>(seen ? hit.id : 0));
    picture.semantic.push_back(static_cast<std::uint16_t>(!seen ? 0 : hit.id < 11 ? 1 : hit.id < 13 ? hit.id : 2));
  }

  std::vector<Box> boxes_;
  std::vector<Capsule> capsules_;
};

}  // namespace stampede
