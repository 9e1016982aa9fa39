#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/base/error.h"
#include "tests/engine/geometry/mesh_files.h"

using namespace stampede;

namespace {

Vector3 corner(const DrawnMesh& mesh, const std::array<std::uint32_t, 3>& triangle, std::size_t k) {
  const auto& p = mesh.positions[triangle[k]];
  return {p[0], p[1], p[2]};
}

Vector3 normal(const DrawnMesh& mesh, std::uint32_t i) {
  return {mesh.normals[i][0], mesh.normals[i][1], mesh.normals[i][2]};
}

// Every edge is passed once in each direction.
bool is_closed(const DrawnMesh& mesh) {
  std::multiset<std::array<std::array<float, 3>, 2>> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.insert({mesh.positions[t[k]], mesh.positions[t[(k + 1) % 3]]});
  for (const auto& [a, b] : edges)
    if (edges.count({a, b}) != edges.count({b, a})) return false;
  return true;
}

double ngon(int sides) { return sides / 2.0 * std::sin(2 * std::numbers::pi / sides); }  // area, radius 1

void check_normals(const DrawnMesh& mesh) {
  REQUIRE(mesh.normals.size() == mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    const Vector3 face =
        (corner(mesh, t, 1) - corner(mesh, t, 0)).cross(corner(mesh, t, 2) - corner(mesh, t, 0)).normalized();
    for (const std::uint32_t i : t) {
      CHECK(normal(mesh, i).norm() == Approx(1));
      CHECK(normal(mesh, i).dot(face) > std::cos(0.7));
    }
  }
}

}  // namespace

TEST_CASE("a turned rectangle is a prism: closed, of its volume, with flat ends and a round side") {
  const DrawnMesh mesh = lathe_mesh({{0.5, 0}, {0.5, 2}}, 16);
  CHECK(is_closed(mesh));
  CHECK(volume(mesh) == Approx(ngon(16) * 0.25 * 2).epsilon(1e-5));
  check_normals(mesh);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const auto& n = mesh.normals[i];
    const auto& p = mesh.positions[i];
    const bool end = std::abs(n[2]) == 1 && (n[2] > 0) == (p[2] == 2);
    const bool side = n[2] == 0 && n[0] == Approx(p[0] / 0.5F).margin(1e-6);
    CHECK((end || side));
  }
}

TEST_CASE("the way in which a profile is written does not matter") {
  const std::vector<std::array<double, 2>> up{{0.1, 0}, {0.3, 0.2}, {0.2, 0.5}};
  const DrawnMesh mesh = lathe_mesh(up, 8);
  const DrawnMesh other = lathe_mesh({up.rbegin(), up.rend()}, 8);
  CHECK(volume(mesh) > 0);
  CHECK(mesh == other);
}

TEST_CASE("a sphere is smooth everywhere, its poles too") {
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= 24; ++i) {
    const double angle = std::numbers::pi * (i / 24.0 - 0.5);
    profile.push_back({i == 0 || i == 24 ? 0 : std::cos(angle), std::sin(angle)});
  }
  const DrawnMesh mesh = lathe_mesh(profile, 48);
  CHECK(is_closed(mesh));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) CHECK(mesh.normals[i][k] == Approx(mesh.positions[i][k]).margin(2e-3));
}

TEST_CASE("a cup has an inside, and its wall is what lies between") {
  const DrawnMesh mesh = lathe_mesh({{0, 0}, {0.04, 0}, {0.04, 0.1}, {0.035, 0.1}, {0.035, 0.01}, {0, 0.01}}, 32);
  CHECK(is_closed(mesh));
  CHECK(volume(mesh) == Approx(ngon(32) * (0.04 * 0.04 * 0.1 - 0.035 * 0.035 * 0.09)).epsilon(1e-4));
  check_normals(mesh);
}

TEST_CASE("a profile that meets itself is a ring with a hole") {
  const DrawnMesh mesh = lathe_mesh({{1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 0}}, 12);
  CHECK(is_closed(mesh));
  CHECK(volume(mesh) == Approx(ngon(12) * 3).epsilon(1e-5));
  for (const auto& p : mesh.positions) CHECK(std::hypot(p[0], p[1]) > 0.99);
}

TEST_CASE("profiles that make no surface are errors") {
  CHECK_THROWS_AS(lathe_mesh({{1, 0}, {1, 1}}, 2), Error);
  CHECK_THROWS_AS(lathe_mesh({{1, 0}}, 8), Error);
  CHECK_THROWS_AS(lathe_mesh({{-1, 0}, {1, 1}}, 8), Error);
  CHECK_THROWS_AS(lathe_mesh({{NAN, 0}, {1, 1}}, 8), Error);
  CHECK_THROWS_AS(lathe_mesh({{0, 0}, {0, 1}}, 8), Error);
  CHECK_THROWS_AS(lathe_mesh({{0, 0}, {0, 0}}, 8), Error);
}
