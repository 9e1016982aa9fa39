#include "engine/model/scene.h"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <numbers>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/geometry/corners.h"

using namespace stampede;

namespace {

constexpr double kPi = std::numbers::pi;

Shape box(const Vector3& size) {
  Shape shape;
  shape.size = size;
  return shape;
}

Shape round(ShapeKind kind, double radius, double length = 0) {
  Shape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.length = length;
  return shape;
}

Part weighed(std::vector<Shape> shapes, double mass) {
  Part part;
  part.name = "part";
  part.shapes = std::move(shapes);
  set_uniform_mass(part, mass);
  return part;
}

// Mass, centre and inertia by summing little cubes of the region where `inside` holds.
Part by_sum(double reach, double mass, bool (*inside)(const Vector3&)) {
  constexpr int n = 80;
  double count = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
  for (int i = 0; i < n * n * n; ++i) {
    const Vector3 p =
        reach * (2.0 / n * (Vector3(i % n, i / n % n, i / n / n) + Vector3::Constant(0.5)) - Vector3::Ones());
    if (!inside(p)) continue;
    count += 1;
    first += p;
    second += p * p.transpose();
  }
  Part part;
  part.mass = mass;
  part.centre_of_mass = first / count;
  second = (second / count - part.centre_of_mass * part.centre_of_mass.transpose()).eval();
  part.inertia = mass * (second.trace() * Matrix3::Identity() - second);
  return part;
}

void check_close(const Part& part, const Part& expected, double tolerance) {
  CHECK((part.centre_of_mass - expected.centre_of_mass).norm() < tolerance);
  CHECK((part.inertia - expected.inertia).norm() < tolerance * expected.inertia.norm() * 4);
}

}  // namespace

TEST_CASE("textbook inertias: box, sphere, cylinder") {
  CHECK((weighed({box({1, 2, 3})}, 12).inertia.diagonal() - Vector3(13, 10, 5)).norm() < 1e-12);
  CHECK((weighed({round(ShapeKind::sphere, 0.5)}, 10).inertia - Matrix3::Identity()).norm() < 1e-12);
  const Part cylinder = weighed({round(ShapeKind::cylinder, 1, 2)}, 12);
  CHECK((cylinder.inertia.diagonal() - Vector3(7, 7, 6)).norm() < 1e-12);
}

TEST_CASE("capsule and cone agree with a sum over little cubes") {
  check_close(
      weighed({round(ShapeKind::capsule, 0.5, 1)}, 3),
      by_sum(1, 3,
             [](const Vector3& p) { return std::hypot(p.x(), p.y(), std::max(0.0, std::abs(p.z()) - 0.5)) <= 0.5; }),
      5e-3);
  check_close(weighed({round(ShapeKind::cone, 0.9, 2)}, 3),
              by_sum(1, 3,
                     [](const Vector3& p) {
                       return std::hypot(p.x(), p.y()) <= 0.9 * (1 - p.z()) / 2;  // apex up, centred
                     }),
              5e-3);
}

TEST_CASE("a box as a hull weighs like the box, wherever it stands and however it is turned") {
  const Vector3 size(0.1, 0.2, 0.3);
  Shape solid = box(size), hull;
  hull.kind = ShapeKind::hull;
  for (const Vector3& corner : box_corners(-size / 2, size / 2)) hull.points.push_back(corner);
  solid.part_from_shape = hull.part_from_shape = translation(3, -2, 1) * rotation_rpy(0.3, 0.5, -1);
  const Part a = weighed({solid}, 2), b = weighed({hull}, 2);
  CHECK((a.centre_of_mass - Vector3(3, -2, 1)).norm() < 1e-12);
  CHECK((a.centre_of_mass - b.centre_of_mass).norm() < 1e-12);
  CHECK((a.inertia - b.inertia).norm() < 1e-12);
}

TEST_CASE("two half boxes weigh like the whole, only what collides has mass") {
  Shape left = box({0.5, 1, 1}), right = left, decoration = box({9, 9, 9});
  left.part_from_shape = translation(-0.25, 0, 0);
  right.part_from_shape = translation(0.25, 0, 0);
  decoration.collides = false;
  const Part halves = weighed({left, right, decoration}, 6), whole = weighed({box({1, 1, 1})}, 6);
  CHECK((halves.inertia - whole.inertia).norm() < 1e-12);
  CHECK(halves.mass == 6);
}

TEST_CASE("a mass that cannot be is an error") {
  Part part;
  part.shapes = {box({1, 1, 1})};
  CHECK_THROWS_AS(set_uniform_mass(part, 0), Error);
  CHECK_THROWS_AS(set_uniform_mass(part, std::nan("")), Error);
  part.shapes = {box({1, 1, 0})};
  CHECK_THROWS_AS(set_uniform_mass(part, 1), Error);
}

TEST_CASE("bounding boxes are tight for turned shapes") {
  Part part;
  part.shapes = {round(ShapeKind::cylinder, 0.5, 2)};
  part.shapes[0].part_from_shape = translation(1, 0, 0) * rotation_rpy(kPi / 2, 0, 0);  // along y
  CHECK((bounding_box(part)[0] - Vector3(0.5, -1, -0.5)).norm() < 1e-7);
  CHECK((bounding_box(part)[1] - Vector3(1.5, 1, 0.5)).norm() < 1e-7);
  part.shapes = {box({2, 2, 2})};
  part.shapes[0].part_from_shape = rotation_rpy(0, 0, kPi / 4);
  CHECK((bounding_box(part)[1] - Vector3(std::sqrt(2), std::sqrt(2), 1)).norm() < 1e-12);
  part.shapes = {round(ShapeKind::cone, 1, 2)};
  part.shapes[0].part_from_shape = rotation_rpy(0, kPi / 2, 0);  // apex along +x
  CHECK((bounding_box(part)[0] - Vector3(-1, -1, -1)).norm() < 1e-7);
  CHECK((bounding_box(part)[1] - Vector3(1, 1, 1)).norm() < 1e-7);
}
