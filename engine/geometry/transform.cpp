#include "engine/geometry/transform.h"

#include <algorithm>
#include <cmath>

namespace stampede {

Pose to_pose(const Transform& transform) {
  const Vector3 origin = transform.translation();
  Quaternion rotation(transform.linear());
  rotation.normalize();
  if (rotation.w() < 0) rotation.coeffs() = -rotation.coeffs();
  return {{origin.x(), origin.y(), origin.z()}, {rotation.x(), rotation.y(), rotation.z(), rotation.w()}};
}

Transform to_transform(const Pose& pose) {
  const auto& q = pose.quaternion;
  return make_transform(Vector3(pose.position[0], pose.position[1], pose.position[2]),
                        Quaternion(q[3], q[0], q[1], q[2]));
}

Transform translation(double x, double y, double z) { return translation(Vector3(x, y, z)); }

Transform translation(const Vector3& offset) {
  Transform result = Transform::Identity();
  result.translation() = offset;
  return result;
}

Transform rotation_rpy(double roll, double pitch, double yaw) {
  Transform result = Transform::Identity();
  result.linear() = (Eigen::AngleAxisd(yaw, Vector3::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3::UnitY()) *
                     Eigen::AngleAxisd(roll, Vector3::UnitX()))
                        .toRotationMatrix();
  return result;
}

Transform make_transform(const Vector3& origin, const Quaternion& rotation) {
  Transform result = Transform::Identity();
  result.linear() = rotation.normalized().toRotationMatrix();
  result.translation() = origin;
  return result;
}

double angle_between(const Quaternion& a, const Quaternion& b) {
  const Quaternion difference = a.conjugate() * b;  // atan2 keeps small angles exact, where acos of the dot would not
  return 2.0 * std::atan2(difference.vec().norm(), std::abs(difference.w()));
}

Transform between(const Transform& from, const Transform& to, double share) {
  const Quaternion a(from.linear()), b(to.linear());
  return make_transform((1 - share) * from.translation() + share * to.translation(), a.slerp(share, b).normalized());
}

}  // namespace stampede
