#include "engine/sim/convex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stampede {
namespace {

constexpr int kMostIterations = 64;
constexpr double kNoProgress = 1e-10;  // relative
constexpr double kTouching = 1e-18;    // m^2

// Up to four points of the difference of two shapes, and the point of their hull nearest to the origin.
struct Simplex {
  std::array<Vector3, 4> points;
  int size = 0;
  bool encloses = false;
};

Vector3 reduce_to(Simplex& s, std::initializer_list<Vector3> kept, const Vector3& nearest) {
  s.size = 0;
  for (const Vector3& point : kept) s.points[static_cast<std::size_t>(s.size++)] = point;
  return nearest;
}

Vector3 nearest_on_segment(Simplex& s, const Vector3& a, const Vector3& b) {
  const Vector3 ab = b - a;
  const double t = -a.dot(ab), length = ab.squaredNorm();
  if (t <= 0 || length <= 0) return reduce_to(s, {a}, a);
  if (t >= length) return reduce_to(s, {b}, b);
  return reduce_to(s, {a, b}, a + ab * (t / length));
}

// Voronoi regions of a triangle (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
Vector3 nearest_on_triangle(Simplex& s, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a, ac = c - a;
  const double d1 = -ab.dot(a), d2 = -ac.dot(a);
  if (d1 <= 0 && d2 <= 0) return reduce_to(s, {a}, a);
  const double d3 = -ab.dot(b), d4 = -ac.dot(b);
  if (d3 >= 0 && d4 <= d3) return reduce_to(s, {b}, b);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return reduce_to(s, {a, b}, a + ab * (d1 / (d1 - d3)));
  const double d5 = -ab.dot(c), d6 = -ac.dot(c);
  if (d6 >= 0 && d5 <= d6) return reduce_to(s, {c}, c);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return reduce_to(s, {a, c}, a + ac * (d2 / (d2 - d6)));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return reduce_to(s, {b, c}, b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  const double sum = va + vb + vc;
  if (!(sum > 0)) return nearest_on_segment(s, a, b);  // no area
  return reduce_to(s, {a, b, c}, a + ab * (vb / sum) + ac * (vc / sum));
}

Vector3 nearest_on_tetrahedron(Simplex& s) {
  const std::array<Vector3, 4> p = s.points;
  constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};  // corners, then the other
  double best = std::numeric_limits<double>::infinity();
  Vector3 nearest = Vector3::Zero();
  Simplex chosen;
  for (const auto& face : kFaces) {
    const Vector3 &a = p[static_cast<std::size_t>(face[0])], &b = p[static_cast<std::size_t>(face[1])],
                  &c = p[static_cast<std::size_t>(face[2])], &other = p[static_cast<std::size_t>(face[3])];
    const Vector3 normal = (b - a).cross(c - a);
    const double side = (other - a).dot(normal), origin_side = -a.dot(normal);
    if (side * origin_side > 0) continue;  // the origin is on the inner side; a flat one tests all faces
    Simplex candidate;
    const Vector3 point = nearest_on_triangle(candidate, a, b, c);
    if (point.squaredNorm() >= best) continue;
    best = point.squaredNorm();
    nearest = point;
    chosen = candidate;
  }
  if (chosen.size == 0) {
    s.encloses = true;
    return Vector3::Zero();
  }
  s = chosen;
  return nearest;
}

Vector3 nearest_to_origin(Simplex& s) {
  const std::array<Vector3, 4> p = s.points;
  switch (s.size) {
    case 1:
      return p[0];
    case 2:
      return nearest_on_segment(s, p[0], p[1]);
    case 3:
      return nearest_on_triangle(s, p[0], p[1], p[2]);
    default:
      return nearest_on_tetrahedron(s);
  }
}

double sign(double x) { return x < 0 ? -1.0 : 1.0; }

}  // namespace

Convex::Convex(const Shape& shape) : kind(shape.kind) {
  switch (kind) {
    case ShapeKind::box:
      half = box_half = shape.size / 2;
      break;
    case ShapeKind::sphere:
      rounding = shape.radius;
      box_half.setConstant(shape.radius);
      break;
    case ShapeKind::capsule:
      rounding = shape.radius;
      half_length = shape.length / 2;
      box_half = {shape.radius, shape.radius, half_length + shape.radius};
      break;
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      radius = shape.radius;
      half_length = shape.length / 2;
      box_half = {radius, radius, half_length};
      break;
    case ShapeKind::hull: {
      points = shape.points;
      Vector3 lower = points.front(), upper = points.front();
      for (const Vector3& point : points) {
        lower = lower.cwiseMin(point);
        upper = upper.cwiseMax(point);
      }
      box_centre = (lower + upper) / 2;
      box_half = (upper - lower) / 2;
      break;
    }
    case ShapeKind::mesh:
      break;  // drawn only
  }
}

Vector3 Convex::support(const Vector3& d) const {
  switch (kind) {
    case ShapeKind::box:
      return {sign(d.x()) * half.x(), sign(d.y()) * half.y(), sign(d.z()) * half.z()};
    case ShapeKind::sphere:
      return Vector3::Zero();
    case ShapeKind::capsule:
      return {0, 0, sign(d.z()) * half_length};
    case ShapeKind::cylinder: {
      const double across = std::sqrt(d.x() * d.x() + d.y() * d.y());
      const double scale = across > 0 ? radius / across : 0;
      return {scale * d.x(), scale * d.y(), sign(d.z()) * half_length};
    }
    case ShapeKind::cone: {
      const double across = std::sqrt(d.x() * d.x() + d.y() * d.y());
      if (d.z() * 2 * half_length > across * radius) return {0, 0, half_length};
      const double scale = across > 0 ? radius / across : 0;
      return {scale * d.x(), scale * d.y(), -half_length};
    }
    case ShapeKind::hull:
    case ShapeKind::mesh:
      break;
  }
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double along = points[i].dot(d);
    if (along > most) {
      most = along;
      best = i;
    }
  }
  return points[best];
}

bool closer_than(const Convex& a, const Transform& world_from_a, const Convex& b, const Transform& world_from_b,
                 double distance) {
  const Matrix3 turn = world_from_a.linear().transpose() * world_from_b.linear();  // a from b
  const Vector3 shift = world_from_a.linear().transpose() * (world_from_b.translation() - world_from_a.translation());
  const double margin = std::max(0.0, distance + a.rounding + b.rounding);
  const auto support = [&](const Vector3& d) -> Vector3 {
    return a.support(d) - (turn * b.support(-(turn.transpose() * d)) + shift);
  };
  Simplex simplex;
  Vector3 v = a.box_centre - (turn * b.box_centre + shift);
  if (v.squaredNorm() < kTouching) v = Vector3::UnitX();
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const Vector3 w = support(-v);
    const double squared = v.squaredNorm(), along = v.dot(w);
    if (along > 0 && along * along > margin * margin * squared) return false;  // a plane keeps them apart
    if (simplex.size > 0 && squared - along <= kNoProgress * squared) return squared <= margin * margin;
    simplex.points[static_cast<std::size_t>(simplex.size++)] = w;
    v = nearest_to_origin(simplex);
    if (simplex.encloses || v.squaredNorm() <= std::max(kTouching, margin * margin)) return true;
  }
  return true;  // undecided within rounding: call it contact
}

}  // namespace stampede
