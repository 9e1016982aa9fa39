#include "engine/sim/dynamics.h"

#include <btBulletCollisionCommon.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "engine/sim/bullet_convert.h"

namespace stampede {
namespace {

constexpr double kFastestJoint = 100;  // m/s or rad/s
constexpr double kSlowSpin = 1e-4;     // rad/s: gyroscopic torque is left out below

Matrix3 skew(const Vector3& v) {
  Matrix3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// The spin after a step of torque-free rotation: one implicit step, which neither gains energy nor tumbles apart at
// 240 Hz (Catto, Numerical Methods, GDC 2015).
Vector3 after_gyration(const FreeBody& body, double dt) {
  const Matrix3 turn = body.principal_axes();
  const Vector3 local = turn.transpose() * body.angular, momentum = body.moments.cwiseProduct(local);
  const Vector3 error = dt * local.cross(momentum);
  Matrix3 slope = body.moments.asDiagonal();
  slope += dt * (skew(local) * Matrix3(body.moments.asDiagonal()) - skew(momentum));
  return turn * (local - slope.inverse() * error);
}

}  // namespace

Dynamics::Dynamics(ContactFinder& finder, const Vector3& gravity, double dt)
    : finder_(finder),
      gravity_(gravity),
      dt_(dt),
      sleep_(finder.world, movers_, dt),
      encounters_(finder, movers_, gravity, dt),
      islands_(finder.world, movers_),
      solver_(movers_, speeds_, gravity, dt) {}

void Dynamics::step(int iterations) {
  finder_.find();
  encounters_.find();
  solver_.forget_torsions();
  sleep_.wake_what_is_met();
  apply_forces();
  speeds_.untouched = speeds_.now;
  islands_.find();
  for (const Island& island : islands_.all()) solver_.solve(island, iterations);
  move();
  encounters_.forget();
  if (may_sleep_) sleep_.fall_asleep(islands_.all());
}

void Dynamics::let_sleep(bool sleep) {
  may_sleep_ = sleep;
  forget_contacts();
}

void Dynamics::forget_contacts() {
  solver_.forget_torsions();
  sleep_.wake_all();
}

std::vector<Rest> Dynamics::rest() const { return {movers_.all().begin(), movers_.all().end()}; }

void Dynamics::set_rest(const std::vector<Rest>& rest) {
  std::vector<Mover>& movers = movers_.all();
  for (std::size_t m = 0; m < movers.size(); ++m) static_cast<Rest&>(movers[m]) = rest[m];
}

void Dynamics::apply_forces() {
  int quads = 0;
  for (Mover& mover : movers_.all()) {
    if (mover.tree) mover.quads = mover.tree->width() / 4;
    mover.at = quads;
    quads += mover.quads;
  }
  speeds_.now.assign(static_cast<std::size_t>(quads), Quad{});
  for (Mover& mover : movers_.all()) {
    if (mover.asleep) {
      if (mover.tree) std::fill(mover.tree->torque.begin(), mover.tree->torque.end(), 0.0);  // or it would add up
      continue;
    }
    double* speeds = speeds_.of(mover);
    if (mover.free) {
      FreeBody& body = *mover.free;
      mover.inverse_inertia = body.inverse_inertia();
      const Vector3 linear = body.linear + dt_ * gravity_;
      const Vector3 angular =
          body.angular.squaredNorm() > kSlowSpin * kSlowSpin ? after_gyration(body, dt_) : body.angular;
      for (int i = 0; i < 3; ++i) {
        speeds[i] = linear[i];
        speeds[3 + i] = angular[i];
      }
      continue;
    }
    Articulation& tree = *mover.tree;
    tree.prepare(gravity_);
    for (int i = 0; i < tree.dofs(); ++i) {
      double acceleration = 0;
      for (int j = 0; j < tree.dofs(); ++j) {
        const auto k = static_cast<std::size_t>(j);
        acceleration += tree.inverse_mass(i)[j] * (tree.torque[k] - tree.bias()[k]);
      }
      speeds[i] = tree.velocity[static_cast<std::size_t>(i)] + dt_ * acceleration;
    }
    std::fill(tree.torque.begin(), tree.torque.end(), 0.0);
  }
}

void Dynamics::move() {
  for (const Mover& mover : movers_.all()) {
    if (mover.asleep) continue;
    const double* speeds = speeds_.of(mover);
    if (mover.free) {
      FreeBody& body = *mover.free;
      body.linear = {speeds[0], speeds[1], speeds[2]};
      body.angular = {speeds[3], speeds[4], speeds[5]};
      btTransform& world_from_body = body.object->getWorldTransform();
      world_from_body.getOrigin() += to_bullet(Vector3(dt_ * body.linear));
      world_from_body.setBasis(to_bullet(turned_by(from_bullet(world_from_body).linear(), body.angular, dt_)));
      continue;
    }
    Articulation& tree = *mover.tree;
    for (std::size_t i = 0; i < tree.velocity.size(); ++i)
      tree.velocity[i] = std::clamp(speeds[i], -kFastestJoint, kFastestJoint);
    tree.move(dt_);
  }
  for (Bond& bond : movers_.bonds()) bond.follow_body();
}

}  // namespace stampede
