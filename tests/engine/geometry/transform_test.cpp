#include "engine/geometry/transform.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "engine/base/random.h"

using namespace stampede;

TEST_CASE("poses and transforms go back and forth, with w not negative") {
  Random random(RandomKey("pose"));
  for (int k = 0; k < 200; ++k) {
    const Transform transform = translation(random.normal(), random.normal(), random.normal()) *
                                rotation_rpy(random.between(-4, 4), random.between(-4, 4), random.between(-4, 4));
    const Pose pose = to_pose(transform);
    REQUIRE(pose.quaternion[3] >= 0);
    REQUIRE((to_transform(pose).matrix() - transform.matrix()).cwiseAbs().maxCoeff() < 1e-14);
  }
}

TEST_CASE("roll, pitch, yaw turn about fixed axes in this order") {
  constexpr double quarter = std::numbers::pi / 2;
  // Roll takes y to z; the yaw afterwards leaves z alone.
  CHECK((rotation_rpy(quarter, 0, quarter) * Vector3::UnitY() - Vector3::UnitZ()).norm() < 1e-15);
  CHECK((rotation_rpy(0, quarter, 0) * Vector3::UnitX() + Vector3::UnitZ()).norm() < 1e-15);
}

TEST_CASE("tiny and half-turn angles are exact, whatever the quaternions' signs") {
  const auto about_z = [](double angle) { return Quaternion(Eigen::AngleAxisd(angle, Vector3::UnitZ())); };
  Quaternion negated = about_z(1e-9);
  negated.coeffs() = -negated.coeffs();
  CHECK(angle_between(Quaternion::Identity(), negated) == Approx(1e-9).epsilon(1e-9));
  CHECK(angle_between(about_z(1), about_z(1 + std::numbers::pi)) == Approx(std::numbers::pi));
}
