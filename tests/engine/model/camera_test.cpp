#include "engine/model/camera.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "engine/base/error.h"

using namespace stampede;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

Camera lens() {
  Camera camera;
  set_field_of_view(camera, 60 * kDegree, 640, 480);
  camera.centre_x += 7, camera.centre_y -= 4, camera.focal_y *= 1.02;
  camera.distortion = {-0.25, 0.07, 0.002, -0.003, 0.004};
  return camera;
}

}  // namespace

TEST_CASE("the field of view says where the upper edge of the picture is") {
  Camera camera;
  set_field_of_view(camera, 90 * kDegree, 200, 100);
  CHECK(camera.focal_x == Approx(50));  // half the height at 45 degrees
  CHECK(camera.focal_y == Approx(50));
  const auto [u, v] = project(camera, {0, -3, 3});  // y points down
  CHECK(u == Approx(100));
  CHECK(v == Approx(0).margin(1e-9));
  CHECK(vertical_field_of_view(camera) == Approx(90 * kDegree));
}

TEST_CASE("x is right and y is down in the picture") {
  const Camera camera;
  const auto centre = project(camera, {0, 0, 1}), right = project(camera, {0.1, 0, 1}),
             down = project(camera, {0, 0.1, 1});
  CHECK(centre[0] == Approx(camera.centre_x));
  CHECK(right[0] == Approx(camera.centre_x + 0.1 * camera.focal_x));
  CHECK(right[1] == Approx(centre[1]));
  CHECK(down[1] == Approx(camera.centre_y + 0.1 * camera.focal_y));
}

TEST_CASE("the lens moves points as Brown's formula says") {
  Camera camera;
  camera.distortion = {0.1, 0, 0, 0, 0};
  CHECK(distorted(camera, {0.5, 0})[0] == Approx(0.5 * (1 + 0.1 * 0.25)));
  camera.distortion = {0, 0.1, 0, 0, 0.01};
  CHECK(distorted(camera, {0, 0.5})[1] == Approx(0.5 * (1 + 0.1 / 16 + 0.01 / 64)));
  camera.distortion = {0, 0, 0.01, 0.02, 0};
  const auto [x, y] = distorted(camera, {0.3, 0.4});
  CHECK(x == Approx(0.3 + 2 * 0.01 * 0.12 + 0.02 * (0.25 + 0.18)));
  CHECK(y == Approx(0.4 + 0.01 * (0.25 + 0.32) + 2 * 0.02 * 0.12));
}

TEST_CASE("every pixel's direction is projected back onto it, through the lens too") {
  for (const Camera& camera : {Camera(), lens()})
    for (int v = 0; v <= camera.height; v += 16)
      for (int u = 0; u <= camera.width; u += 16) {
        const auto direction = direction_of(camera, {double(u), double(v)});
        REQUIRE(direction);
        const double z = 0.3 + 0.01 * u;
        const auto pixel = project(camera, {(*direction)[0] * z, (*direction)[1] * z, z});
        CHECK(pixel[0] == Approx(u).margin(1e-5));
        CHECK(pixel[1] == Approx(v).margin(1e-5));
      }
}

TEST_CASE("where no ray ends there is no direction") {
  Camera camera;
  camera.distortion = {-0.5, 0, 0, 0, 0};  // r - r^3 / 2 has its greatest value, 0.544, at r = 0.816
  CHECK(undistorted(camera, {0.5, 0}));
  CHECK_FALSE(undistorted(camera, {0.6, 0}));
}

TEST_CASE("another size keeps the vertical field of view, and the same size keeps all") {
  const Camera camera = lens();
  for (const auto& [width, height] : {std::pair{128, 128}, {1280, 960}, {64, 480}, {333, 77}}) {
    const Camera other = resized(camera, width, height);
    CHECK(other.width == width);
    CHECK(other.height == height);
    CHECK(vertical_field_of_view(other) == Approx(vertical_field_of_view(camera)));
    CHECK(other.focal_x / other.focal_y == Approx(camera.focal_x / camera.focal_y));
    // What was seen at the upper edge above the axis is seen there again.
    const auto direction = direction_of(camera, {camera.centre_x, 0});
    CHECK(project(other, {(*direction)[0], (*direction)[1], 1})[1] == Approx(0).margin(1e-5));
  }
  const Camera same = resized(camera, 640, 480);
  CHECK(same.centre_x == camera.centre_x);
  CHECK(same.focal_x == camera.focal_x);
}

TEST_CASE("a camera looks at its target, upright") {
  const Vector3 from(1.3, -0.2, 1.6), to(0.1, 0.3, 0.8);
  const Transform world_from_camera = looking_at(from, to);
  const Vector3 seen = world_from_camera.inverse() * to;
  CHECK(seen.head<2>().norm() < 1e-12);
  CHECK(seen.z() == Approx((to - from).norm()));
  CHECK((world_from_camera.inverse() * Vector3(to + Vector3::UnitZ())).y() < -0.1);  // higher is up, so -y
  CHECK(world_from_camera.linear().determinant() == Approx(1));
  for (const Vector3& way : {Vector3(0, 0, -1), Vector3(0, 0, 1)}) {  // along `up`
    const Transform along = looking_at(from, from + way);
    CHECK(along.linear().determinant() == Approx(1));
    CHECK((along.linear().col(2) - way).norm() < 1e-12);
  }
  CHECK_THROWS_AS(looking_at(from, from), Error);
}

TEST_CASE("cameras replace those of their name, and stay sorted") {
  Scene scene;
  for (const char* name : {"front", "wrist"}) scene.cameras.emplace_back().name = name;
  Camera front, left;
  front.name = "front", front.width = 99;
  left.name = "left";
  put_cameras(scene, {left, front});
  REQUIRE(scene.cameras.size() == 3);
  CHECK(scene.cameras[0].width == 99);
  CHECK(scene.cameras[1].name == "left");
  CHECK(scene.cameras[2].name == "wrist");
}
