#include "engine/geometry/hull.h"

#include <catch2/catch.hpp>
#include <numbers>
#include <set>

#include "engine/base/random.h"
#include "engine/geometry/corners.h"

using namespace stampede;

namespace {

std::vector<Vector3> on_sphere(int count) {
  Random random(RandomKey("sphere"));
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i)
    points.push_back(Vector3(random.normal(), random.normal(), random.normal()).normalized());
  return points;
}

double farthest_outside(const Hull& hull, const std::vector<Vector3>& points) {
  double most = 0;
  for (const auto& [a, b, c] : hull.triangles) {
    const auto at = [&](int i) { return hull.points[static_cast<std::size_t>(i)]; };
    const Vector3 normal = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    for (const Vector3& point : points) most = std::max(most, normal.dot(point - at(a)));
  }
  return most;
}

bool closed(const Hull& hull) {
  std::set<std::pair<int, int>> edges;
  for (const auto& t : hull.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (!edges.emplace(t[k], t[(k + 1) % 3]).second) return false;
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) return false;
  return hull.triangles.size() == 2 * hull.points.size() - 4;  // Euler
}

}  // namespace

TEST_CASE("a cube's hull has its 8 corners, whatever lies inside, on its faces or twice") {
  std::vector<Vector3> points{{0.5, 0.5, 0.5}, {0.5, 0.5, 1}, {0, 0.5, 0}};
  for (int twice = 0; twice < 2; ++twice)
    for (const Vector3& corner : box_corners(Vector3::Zero(), Vector3::Ones())) points.push_back(corner);
  const auto hull = convex_hull(points);
  REQUIRE(hull);
  CHECK(hull->points.size() == 8);
  CHECK(closed(*hull));
  CHECK(mass_properties(*hull).volume == Approx(1));
}

TEST_CASE("points on a sphere are all corners, and the surface is closed and convex") {
  const std::vector<Vector3> points = on_sphere(500);
  const auto hull = convex_hull(points);
  REQUIRE(hull);
  CHECK(hull->points == points);
  CHECK(closed(*hull));
  CHECK(farthest_outside(*hull, points) < 1e-9);
}

TEST_CASE("a reduced hull says truly how much it leaves out") {
  const std::vector<Vector3> points = on_sphere(2000);
  const auto hull = convex_hull(points, 64);
  REQUIRE(hull);
  CHECK(hull->points.size() == 64);
  CHECK(closed(*hull));
  CHECK(hull->deviation_m == Approx(farthest_outside(*hull, points)).epsilon(1e-9));
  CHECK(hull->deviation_m < 0.15);
}

TEST_CASE("a tetrahedron's mass properties are the textbook's, far from the origin too") {
  const Vector3 far(1000, -2000, 500);
  const std::vector<Vector3> points{far, far + Vector3(1, 0, 0), far + Vector3(0, 1, 0), far + Vector3(0, 0, 1)};
  const MassProperties solid = mass_properties(*convex_hull(points));
  CHECK(solid.volume == Approx(1.0 / 6));
  CHECK((solid.centre - far - Vector3::Constant(0.25)).norm() < 1e-9);
  // About the centre: Ixx = 1/80 and Ixy = 1/480 for density 1.
  CHECK(solid.inertia(0, 0) == Approx(1.0 / 80));
  CHECK(solid.inertia(0, 1) == Approx(1.0 / 480));
}

TEST_CASE("points in a plane, on a line or too few have no hull") {
  CHECK_FALSE(convex_hull(std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.4, 0}}));
  CHECK_FALSE(convex_hull(std::vector<Vector3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}));
  CHECK_FALSE(convex_hull(std::vector<Vector3>{}));
}
