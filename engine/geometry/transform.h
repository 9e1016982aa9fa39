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

// Angle of the rotation between two frames, rad in [0, pi].
double angle_between(const Quaternion& a, const Quaternion& b);

}  // namespace stampede
