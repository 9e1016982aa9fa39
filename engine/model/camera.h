// Pinhole geometry: intrinsics, lens distortion, other sizes, calibration files.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "engine/model/scene.h"

namespace stampede {

// Sets size, focal lengths (square pixels) and the centre. Units: rad.
void set_field_of_view(Camera& camera, double vertical_fov_rad, int width, int height);
double vertical_field_of_view(const Camera& camera);  // rad

// The same camera with other pixels: the vertical field of view stays, the horizontal one follows the shape.
Camera resized(const Camera& camera, int width, int height);

// Of a direction (x/z, y/z): where the lens moves it, and back (by iteration; nothing where it does not converge).
std::array<double, 2> distorted(const Camera& camera, const std::array<double, 2>& direction);
std::optional<std::array<double, 2>> undistorted(const Camera& camera, const std::array<double, 2>& direction);

// Pixel of a point in the camera's frame (z > 0), with distortion; and the direction (x/z, y/z) of a pixel.
std::array<double, 2> project(const Camera& camera, const Vector3& camera_from_point);
std::optional<std::array<double, 2>> direction_of(const Camera& camera, const std::array<double, 2>& pixel);

// At `from`, looking at `to`, with `up` upwards in the picture. Throws Error when they coincide.
Transform looking_at(const Vector3& from, const Vector3& to, const Vector3& up = Vector3::UnitZ());

// Cameras of a calibration file (JSON): { "cameras": [ { "name", "width", "height", "camera_matrix": 3 x 3 with
// positive focal lengths, "distortion": [k1 k2 p1 p2 k3] or left out, "mount": "world" or "robot.LINK",
// "mount_from_camera": 4 x 4 (optical frame), "near", "far", "pixel_centres": "integer" (OpenCV, the default) or "half"
// } ] }. A scene's camera of that name is replaced; another is added. Throws Error with the place for every wrong
// shape, for a matrix that is no rotation, and for focal lengths that are not positive.
std::vector<Camera> load_calibration(const std::filesystem::path& file, const Scene& scene);
void put_cameras(Scene& scene, const std::vector<Camera>& cameras);  // replaces by name, else adds; sorted by name

}  // namespace stampede
