// Triangles close their shapes, face outwards and stay within the tolerance.
#include "engine/render/tessellate.h"

#include <catch2/catch.hpp>

#include "tests/engine/render/all_shapes.h"

using namespace stampede;

namespace {

Vector3 corner(const DrawnMesh& mesh, std::uint32_t i) {
  return {mesh.positions[i][0], mesh.positions[i][1], mesh.positions[i][2]};
}

double volume(const DrawnMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) sum += corner(mesh, a).dot(corner(mesh, b).cross(corner(mesh, c))) / 6;
  return sum;
}

void demand_good(const Shape& shape, double exact_volume, double share) {
  const DrawnMesh mesh = tessellate(shape, {});
  CHECK(is_closed(mesh));
  CHECK(volume(mesh) == Approx(exact_volume).epsilon(share));
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3 face = (corner(mesh, b) - corner(mesh, a)).cross(corner(mesh, c) - corner(mesh, a));
    for (const std::uint32_t i : {a, b, c}) {
      const Vector3 normal(mesh.normals[i][0], mesh.normals[i][1], mesh.normals[i][2]);
      CHECK(normal.norm() == Approx(1).margin(1e-5));
      CHECK(normal.dot(face) > 0);
    }
  }
}

}  // namespace

TEST_CASE("Every shape is closed, faces outwards and has its volume") {
  constexpr double pi = std::numbers::pi;
  demand_good(box_of({0.1, 0.2, 0.3}), 0.006, 1e-5);
  for (const double r : {0.005, 0.05, 0.3}) {
    demand_good(shape_of(ShapeKind::sphere, r, 0), 4 * pi / 3 * r * r * r, 0.03);
    demand_good(shape_of(ShapeKind::cylinder, r, 0.2), pi * r * r * 0.2, 0.03);
    demand_good(shape_of(ShapeKind::cone, r, 0.2), pi * r * r * 0.2 / 3, 0.03);
    demand_good(shape_of(ShapeKind::capsule, r, 0.2), pi * r * r * (0.2 + 4.0 / 3 * r), 0.03);
  }
}

TEST_CASE("A round shape strays no further than the tolerance, at corners and in the middle of edges") {
  for (const double r : {0.01, 0.06, 0.15}) {
    const DrawnMesh mesh = tessellate(shape_of(ShapeKind::cylinder, r, 0.2), {});
    const double edge = (corner(mesh, 0) - corner(mesh, 1)).norm();  // of the lower rim
    for (const auto& triangle : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector3 a = corner(mesh, triangle[i]), b = corner(mesh, triangle[(i + 1) % 3]);
        CHECK(std::abs(a.head<2>().norm() - r) <= kRoundTolerance * 1.01);
        if (a.z() == b.z() && (a - b).norm() < 1.01 * edge)
          CHECK(std::abs(((a + b) / 2).head<2>().norm() - r) <= kRoundTolerance * 1.01);
      }
  }
}

TEST_CASE("An open or inside-out mesh is not closed") {
  DrawnMesh mesh = tessellate(box_of({1, 1, 1}), {});
  REQUIRE(is_closed(mesh));
  DrawnMesh open = mesh, inside_out = mesh, mixed = mesh;
  open.triangles.pop_back();
  CHECK_FALSE(is_closed(open));
  for (auto& triangle : inside_out.triangles) std::swap(triangle[0], triangle[1]);
  CHECK_FALSE(is_closed(inside_out));
  std::swap(mixed.triangles[0][0], mixed.triangles[0][1]);
  CHECK_FALSE(is_closed(mixed));
}

TEST_CASE("Keys tell shapes apart by content, wherever they stand and whatever their colour") {
  const Scene scene;
  Shape moved = box_of({1, 2, 3}, {1, 0, 0, 1});
  moved.part_from_shape = translation(1, 2, 3);
  CHECK(tessellation_key(box_of({1, 2, 3}), scene) == tessellation_key(moved, scene));
  CHECK(tessellation_key(box_of({1, 2, 3}), scene) != tessellation_key(box_of({1, 3, 2}), scene));
  CHECK(tessellation_key(shape_of(ShapeKind::cone, 1, 2), scene) !=
        tessellation_key(shape_of(ShapeKind::cylinder, 1, 2), scene));
}
