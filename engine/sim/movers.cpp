#include "engine/sim/movers.h"

#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <cmath>

#include "engine/sim/bullet_convert.h"

namespace stampede {
namespace {

constexpr double kRestSpeed = 5e-4, kRestSpin = 5e-3;  // m/s, rad/s: slower is at rest
constexpr double kTrembling = 10;                      // times that

}  // namespace

Matrix3 FreeBody::principal_axes() const { return from_bullet(object->getWorldTransform()).linear(); }

Matrix3 FreeBody::inverse_inertia() const {
  const Matrix3 turn = principal_axes();
  return turn * moments.cwiseInverse().asDiagonal() * turn.transpose();
}

void Mover::set_asleep(bool sleeps) {
  asleep = sleeps;
  for (btCollisionObject* object : objects)
    object->forceActivationState(asleep ? ISLAND_SLEEPING : DISABLE_DEACTIVATION);
  if (!asleep) return;
  if (free) free->linear = free->angular = Vector3::Zero();
  if (tree) std::fill(tree->velocity.begin(), tree->velocity.end(), 0.0);
}

bool Mover::slower(double than) const {
  const double speed = than * kRestSpeed, spin = than * kRestSpin;
  if (const auto twist = free_twist();
      twist && (twist->first.squaredNorm() >= speed * speed || twist->second.squaredNorm() >= spin * spin))
    return false;
  if (!tree) return true;
  const auto joints = tree->velocity.begin() + (tree->floating() ? 6 : 0);
  return std::all_of(joints, tree->velocity.end(), [&](double rate) { return std::abs(rate) < speed; });
}

std::optional<std::pair<Vector3, Vector3>> Mover::free_twist() const {
  if (free) return std::pair(free->linear, free->angular);
  if (!tree->floating()) return std::nullopt;
  const std::vector<double>& v = tree->velocity;
  return std::pair(Vector3(v[0], v[1], v[2]), Vector3(v[3], v[4], v[5]));
}

bool Mover::at_rest() const {
  if (!free_twist()) return slower(1);
  return slower(kTrembling) && mean_linear.squaredNorm() < kRestSpeed * kRestSpeed &&
         mean_angular.squaredNorm() < kRestSpin * kRestSpin;
}

Vector3 Mover::velocity_at(int link, const Vector3& point) const {
  if (free)
    return free->linear + free->angular.cross(point - from_bullet(free->object->getWorldTransform().getOrigin()));
  Vector3 velocity = Vector3::Zero();
  tree->jacobian(link, point, [&](int dof, const Vector3& linear, const Vector3&) {
    velocity += tree->velocity[static_cast<std::size_t>(dof)] * linear;
  });
  return velocity;
}

MoverLink MoverLink::of(const btCollisionObject* object) {
  const auto* node = static_cast<const MoverLink*>(object->getUserPointer());
  return node ? *node : MoverLink{};
}

FreeBody& Movers::add_free(const FreeBody& body) {
  free_.push_back(body);
  Mover mover;
  mover.free = &free_.back();
  mover.quads = 2;
  links_.push_back({static_cast<int>(movers_.size()), -1});
  body.object->setUserPointer(&links_.back());
  mover.objects.push_back(body.object);
  movers_.push_back(mover);
  return free_.back();
}

Articulation& Movers::add_tree(const Transform& world_from_base, bool floating, bool may_sleep) {
  trees_.emplace_back(world_from_base, floating);
  Mover mover;
  mover.tree = &trees_.back();
  mover.may_sleep = may_sleep;
  movers_.push_back(mover);
  return trees_.back();
}

Mover& Movers::mover_of(const Articulation& tree) {
  return *std::find_if(movers_.begin(), movers_.end(), [&](const Mover& mover) { return mover.tree == &tree; });
}

void Movers::add_object(btCollisionObject& object, Articulation& tree, int link) {
  Mover& mover = mover_of(tree);
  links_.push_back({static_cast<int>(&mover - movers_.data()), link});
  object.setUserPointer(&links_.back());
  mover.objects.push_back(&object);
}

JointMotor& Movers::add_motor(Articulation& tree, int dof) {
  motors_.push_back({});
  motors_.back().dof = dof;
  mover_of(tree).motors.push_back(&motors_.back());
  return motors_.back();
}

void Movers::set_brakes(Articulation& tree, std::vector<SpeedBrake> brakes) {
  mover_of(tree).brakes = std::move(brakes);
}

Bond& Movers::add_bond(const Bond& bond) {
  bonds_.push_back(bond);
  bonds_.back().place_body();
  return bonds_.back();
}

bool Movers::bonded(const btCollisionObject& one, const btCollisionObject& other) const {
  return std::any_of(bonds_.begin(), bonds_.end(),
                     [&](const Bond& bond) { return bond.joins(one, other) || bond.joins(other, one); });
}

bool Movers::holds_in(const Bond& bond, int island) const {
  return bond.holds && (*this)[MoverLink::of(bond.body->object).mover].island == island;
}

}  // namespace stampede
