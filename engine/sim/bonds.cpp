#include "engine/sim/bonds.h"

#include <btBulletCollisionCommon.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/sim/bullet_convert.h"
#include "engine/sim/constraint_rows.h"

namespace stampede {
namespace {

constexpr double kHold = 1e3;  // N s or N m s at most

Transform joint_on(const Bond& bond) { return from_bullet(bond.on->getWorldTransform()) * bond.on_from_joint; }
Transform joint_of(const Bond& bond) {
  return from_bullet(bond.body->object->getWorldTransform()) * bond.body_from_joint;
}

// Of the body's side of the joint against the other side, about the axis: -pi … pi.
double angle(const Bond& bond, const Transform& on, const Transform& own) {
  const Quaternion turn(Matrix3(on.linear().transpose() * own.linear()));
  return 2 * std::atan2(turn.vec().dot(bond.axis), turn.w());
}

double wrapped(double rad) { return std::remainder(rad, 2 * std::numbers::pi); }

}  // namespace

void Bond::place_body() const {
  Transform moved = Transform::Identity();
  if (kind != JointKind::slider) moved.linear() = Eigen::AngleAxisd(position, axis).toRotationMatrix();
  const double way = kind == JointKind::slider ? 1 : lead;
  moved.translation() = way * position * axis;
  const Transform pose = joint_on(*this) * moved * body_from_joint.inverse();
  body->object->setWorldTransform(to_bullet(pose));
}

void Bond::follow_body() {
  if (!holds) return;
  const Transform there = joint_on(*this), here = joint_of(*this);
  if (kind == JointKind::slider)
    position = (here.translation() - there.translation()).dot(there.linear() * axis);
  else
    position += wrapped(angle(*this, there, here) - position);
  holds = upwards ? position < lets_go : position > lets_go;
}

bool Bond::joins(const btCollisionObject& one, const btCollisionObject& other) const {
  return holds && body->object == &one && other.getUserIndex() == on->getUserIndex();
}

void add_bond_rows(const Bond& bond, ConstraintRows& rows, std::vector<SolverRow>& into) {
  const MoverLink on = MoverLink::of(bond.on), own = MoverLink::of(bond.body->object);
  const Transform there = joint_on(bond), here = joint_of(bond);
  const Vector3 axis = there.linear() * bond.axis, point = here.translation();
  const Vector3 gap = point - there.translation();
  const Vector3 tilt = Vector3(here.linear() * bond.axis).cross(axis);  // that would bring the axes together
  const Vector3 one = axis.unitOrthogonal(), other = axis.cross(one);
  const auto add_row = [&](const Vector3& linear, const Vector3& angular, double error) -> SolverRow& {
    SolverRow& row = rows.begin(into);
    rows.add_screw(row, own, point, linear, angular);
    rows.add_screw(row, on, point, -linear, -angular);
    rows.end(row, -error * ConstraintRows::kErp / rows.dt());
    row.lower = -kHold;
    row.upper = kHold;
    return row;
  };
  const Vector3 none = Vector3::Zero();
  for (const Vector3& across : {one, other}) {
    add_row(across, none, gap.dot(across));
    add_row(none, across, -tilt.dot(across));
  }
  const bool slides = bond.kind == JointKind::slider;
  if (slides)
    add_row(none, axis, angle(bond, there, here));
  else
    add_row(axis, -bond.lead * axis, gap.dot(axis) - bond.lead * bond.position);
  const Vector3 along = slides ? axis : none, about = slides ? none : axis;
  if (bond.friction > 0) {
    SolverRow& row = add_row(along, about, 0);
    row.upper = bond.friction * rows.dt();
    row.lower = -row.upper;
  }
  if (!(bond.lower < bond.upper)) return;
  for (const double sign : {1.0, -1.0}) {
    const double room = sign > 0 ? bond.position - bond.lower : bond.upper - bond.position;
    if (room > 0) continue;
    add_row(sign * along, sign * about, room).lower = 0;
  }
}

}  // namespace stampede
