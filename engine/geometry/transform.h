// Rigid transforms and their plain, storable form.
#pragma once

#include <Eigen/Geometry>
#include <array>

namespace stampede {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;
using Transform = Eigen::Isometry3d;  // names say both frames: world_from_cup * cup_from_handle

// What records, catalogues and public headers hold. Units: m; quaternion xyzw, unit length, w >= 0.
struct Pose {
  std::array<double, 3> position{0, 0, 0};
  std::array<double, 4> quaternion{0, 0, 0, 1};
  friend bool operator==(const Pose&, const Pose&) = default;
};

Pose to_pose(const Transform& transform);
Transform to_transform(const Pose& pose);

Transform translation(double x, double y, double z);
Transform translation(const Vector3& offset);
Transform rotation_rpy(double roll, double pitch, double yaw);  // fixed axes x, y, z (URDF's rpy), rad
Transform make_transform(const Vector3& origin, const Quaternion& rotation);

// a * b, in a third of the time that the product of two Transforms takes.
inline Transform product(const Transform& a, const Transform& b) {
  Transform result;
  const double *left = a.matrix().data(), *right = b.matrix().data();
  double* out = result.matrix().data();  // 4 x 4, column by column
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row)
      out[4 * column + row] = left[row] * right[4 * column] + left[4 + row] * right[4 * column + 1] +
                              left[8 + row] * right[4 * column + 2] + (column == 3 ? left[12 + row] : 0.0);
  out[3] = out[7] = out[11] = 0;
  out[15] = 1;
  return result;
}

// Angle of the rotation between two frames, rad in [0, pi].
double angle_between(const Quaternion& a, const Quaternion& b);

// The pose at a share of the straight way: lerp of positions, slerp of rotations (Shoemake 1985,
// doi:10.1145/325334.325242).
Transform between(const Transform& from, const Transform& to, double share);

}  // namespace stampede
