#include "engine/model/camera.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace stampede {
namespace {

constexpr int kUndistortSteps = 50;
constexpr double kUndistortGoal = 1e-9;  // of z

}  // namespace

void set_field_of_view(Camera& camera, double vertical_fov_rad, int width, int height) {
  camera.width = width;
  camera.height = height;
  camera.focal_x = camera.focal_y = height / 2.0 / std::tan(vertical_fov_rad / 2);
  camera.centre_x = width / 2.0;
  camera.centre_y = height / 2.0;
}

double vertical_field_of_view(const Camera& camera) {
  return std::atan(camera.centre_y / camera.focal_y) + std::atan((camera.height - camera.centre_y) / camera.focal_y);
}

Camera resized(const Camera& camera, int width, int height) {
  Camera other = camera;
  const double scale = static_cast<double>(height) / camera.height;
  other.width = width;
  other.height = height;
  other.focal_x *= scale;
  other.focal_y *= scale;
  other.centre_x = width / 2.0 + (camera.centre_x - camera.width / 2.0) * scale;
  other.centre_y *= scale;
  return other;
}

std::array<double, 2> distorted(const Camera& camera, const std::array<double, 2>& direction) {
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const auto [x, y] = direction;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

std::optional<std::array<double, 2>> undistorted(const Camera& camera, const std::array<double, 2>& direction) {
  std::array<double, 2> guess = direction;
  for (int step = 0; step < kUndistortSteps; ++step) {  // fixed point: move by what is missing
    const auto [x, y] = distorted(camera, guess);
    const double dx = direction[0] - x, dy = direction[1] - y;
    if (!(std::abs(dx) + std::abs(dy) < 1e3)) return std::nullopt;
    if (std::abs(dx) + std::abs(dy) < kUndistortGoal) return guess;
    guess[0] += dx;
    guess[1] += dy;
  }
  return std::nullopt;
}

std::array<double, 2> project(const Camera& camera, const Vector3& camera_from_point) {
  const auto [x, y] =
      distorted(camera, {camera_from_point.x() / camera_from_point.z(), camera_from_point.y() / camera_from_point.z()});
  return {camera.focal_x * x + camera.centre_x, camera.focal_y * y + camera.centre_y};
}

std::optional<std::array<double, 2>> direction_of(const Camera& camera, const std::array<double, 2>& pixel) {
  return undistorted(camera,
                     {(pixel[0] - camera.centre_x) / camera.focal_x, (pixel[1] - camera.centre_y) / camera.focal_y});
}

Transform looking_at(const Vector3& from, const Vector3& to, const Vector3& up) {
  const Vector3 forward = to - from;
  if (forward.norm() < 1e-9) throw Error("", "a camera cannot look at the point where it stands");
  const Vector3 z = forward.normalized();
  Vector3 right = z.cross(up);
  if (right.norm() < 1e-6) right = z.cross(Vector3::UnitY());  // straight down: y is up in the picture
  if (right.norm() < 1e-6) right = z.cross(Vector3::UnitX());
  right.normalize();
  Transform world_from_camera = translation(from);
  world_from_camera.linear().col(0) = right;
  world_from_camera.linear().col(1) = z.cross(right);
  world_from_camera.linear().col(2) = z;
  return world_from_camera;
}

void put_cameras(Scene& scene, const std::vector<Camera>& cameras) {
  for (const Camera& camera : cameras) {
    const auto known = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                    [&](const Camera& other) { return other.name == camera.name; });
    if (known == scene.cameras.end())
      scene.cameras.push_back(camera);
    else
      *known = camera;
  }
  std::sort(scene.cameras.begin(), scene.cameras.end(),
            [](const Camera& a, const Camera& b) { return a.name < b.name; });
}

}  // namespace stampede
