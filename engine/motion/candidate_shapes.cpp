#include "engine/motion/candidate_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/geometry/hull.h"

namespace stampede {
namespace {

constexpr double kSpare_m = 0.006;  // between the open fingers and the object, both sides together

Vector3 axis(int i) { return Vector3::Unit(i); }

// A tip at `origin` looking along `into`, closing along `closing` (perpendicular unit vectors), shape's frame.
Transform tip_frame(const Vector3& origin, const Vector3& into, const Vector3& closing) {
  Transform tip = Transform::Identity();
  tip.linear().col(1) = closing;
  tip.linear().col(2) = into;
  tip.linear().col(0) = closing.cross(into);
  tip.translation() = origin;
  return tip;
}

class Collector {
 public:
  Collector(const Shape& shape, double opening_m, double depth_m)
      : shape_(shape), opening_m_(opening_m), depth_m_(depth_m) {}
  // `middle`: between both contacts. The tip goes there, or as deep as the palm allows. Both yaws are taken.
  void add(const Vector3& middle, const Vector3& into, const Vector3& closing, double width, double off_centre) {
    if (width > opening_m_ - kSpare_m) return;
    const double depth = middle.dot(into) + reach(shape_, -into);
    const Vector3 origin = middle - std::max(0.0, depth - depth_m_) * into;
    for (const double side : {1.0, -1.0})
      found_.push_back({shape_.part_from_shape * tip_frame(origin, into, side * closing), width, off_centre});
  }
  std::vector<ShapeGrasp> take() { return std::move(found_); }

 private:
  const Shape& shape_;
  double opening_m_, depth_m_;
  std::vector<ShapeGrasp> found_;
};

void box_grasps(const Shape& shape, Random& random, Collector& out) {
  for (int closing = 0; closing < 3; ++closing) {
    for (int into = 0; into < 3; ++into) {
      if (into == closing) continue;
      const int along = 3 - closing - into;
      const double slack = std::max(0.0, 0.5 * shape.size[along] - 0.012);
      for (const double sign : {1.0, -1.0}) {
        out.add(Vector3::Zero(), sign * axis(into), axis(closing), shape.size[closing], 0);
        if (slack < 0.005) continue;
        const double offset = random.between(-slack, slack);
        out.add(offset * axis(along), sign * axis(into), axis(closing), shape.size[closing], std::abs(offset));
      }
    }
  }
}

// One draw after the other: compilers choose the order in which they make the arguments of a call.
Vector3 drawn_direction(Random& random) {
  const double z = random.normal(), y = random.normal(), x = random.normal();
  return {x, y, z};
}

void sphere_grasps(const Shape& shape, Random& random, Collector& out) {
  constexpr int kDraws = 24;
  for (int k = 0; k < kDraws; ++k) {
    Vector3 into = drawn_direction(random), across = drawn_direction(random);
    // The first ones look along the axes, so that one of them comes from straight above a sphere at rest.
    if (k < 6) into = (k % 2 == 0 ? 1.0 : -1.0) * axis(k / 2);
    across -= across.dot(into) / into.squaredNorm() * into;
    if (into.norm() < 1e-3 || across.norm() < 1e-3) continue;
    out.add(Vector3::Zero(), into.normalized(), across.normalized(), 2 * shape.radius, 0);
  }
}

void round_grasps(const Shape& shape, Random& random, Collector& out) {
  constexpr int kDraws = 12;
  const double slack = std::max(0.0, 0.5 * shape.length - 0.012);
  const double narrow = shape.kind == ShapeKind::cone ? 0.5 : 1.0;  // a cone is taken at half its height
  for (int k = 0; k < kDraws; ++k) {
    const double yaw = 2 * std::numbers::pi * (k + random.uniform()) / kDraws;
    const Vector3 radial(std::cos(yaw), std::sin(yaw), 0), across(-std::sin(yaw), std::cos(yaw), 0);
    const double width = 2 * shape.radius * narrow;
    for (const double sign : {1.0, -1.0}) out.add(Vector3::Zero(), sign * axis(2), radial, width, 0);
    out.add(Vector3::Zero(), radial, across, width, 0);
    if (shape.kind == ShapeKind::cone) continue;
    const double offset = random.between(-slack, slack);
    if (slack > 0.005) out.add(offset * axis(2), radial, across, width, std::abs(offset));
    if (shape.kind == ShapeKind::cylinder) out.add(Vector3::Zero(), radial, axis(2), shape.length, 0);
  }
}

struct Facet {
  Vector3 normal, centre;
  double area;
};

// Triangles of one plane are one facet.
std::vector<Facet> facets(const Hull& hull) {
  std::vector<Facet> all;
  for (const auto& triangle : hull.triangles) {
    const auto corner = [&](std::size_t i) { return hull.points[static_cast<std::size_t>(triangle[i])]; };
    const Vector3 cross = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    const double area = 0.5 * cross.norm();
    if (area < 1e-10) continue;
    const Facet facet{cross.normalized(), (corner(0) + corner(1) + corner(2)) / 3, area};
    const auto same = std::find_if(all.begin(), all.end(), [&](const Facet& other) {
      return other.normal.dot(facet.normal) > 0.9998 && std::abs(other.normal.dot(facet.centre - other.centre)) < 1e-4;
    });
    if (same == all.end()) {
      all.push_back(facet);
    } else {
      same->centre = (same->area * same->centre + area * facet.centre) / (same->area + area);
      same->area += area;
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Facet& a, const Facet& b) { return a.area > b.area; });
  return all;
}

void hull_grasps(const Shape& shape, Random& random, Collector& out) {
  constexpr std::size_t kFacets = 24;
  constexpr int kTurns = 8;
  constexpr double kOpposed = -0.985;  // 10 degrees
  const std::optional<Hull> hull = convex_hull(shape.points);
  if (!hull) return;
  const Vector3 centre = mass_properties(*hull).centre;
  std::vector<Facet> all = facets(*hull);
  if (all.size() > kFacets) all.resize(kFacets);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      if (all[i].normal.dot(all[j].normal) > kOpposed) continue;
      const Vector3 closing = (all[j].normal - all[i].normal).normalized();
      const double width = std::abs((all[j].centre - all[i].centre).dot(closing));
      const Vector3 middle = 0.5 * (all[i].centre + all[j].centre);
      const Vector3 side = closing.unitOrthogonal(), other = closing.cross(side);
      const double first = random.uniform();
      for (int k = 0; k < kTurns; ++k) {
        const double turn = 2 * std::numbers::pi * (k + first) / kTurns;
        out.add(middle, std::cos(turn) * side + std::sin(turn) * other, closing, width, (middle - centre).norm());
      }
      // And along the axes of the shape, where one lies in the plane of the facets.
      for (int a = 0; a < 3; ++a)
        if (std::abs(axis(a).dot(closing)) < 0.02)
          for (const double sign : {1.0, -1.0})
            out.add(middle, sign * (axis(a) - axis(a).dot(closing) * closing).normalized(), closing, width,
                    (middle - centre).norm());
    }
  }
}

}  // namespace

double reach(const Shape& shape, const Vector3& direction) {
  const double up = std::abs(direction.z()), side = direction.head<2>().norm();
  switch (shape.kind) {
    case ShapeKind::box:
      return 0.5 * shape.size.dot(direction.cwiseAbs());
    case ShapeKind::sphere:
      return shape.radius;
    case ShapeKind::cylinder:
      return 0.5 * shape.length * up + shape.radius * side;
    case ShapeKind::capsule:
      return 0.5 * shape.length * up + shape.radius;
    case ShapeKind::cone:
      return std::max(0.5 * shape.length * direction.z(), -0.5 * shape.length * direction.z() + shape.radius * side);
    case ShapeKind::hull:
    case ShapeKind::mesh:
      break;
  }
  double most = shape.points.empty() ? 0.0 : -1e9;
  for (const Vector3& point : shape.points) most = std::max(most, point.dot(direction));
  return most;
}

double reach(const Part& part, const Vector3& direction) {
  double most = -1e9;
  for (const Shape& shape : part.shapes) {
    if (!shape.collides) continue;
    const Vector3 local = shape.part_from_shape.linear().transpose() * direction;
    most = std::max(most, shape.part_from_shape.translation().dot(direction) + reach(shape, local));
  }
  return most < -1e8 ? 0.0 : most;
}

std::vector<ShapeGrasp> shape_grasps(const Shape& shape, double opening_m, double depth_m, RandomKey key) {
  Random random(key);
  Collector out(shape, opening_m, depth_m);
  switch (shape.kind) {
    case ShapeKind::box:
      box_grasps(shape, random, out);
      break;
    case ShapeKind::sphere:
      sphere_grasps(shape, random, out);
      break;
    case ShapeKind::cylinder:
    case ShapeKind::capsule:
    case ShapeKind::cone:
      round_grasps(shape, random, out);
      break;
    case ShapeKind::hull:
      hull_grasps(shape, random, out);
      break;
    case ShapeKind::mesh:  // drawn only
      break;
  }
  return out.take();
}

}  // namespace stampede
