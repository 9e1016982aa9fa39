// Between Eigen's values and Bullet's. Exact: both sides are float64.
#pragma once

#include <LinearMath/btTransform.h>

#include "engine/geometry/transform.h"

namespace stampede {

inline btVector3 to_bullet(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
inline Vector3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

inline btMatrix3x3 to_bullet(const Matrix3& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

inline btQuaternion to_bullet(const Quaternion& q) { return {q.x(), q.y(), q.z(), q.w()}; }
inline btTransform to_bullet(const Transform& t) {
  return btTransform(to_bullet(Matrix3(t.linear())), to_bullet(Vector3(t.translation())));
}

inline Transform from_bullet(const btTransform& t) {
  Transform result = Transform::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) result.linear()(row, column) = t.getBasis()[row][column];
    result.translation()[row] = t.getOrigin()[row];
  }
  return result;
}

}  // namespace stampede
