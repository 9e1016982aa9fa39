#include "engine/render/eye.h"

namespace stampede {

Eye eye_of(const View& view, double right, double down) {
  const Camera& camera = view.camera;
  const double near = camera.near_m, far = camera.far_m;
  Eigen::Matrix4d clip_from_camera = Eigen::Matrix4d::Zero();
  clip_from_camera(0, 0) = 2 * camera.focal_x / camera.width;
  clip_from_camera(0, 2) = 2 * (camera.centre_x - right) / camera.width - 1;
  clip_from_camera(1, 1) = 2 * camera.focal_y / camera.height;
  clip_from_camera(1, 2) = 2 * (camera.centre_y - down) / camera.height - 1;
  clip_from_camera(2, 2) = -near / (far - near);  // 1 at near, 0 at far once divided by z
  clip_from_camera(2, 3) = near * far / (far - near);
  clip_from_camera(3, 2) = 1;
  return {clip_from_camera * view.world_from_camera.inverse().matrix(), camera.width, camera.height};
}

}  // namespace stampede
