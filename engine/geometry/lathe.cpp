#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "engine/geometry/smooth.h"

namespace stampede {
namespace {

using Point = std::array<double, 2>;  // radius, z; or a direction in that plane

void check(const std::vector<Point>& profile, int sides) {
  if (sides < 3) throw Error("lathe", "it needs at least 3 sides", "24 look round");
  if (profile.size() < 2) throw Error("lathe", "its profile needs at least 2 points", "give { radius, z } pairs");
  for (const auto& [radius, z] : profile)
    if (!std::isfinite(radius) || !std::isfinite(z) || radius < 0)
      throw Error("lathe", "its profile needs finite numbers, and radii that are not negative",
                  "give { radius, z } pairs in m");
}

// Encloses volume on its left, with its ends on the axis unless they meet each other; no point twice in a row.
std::vector<Point> closed_profile(const std::vector<Point>& profile) {
  std::vector<Point> points;
  const auto add = [&](const Point& point) {
    if (points.empty() || points.back() != point) points.push_back(point);
  };
  const bool ring = profile.front() == profile.back();
  if (!ring) add({0, profile.front()[1]});
  for (const Point& point : profile) add(point);
  if (!ring) add({0, profile.back()[1]});
  double volume = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto [r, z] = points[i];
    const auto [next_r, next_z] = points[i + 1];
    volume += (next_z - z) * (r * r + r * next_r + next_r * next_r);
  }
  if (volume < 0) std::reverse(points.begin(), points.end());
  return points;
}

Point normalised(const Point& direction) {
  const double length = std::hypot(direction[0], direction[1]);
  return {direction[0] / length, direction[1] / length};
}

// Outwards: to the right of the way along the profile.
Point normal_of(const Point& from, const Point& to) { return normalised({to[1] - from[1], from[0] - to[0]}); }

double cosine(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1]; }

// Of a face with normal `own` at its end `at`, next to a face with normal `next`.
Point shaded(const Point& at, const Point& own, const Point& next) {
  const Point beyond = at[0] == 0 ? Point{-own[0], own[1]} : next;  // on the axis the face meets its mirror image
  return cosine(own, beyond) > kSmooth ? normalised({own[0] + beyond[0], own[1] + beyond[1]}) : own;
}

class Lathe {
 public:
  explicit Lathe(int sides) : sides_(static_cast<std::uint32_t>(sides)) {}

  // One band between two points of the profile, with the normals at its ends.
  void band(const Point& from, const Point& from_normal, const Point& to, const Point& to_normal) {
    const std::uint32_t low = ring(from, from_normal), high = ring(to, to_normal);
    for (std::uint32_t i = 0; i < sides_; ++i) {
      const std::uint32_t next = (i + 1) % sides_;
      if (from[0] > 0) mesh_.triangles.push_back({low + i, low + next, high + i});
      if (to[0] > 0) mesh_.triangles.push_back({low + next, high + next, high + i});
    }
  }
  DrawnMesh take() { return std::move(mesh_); }

 private:
  // A band that starts as the last one ended goes on from its corners.
  std::uint32_t ring(const Point& at, const Point& normal) {
    const auto count = static_cast<std::uint32_t>(mesh_.positions.size());
    if (count > 0 && at == last_at_ && normal == last_normal_) return count - sides_;
    last_at_ = at;
    last_normal_ = normal;
    for (std::uint32_t i = 0; i < sides_; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides_, x = std::cos(angle), y = std::sin(angle);
      const auto turned = [&](const Point& p) {
        return std::array{static_cast<float>(p[0] * x), static_cast<float>(p[0] * y), static_cast<float>(p[1])};
      };
      mesh_.positions.push_back(turned(at));
      mesh_.normals.push_back(turned(normal));
    }
    return count;
  }

  DrawnMesh mesh_;
  std::uint32_t sides_;
  Point last_at_{}, last_normal_{};
};

}  // namespace

DrawnMesh lathe_mesh(const std::vector<std::array<double, 2>>& profile, int sides) {
  check(profile, sides);
  const std::vector<Point> points = closed_profile(profile);
  const std::size_t bands = points.size() - 1;
  if (points.size() < 2) throw Error("lathe", "all points of its profile are one", "give it a length");
  std::vector<Point> normals;
  for (std::size_t i = 0; i < bands; ++i) normals.push_back(normal_of(points[i], points[i + 1]));
  Lathe lathe(sides);
  const bool ring = points.front() == points.back();
  for (std::size_t i = 0; i < bands; ++i) {
    if (points[i][0] == 0 && points[i + 1][0] == 0) continue;  // along the axis: nothing to see
    const Point& before = i > 0 ? normals[i - 1] : ring ? normals.back() : normals[i];
    const Point& after = i + 1 < bands ? normals[i + 1] : ring ? normals.front() : normals[i];
    lathe.band(points[i], shaded(points[i], normals[i], before), points[i + 1],
               shaded(points[i + 1], normals[i], after));
  }
  DrawnMesh mesh = lathe.take();
  if (mesh.triangles.empty()) throw Error("lathe", "its profile lies on the axis", "give it a radius above 0");
  return mesh;
}

}  // namespace stampede
