#include "engine/sim/articulation.h"

#include <btBulletCollisionCommon.h>

#include <Eigen/Geometry>
#include <cmath>

#include "engine/sim/bullet_convert.h"

namespace stampede {

int Articulation::add(const Link& link) {
  Place place;
  if (link.kind != JointKind::fixed) {
    place.dof = dofs();
    position.push_back(0);
    velocity.push_back(0);
    torque.push_back(0);
  }
  links_.push_back(link);
  places_.push_back(place);
  motions_.resize(links_.size());
  composites_.resize(links_.size());
  inertias_.resize(links_.size());
  const auto count = static_cast<std::size_t>(dofs());
  bias_.assign(count, 0);
  mass_.assign(count * count, 0);
  factor_.assign(count * count, 0);
  inverse_.assign(count * static_cast<std::size_t>(width()), 0);
  return static_cast<int>(links_.size()) - 1;
}

void Articulation::place() {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    Place& here = places_[i];
    const bool on_base = link.parent < 0;
    const Place& parent = places_[static_cast<std::size_t>(on_base ? 0 : link.parent)];
    const Matrix3 parent_turn = on_base ? Matrix3(world_from_base_.linear()) : parent.turn;
    const Vector3 parent_origin = on_base ? Vector3(world_from_base_.translation()) : parent.origin;
    here.turn = parent_turn * link.parent_from_joint.linear();
    here.origin = parent_turn * link.parent_from_joint.translation() + parent_origin;
    here.axis = here.turn * link.axis;
    if (link.kind == JointKind::hinge)
      here.turn *= Eigen::AngleAxisd(position[static_cast<std::size_t>(here.dof)], link.axis).toRotationMatrix();
    else if (link.kind == JointKind::slider)
      here.origin += position[static_cast<std::size_t>(here.dof)] * here.axis;
    here.centre = here.turn * link.centre + here.origin;
    btTransform pose(to_bullet(Matrix3(here.turn * link.link_from_object.linear())),
                     to_bullet(Vector3(here.turn * link.link_from_object.translation() + here.origin)));
    link.object->setWorldTransform(pose);
  }
}

void Articulation::prepare(const Vector3& gravity) {
  for (std::size_t i = 0; i < links_.size(); ++i)
    inertias_[i] = places_[i].turn * links_[i].inertia * places_[i].turn.transpose();
  find_bias(gravity);
  find_mass();
  invert_mass();
}

void Articulation::find_bias(const Vector3& gravity) {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    const Place& here = places_[i];
    Motion& motion = motions_[i];
    motion.linear = motion.angular = motion.linear_rate = motion.angular_rate = Vector3::Zero();
    if (link.parent >= 0) {
      const Motion& parent = motions_[static_cast<std::size_t>(link.parent)];
      const Vector3 arm = here.origin - places_[static_cast<std::size_t>(link.parent)].origin;
      motion.angular = parent.angular;
      motion.angular_rate = parent.angular_rate;
      motion.linear = parent.linear + parent.angular.cross(arm);
      motion.linear_rate =
          parent.linear_rate + parent.angular_rate.cross(arm) + parent.angular.cross(parent.angular.cross(arm));
    }
    if (here.dof >= 0) {
      const Vector3 rate = velocity[static_cast<std::size_t>(here.dof)] * here.axis;
      if (link.kind == JointKind::hinge) {
        motion.angular_rate += motion.angular.cross(rate);
        motion.angular += rate;
      } else {
        motion.linear_rate += 2 * motion.angular.cross(rate);
        motion.linear += rate;
      }
    }
    const Vector3 arm = here.centre - here.origin;
    const Vector3 rate =
        motion.linear_rate + motion.angular_rate.cross(arm) + motion.angular.cross(motion.angular.cross(arm));
    motion.force = link.mass * (rate - gravity);
    motion.moment = inertias_[i] * motion.angular_rate + motion.angular.cross(inertias_[i] * motion.angular) +
                    arm.cross(motion.force);
  }
  for (std::size_t i = links_.size(); i-- > 0;) {
    const Place& here = places_[i];
    const Motion& motion = motions_[i];
    if (here.dof >= 0)
      bias_[static_cast<std::size_t>(here.dof)] =
          here.axis.dot(links_[i].kind == JointKind::hinge ? motion.moment : motion.force);
    if (links_[i].parent < 0) continue;
    const auto p = static_cast<std::size_t>(links_[i].parent);
    motions_[p].force += motion.force;
    motions_[p].moment += motion.moment + (here.origin - places_[p].origin).cross(motion.force);
  }
}

void Articulation::find_mass() {
  const Vector3 base = world_from_base_.translation();
  const auto count = static_cast<std::size_t>(dofs());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Vector3 centre = places_[i].centre - base;
    Composite& composite = composites_[i];
    composite.mass = links_[i].mass;
    composite.moment = composite.mass * centre;
    composite.inertia =
        inertias_[i] + composite.mass * (centre.squaredNorm() * Matrix3::Identity() - centre * centre.transpose());
  }
  std::fill(mass_.begin(), mass_.end(), 0.0);
  const auto at_base = [&](const Place& place, JointKind kind) -> Vector3 {  // speed there, at unit speed of the joint
    return kind == JointKind::hinge ? Vector3((place.origin - base).cross(place.axis)) : place.axis;
  };
  for (std::size_t i = links_.size(); i-- > 0;) {
    const Composite& composite = composites_[i];
    const Place& here = places_[i];
    const bool turns = links_[i].kind == JointKind::hinge;
    if (here.dof >= 0) {
      const Vector3 linear = at_base(here, links_[i].kind);
      Vector3 momentum = composite.mass * linear, spin = composite.moment.cross(linear);
      if (turns) {
        momentum += here.axis.cross(composite.moment);
        spin += composite.inertia * here.axis;
      }
      const auto row = static_cast<std::size_t>(here.dof);
      for (int at = static_cast<int>(i); at >= 0; at = links_[static_cast<std::size_t>(at)].parent) {
        const Place& other = places_[static_cast<std::size_t>(at)];
        if (other.dof < 0) continue;
        const JointKind kind = links_[static_cast<std::size_t>(at)].kind;
        double inertia = at_base(other, kind).dot(momentum);
        if (kind == JointKind::hinge) inertia += other.axis.dot(spin);
        const auto column = static_cast<std::size_t>(other.dof);
        mass_[row * count + column] = mass_[column * count + row] = inertia;
      }
    }
    if (links_[i].parent < 0) continue;
    Composite& parent = composites_[static_cast<std::size_t>(links_[i].parent)];
    parent.mass += composite.mass;
    parent.moment += composite.moment;
    parent.inertia += composite.inertia;
  }
}

// By Cholesky factors: M = L L^T, and M^-1 = L^-T L^-1.
void Articulation::invert_mass() {
  const auto n = static_cast<std::size_t>(dofs()), stride = static_cast<std::size_t>(width());
  const auto l = [&](std::size_t row, std::size_t column) -> double& { return factor_[row * n + column]; };
  for (std::size_t j = 0; j < n; ++j) {
    double diagonal = mass_[j * n + j];
    for (std::size_t k = 0; k < j; ++k) diagonal -= l(j, k) * l(j, k);
    l(j, j) = 1 / std::sqrt(diagonal);  // its inverse: only that is needed
    for (std::size_t i = j + 1; i < n; ++i) {
      double sum = mass_[i * n + j];
      for (std::size_t k = 0; k < j; ++k) sum -= l(i, k) * l(j, k);
      l(i, j) = sum * l(j, j);
    }
  }
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = j + 1; i < n; ++i) {
      double sum = 0;
      for (std::size_t k = j; k < i; ++k) sum -= l(i, k) * l(k, j);
      l(i, j) = sum * l(i, i);
    }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = 0;
      for (std::size_t k = i; k < n; ++k) sum += l(k, i) * l(k, j);
      inverse_[i * stride + j] = inverse_[j * stride + i] = sum;
    }
}

}  // namespace stampede
