// Bonds: a free body on a joint of something else, which it leaves at a limit.
#include <btBulletCollisionCommon.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/sim/bullet_convert.h"
#include "engine/sim/dynamics.h"

namespace stampede {
namespace {

constexpr double kErp = 0.2;   // share of an error in position that a step takes away
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

Bond& Dynamics::add_bond(const Bond& bond) {
  bonds_.push_back(bond);
  place_bond(bonds_.back());
  return bonds_.back();
}

void Dynamics::place_bond(Bond& bond) {
  Transform moved = Transform::Identity();
  if (bond.kind != JointKind::slider) moved.linear() = Eigen::AngleAxisd(bond.position, bond.axis).toRotationMatrix();
  const double way = bond.kind == JointKind::slider ? 1 : bond.lead;
  moved.translation() = way * bond.position * bond.axis;
  const Transform pose = joint_on(bond) * moved * bond.body_from_joint.inverse();
  bond.body->object->setWorldTransform(to_bullet(pose));
}

// What is joined does not touch: neither the other part nor what that belongs to.
bool Dynamics::bonded(const btCollisionObject& one, const btCollisionObject& other) const {
  return std::any_of(bonds_.begin(), bonds_.end(), [&](const Bond& bond) {
    if (!bond.holds) return false;
    const int host = bond.on->getUserIndex();
    return (bond.body->object == &one && other.getUserIndex() == host) ||
           (bond.body->object == &other && one.getUserIndex() == host);
  });
}

void Dynamics::add_bond_rows(const Bond& bond) {
  const Node on = node_of(bond.on), own = node_of(bond.body->object);
  const Transform there = joint_on(bond), here = joint_of(bond);
  const Vector3 axis = there.linear() * bond.axis, point = here.translation();
  const Vector3 gap = point - there.translation();
  const Vector3 tilt = Vector3(here.linear() * bond.axis).cross(axis);  // that would bring the axes together
  const Vector3 one = axis.unitOrthogonal(), other = axis.cross(one);
  const auto add_row = [&](const Vector3& linear, const Vector3& angular, double error) -> SolverRow& {
    SolverRow& row = begin_row(joints_);
    add_screw(row, own, point, linear, angular);
    add_screw(row, on, point, -linear, -angular);
    end_row(row, -error * kErp / dt_);
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
    row.upper = bond.friction * dt_;
    row.lower = -row.upper;
  }
  if (!(bond.lower < bond.upper)) return;
  for (const double sign : {1.0, -1.0}) {
    const double room = sign > 0 ? bond.position - bond.lower : bond.upper - bond.position;
    if (room > 0) continue;
    add_row(sign * along, sign * about, room).lower = 0;
  }
}

void Dynamics::move_bonds() {
  for (Bond& bond : bonds_) {
    if (!bond.holds) continue;
    const Transform there = joint_on(bond), here = joint_of(bond);
    if (bond.kind == JointKind::slider)
      bond.position = (here.translation() - there.translation()).dot(there.linear() * bond.axis);
    else
      bond.position += wrapped(angle(bond, there, here) - bond.position);
    bond.holds = bond.upwards ? bond.position < bond.lets_go : bond.position > bond.lets_go;
  }
}

}  // namespace stampede
