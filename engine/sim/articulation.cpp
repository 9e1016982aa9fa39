#include "engine/sim/articulation.h"

#include <btBulletCollisionCommon.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/sim/bullet_convert.h"

namespace stampede {

namespace {

constexpr int kFloatingDofs = 6;
constexpr double kLargestTurn = 0.785398163397448;  // rad a step

}  // namespace

Matrix3 turned_by(const Matrix3& rotation, const Vector3& spin, double dt) {
  const double speed = spin.norm();
  if (speed * dt < 1e-15) return rotation;
  const Matrix3 turned = Eigen::AngleAxisd(std::min(speed * dt, kLargestTurn), spin / speed) * rotation;
  return turned * (1.5 * Matrix3::Identity() - 0.5 * turned.transpose() * turned);  // stays a rotation
}

int Articulation::add(const Link& link) {
  Place place;
  const bool root = floating_ && links_.empty();
  place.dofs = root ? kFloatingDofs : link.kind == JointKind::fixed ? 0 : 1;
  if (place.dofs > 0) place.dof = dofs();
  links_.push_back(link);
  places_.push_back(place);
  motions_.resize(links_.size());
  composites_.resize(links_.size());
  inertias_.resize(links_.size());
  const auto count = position.size() + static_cast<std::size_t>(place.dofs);
  position.resize(count, 0);
  velocity.resize(count, 0);
  torque.resize(count, 0);
  twists_.resize(count);
  bias_.assign(count, 0);
  mass_.assign(count * count, 0);
  factor_.assign(count * count, 0);
  inverse_.assign(count * static_cast<std::size_t>(width()), 0);
  if (root) {  // its frame is the base's
    world_from_base_ = world_from_base_ * link.parent_from_joint;
    links_[0].parent_from_joint = Transform::Identity();
    for (int i = 0; i < 3; ++i) {
      twists_[static_cast<std::size_t>(i)].linear = Vector3::Unit(i);
      twists_[static_cast<std::size_t>(3 + i)].angular = Vector3::Unit(i);
    }
  }
  return static_cast<int>(links_.size()) - 1;
}

void Articulation::set_root(const Transform& world_from_root) {
  world_from_base_ = world_from_root;
  place();
}

void Articulation::move(double dt) {
  std::size_t first = 0;
  if (floating_) {
    first = kFloatingDofs;
    world_from_base_.translation() += dt * Vector3(velocity[0], velocity[1], velocity[2]);
    world_from_base_.linear() = turned_by(world_from_base_.linear(), {velocity[3], velocity[4], velocity[5]}, dt);
  }
  for (std::size_t i = first; i < position.size(); ++i) position[i] += dt * velocity[i];
  place();
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
    if (here.dofs == 1) {
      const double q = position[static_cast<std::size_t>(here.dof)];
      const Vector3 axis = here.turn * link.axis;
      Twist& twist = twists_[static_cast<std::size_t>(here.dof)];
      if (link.kind == JointKind::slider) {
        twist.linear = axis;
      } else {
        twist.linear = link.lead * axis;
        twist.angular = axis;
        here.turn *= Eigen::AngleAxisd(q, link.axis).toRotationMatrix();
      }
      here.origin += q * twist.linear;
    }
    here.centre = here.turn * link.centre + here.origin;
    btTransform pose(to_bullet(Matrix3(here.turn * link.link_from_object.linear())),
                     to_bullet(Vector3(here.turn * link.link_from_object.translation() + here.origin)));
    link.object->setWorldTransform(pose);
  }
}

const std::vector<double>& Articulation::find_coriolis() {
  find_bias(Vector3::Zero());
  return bias_;
}

void Articulation::prepare(const Vector3& gravity) {
  find_bias(gravity);
  find_mass();
  invert_mass();
}

void Articulation::find_bias(const Vector3& gravity) {
  for (std::size_t i = 0; i < links_.size(); ++i)
    inertias_[i] = places_[i].turn * links_[i].inertia * places_[i].turn.transpose();
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
    Vector3 rate = Vector3::Zero(), spin = Vector3::Zero();  // relative to the parent
    for (int dof = here.dof; dof < here.dof + here.dofs; ++dof) {
      rate += velocity[static_cast<std::size_t>(dof)] * twists_[static_cast<std::size_t>(dof)].linear;
      spin += velocity[static_cast<std::size_t>(dof)] * twists_[static_cast<std::size_t>(dof)].angular;
    }
    motion.angular_rate += motion.angular.cross(spin);
    motion.linear_rate += 2 * motion.angular.cross(rate);
    motion.angular += spin;
    motion.linear += rate;
    const Vector3 arm = here.centre - here.origin;
    const Vector3 acceleration =
        motion.linear_rate + motion.angular_rate.cross(arm) + motion.angular.cross(motion.angular.cross(arm));
    motion.force = link.mass * (acceleration - gravity);
    motion.moment = inertias_[i] * motion.angular_rate + motion.angular.cross(inertias_[i] * motion.angular) +
                    arm.cross(motion.force);
  }
  for (std::size_t i = links_.size(); i-- > 0;) {
    const Place& here = places_[i];
    const Motion& motion = motions_[i];
    for (int dof = here.dof; dof < here.dof + here.dofs; ++dof) {
      const Twist& twist = twists_[static_cast<std::size_t>(dof)];
      bias_[static_cast<std::size_t>(dof)] = twist.linear.dot(motion.force) + twist.angular.dot(motion.moment);
    }
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
  const auto at_base = [&](const Place& place, const Twist& twist) -> Vector3 {  // the speed there
    return twist.linear + (place.origin - base).cross(twist.angular);
  };
  for (std::size_t i = links_.size(); i-- > 0;) {
    const Composite& composite = composites_[i];
    const Place& here = places_[i];
    for (int row = here.dof; row < here.dof + here.dofs; ++row) {
      const Twist& twist = twists_[static_cast<std::size_t>(row)];
      const Vector3 linear = at_base(here, twist);
      const Vector3 momentum = composite.mass * linear + twist.angular.cross(composite.moment);
      const Vector3 spin = composite.moment.cross(linear) + composite.inertia * twist.angular;
      for (int at = static_cast<int>(i); at >= 0; at = links_[static_cast<std::size_t>(at)].parent) {
        const Place& other = places_[static_cast<std::size_t>(at)];
        for (int column = other.dof; column < other.dof + other.dofs; ++column) {
          const Twist& against = twists_[static_cast<std::size_t>(column)];
          const double inertia = at_base(other, against).dot(momentum) + against.angular.dot(spin);
          const auto r = static_cast<std::size_t>(row), c = static_cast<std::size_t>(column);
          mass_[r * count + c] = mass_[c * count + r] = inertia;
        }
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
