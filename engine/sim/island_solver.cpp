#include "engine/sim/island_solver.h"

#include <btBulletCollisionCommon.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/sim/bullet_convert.h"

namespace stampede {
namespace {

// Contacts start with a share of the impulse that they had in the step before, and without friction. With a robot among
// them they keep less, and least on links: what is pressed into a hole sticks and jumps otherwise.
constexpr double kKept = 1, kKeptBesideRobot = 0.85, kKeptOnRobot = 0.4;
// What settles without a robot comes to rest, and sleeps, if iterations suffice: five stacked cubes need 200. So does
// what a strong hand presses into its fingers come out of them: 20 left a pawn 4 mm deep, trembling. (What stands still
// may well be met softly.)
constexpr int kPatience = 200;
constexpr double kDeep_m = 5e-4;
// Among free bodies alone what lies in each other parts no faster than so, or than they are. Among them and a robot no
// contact bears more than so many times the momentum that all of them have or that a step presses into them, and more
// where a robot presses. What is jammed asks for two things at once, and for more in every step.
constexpr double kParting = 0.1;  // m/s
constexpr double kWedge = 10;
constexpr double kPressed = 250;      // N
constexpr double kStopImpulse = 100;  // N s at most
constexpr double kSettled = 1e-6;     // m/s or rad/s: an iteration that changes no more is the last
// Where none was the last, what moves slowly without a robot keeps this share of its speed: it would rock for ever.
constexpr double kUndecided = 0.95;
constexpr double kBounceSpeed = 0.2;                    // m/s: nothing bounces below
constexpr double kNearlyTooFast = 0.5;                  // share of what a brake allows: slower, it is left out
constexpr double kSoftForce = 80;                       // N, of a pair
constexpr double kSoft_m = 0.0008, kHardness = 60'000;  // N/m
constexpr double kSettling = 100;                       // times the speed of rest

// The greatest force of one point of contact with a robot, N. Its skin, pads and joints give way a little: perfectly
// rigid, 5 kg at a decimetre a second would strike with 120 N, all in one step. So it takes some steps, within a
// millimetre; deeper, it gets hard.
double softened(double distance, const Touching& touching) {
  const double most = kSoftForce + kHardness * std::max(0.0, -distance - kSoft_m);
  return most * touching.weight(-distance) / touching.weights;
}

// Two directions across a unit one.
void tangents(const Vector3& normal, Vector3& one, Vector3& other) {
  if (std::abs(normal.z()) > 0.70710678118654752) {
    const double scale = 1 / std::sqrt(normal.y() * normal.y() + normal.z() * normal.z());
    one = {0, -normal.z() * scale, normal.y() * scale};
  } else {
    const double scale = 1 / std::sqrt(normal.x() * normal.x() + normal.y() * normal.y());
    one = {-normal.y() * scale, normal.x() * scale, 0};
  }
  other = normal.cross(one);
}

}  // namespace

void IslandSolver::clear() {
  rows_.clear();
  joints_.clear();
  contact_rows_.clear();
  motor_rows_.clear();
  contacts_.clear();
  touched_.clear();
  parting_ = 0;
}

IslandSolver::Members IslandSolver::members_of(const Island& island) const {
  Members members;
  for (const Mover& mover : movers_.all()) {
    if (mover.island != island.number) continue;
    members.robot = members.robot || !mover.may_sleep;
    members.mechanism = members.mechanism || (mover.tree && mover.may_sleep);
    members.settling = members.settling && mover.may_sleep && mover.slower(kSettling);
  }
  return members;
}

IslandSolver::Bounds IslandSolver::bounds_of(const Members& members, const Motion& motion) const {
  Bounds bounds;
  if (!members.mechanism) bounds.impulse = kWedge * motion.momentum + (members.robot ? dt_ * kPressed : 0);
  if (members.alone()) bounds.parting = std::max(kParting, std::sqrt(2 * motion.energy / motion.mass));
  return bounds;
}

// Those on links last; returns how many come before them.
std::size_t IslandSolver::add_all_contacts(const Island& island, const Members& members, const Bounds& bounds) {
  for (const Touching& touching : island.touching)
    if (!touching.on_link) add_contacts(touching, members.robot ? kKeptBesideRobot : kKept, bounds);
  const std::size_t others = contacts_.size();
  for (const Touching& touching : island.touching)
    if (touching.on_link) add_contacts(touching, members.robot ? kKeptOnRobot : kKept, bounds);
  return others;
}

bool IslandSolver::any_deep() const {
  return std::any_of(touched_.begin(), touched_.end(), [](const Touched& touched) {
    return touched.point->getDistance() < -kDeep_m && MoverLink::of(touched.first).mover >= 0 &&
           MoverLink::of(touched.second).mover >= 0;
  });
}

void IslandSolver::solve(const Island& island, int iterations) {
  const Members members = members_of(island);
  const Motion before = members.mechanism ? Motion{} : free_motion(island);
  clear();
  const std::size_t link_contacts = add_all_contacts(island, members, bounds_of(members, before));
  for (const Mover& mover : movers_.all())
    if (mover.tree && mover.island == island.number) add_joints(mover);
  const std::size_t joints = joints_.size();
  for (const Bond& bond : movers_.bonds())
    if (movers_.holds_in(bond, island.number)) add_bond_rows(bond, rows_, joints_);
  rows_.scale(contact_rows_);
  rows_.scale(joints_);
  if (members.settling || any_deep()) iterations = std::max(iterations, kPatience);
  const SolverIsland all{rows_.numbers(),        speeds_.now.data(), contact_rows_.data(), joints_.data(),
                         contacts_.data(),       link_contacts,      contacts_.size(),     joints,
                         joints_.size() - joints};
  bool agreed = false;
  if (members.settling) watch(island);
  for (int i = 0; i < iterations && !agreed; ++i) {
    agreed = solve_rows_(all, i % 2 == 1) <= kSettled;
    // Contacts that bear together may pass impulses round for ever, and nothing goes otherwise for it.
    if (members.settling && !changed()) break;
  }
  if (members.alone()) take_no_energy(island, before);
  if (members.alone() && members.settling && !agreed) slow_down(island, kUndecided);
  keep_results();
}

void IslandSolver::watch(const Island& island) {
  watched_.clear();
  for (const Mover& mover : movers_.all()) {
    if (mover.island != island.number) continue;
    for (int quad = mover.at; quad < mover.at + mover.quads; ++quad)
      watched_.push_back({static_cast<std::size_t>(quad), speeds_.now[static_cast<std::size_t>(quad)]});
  }
}

bool IslandSolver::changed() {
  double most = 0;
  for (Watched& watched : watched_) {
    const Quad& now = speeds_.now[watched.quad];
    for (int i = 0; i < 4; ++i) most = std::max(most, std::abs(now.v[i] - watched.speeds.v[i]));
    watched.speeds = now;
  }
  return most > kSettled;
}

IslandSolver::Motion IslandSolver::free_motion(const Island& island) const {
  Motion motion;
  const double pressed = dt_ * gravity_.norm() + kParting;  // m/s
  for (const Mover& mover : movers_.all()) {
    if (mover.island != island.number || !mover.free) continue;
    const FreeBody& body = *mover.free;
    const double* speeds = speeds_.of(mover);
    const Matrix3 turn = from_bullet(body.object->getWorldTransform()).linear();
    const Vector3 linear(speeds[0], speeds[1], speeds[2]);
    const Vector3 spin = turn.transpose() * Vector3(speeds[3], speeds[4], speeds[5]);
    const double energy = (body.mass * linear.squaredNorm() + spin.dot(body.moments.cwiseProduct(spin))) / 2;
    motion.energy += energy;
    motion.momentum += std::sqrt(2 * body.mass * energy) + body.mass * pressed;
    motion.mass += body.mass;
  }
  return motion;
}

// Contacts only take energy away, but for what parts from what it lies in and hardly moves. Where those of a wedge have
// not agreed within the iterations, or a wobbling plate is pushed out of the floor at one place after the other, all
// goes slower.
void IslandSolver::take_no_energy(const Island& island, const Motion& before) {
  const double now = free_motion(island).energy;
  const double parting = std::min(parting_, kParting);
  const double most = std::max(before.energy, before.mass * parting * parting / 2);
  if (now <= most) return;
  slow_down(island, std::sqrt(most / now));
}

void IslandSolver::slow_down(const Island& island, double share) {
  for (const Mover& mover : movers_.all()) {
    if (mover.island != island.number) continue;
    double* speeds = speeds_.of(mover);
    for (int i = 0; i < 6; ++i) speeds[i] *= share;
  }
}

void IslandSolver::add_contacts(const Touching& touching, double kept, const Bounds& bounds) {
  btPersistentManifold& manifold = *touching.manifold;
  const MoverLink one = MoverLink::of(manifold.getBody0()), other = MoverLink::of(manifold.getBody1());
  const auto robot = [&](const MoverLink& node) { return node.mover >= 0 && !movers_[node.mover].may_sleep; };
  const bool of_robot = robot(one) || robot(other);
  for (int p = 0; p < manifold.getNumContacts(); ++p) {
    btManifoldPoint& point = manifold.getContactPoint(p);
    const Vector3 normal = from_bullet(point.m_normalWorldOnB);
    const Vector3 on_one = from_bullet(point.m_positionWorldOnA), on_other = from_bullet(point.m_positionWorldOnB);
    Vector3 across[2];
    tangents(normal, across[0], across[1]);
    SolverContact contact;
    contact.normal = static_cast<int>(contact_rows_.size());
    contact.friction = point.m_combinedFriction;
    contact.spinning = point.m_combinedSpinningFriction;
    contact.rolling = point.m_combinedRollingFriction;
    const double distance = point.getDistance();
    SolverRow& row = rows_.begin(contact_rows_);
    rows_.add_point(row, one, on_one, normal);
    rows_.add_point(row, other, on_other, -normal);
    rows_.end(row, distance > 0 ? -distance / dt_ : std::min(-distance * ConstraintRows::kErp / dt_, bounds.parting));
    parting_ = std::max(parting_, row.target);
    if (point.m_combinedRestitution > 0) {
      const double approach = rows_.speed_of(row);
      if (approach < -kBounceSpeed) row.target -= point.m_combinedRestitution * approach;
    }
    row.lower = 0;
    row.upper = of_robot ? dt_ * softened(distance, touching) : bounds.impulse;
    rows_.start(row, std::min(row.upper, kept * point.m_appliedImpulse));
    const bool anchored = (point.m_contactPointFlags & BT_CONTACT_FLAG_FRICTION_ANCHOR) != 0;
    for (int i = 0; i < 2; ++i) {
      SolverRow& friction = rows_.begin(contact_rows_);
      rows_.add_point(friction, one, on_one, across[i]);
      rows_.add_point(friction, other, on_other, -across[i]);
      rows_.end(friction, anchored ? -(on_one - on_other).dot(across[i]) * ConstraintRows::kErp / dt_ : 0);
    }
    point.m_lateralFrictionDir1 = to_bullet(across[0]);
    point.m_lateralFrictionDir2 = to_bullet(across[1]);
    if (touching.on_link || touching.narrow) {
      const auto add_torsion = [&](const Vector3& axis) {
        SolverRow& torsion = rows_.begin(contact_rows_);
        rows_.add_turn(torsion, one, axis);
        rows_.add_turn(torsion, other, -axis);
        rows_.end(torsion, 0);
        return static_cast<int>(contact_rows_.size()) - 1;
      };
      if (contact.spinning > 0) contact.spin = add_torsion(normal);
      if (contact.rolling > 0) {
        contact.roll = add_torsion(across[0]);
        add_torsion(across[1]);
      }
    }
    contacts_.push_back(contact);
    touched_.push_back({&point, manifold.getBody0(), manifold.getBody1()});
  }
}

void IslandSolver::add_joints(const Mover& mover) {
  const Articulation& tree = *mover.tree;
  const auto add_row = [&](int dof, int other, double ratio) -> SolverRow& {
    SolverRow& row = rows_.begin(joints_);
    double* jacobian = rows_.add_side(row, mover);
    jacobian[dof] = 1;
    if (other >= 0) jacobian[other] = -ratio;
    ConstraintRows::respond(tree, jacobian);
    return row;
  };
  const std::size_t first = joints_.size();
  for (JointMotor* motor : mover.motors) {
    motor->force = 0;
    if (!(motor->most_force > 0)) continue;
    SolverRow& row = add_row(motor->dof, -1, 0);
    const double error = motor->position - tree.position[static_cast<std::size_t>(motor->dof)];
    const double wanted = motor->velocity + motor->position_gain * motor->erp * error / dt_;
    rows_.end(row, std::clamp(wanted, -motor->fastest, motor->fastest));
    row.upper = motor->most_force * dt_;
    row.lower = -row.upper;
    motor_rows_.push_back({static_cast<int>(joints_.size()) - 1, motor});
  }
  start_motors(mover, first);
  for (const SpeedBrake& brake : mover.brakes) {
    const double speed = std::inner_product(brake.jacobian.begin(), brake.jacobian.end(), tree.velocity.begin(), 0.0);
    if (std::abs(speed) < kNearlyTooFast * brake.most_speed) continue;
    SolverRow& row = rows_.begin(joints_);
    double* jacobian = rows_.add_side(row, mover);
    for (std::size_t i = 0; i < brake.jacobian.size(); ++i)
      jacobian[i] = std::copysign(1.0, -speed) * brake.jacobian[i];
    ConstraintRows::respond(tree, jacobian);
    rows_.end(row, -brake.most_speed);
    row.upper = brake.most_force * dt_;
  }
  for (const JointGear& gear : mover.gears) {
    SolverRow& row = add_row(gear.one, gear.other, gear.ratio);
    const double error = tree.position[static_cast<std::size_t>(gear.one)] - gear.offset -
                         gear.ratio * tree.position[static_cast<std::size_t>(gear.other)];
    rows_.end(row, -gear.erp * error / dt_);
    row.upper = gear.most_force * dt_;
    row.lower = -row.upper;
  }
  for (const JointStop& stop : mover.stops) {
    const double q = tree.position[static_cast<std::size_t>(stop.dof)];
    for (const double sign : {1.0, -1.0}) {
      const double room = sign > 0 ? q - stop.lower : stop.upper - q;
      if (room > 0) continue;
      SolverRow& row = rows_.begin(joints_);
      double* jacobian = rows_.add_side(row, mover);
      jacobian[stop.dof] = sign;
      ConstraintRows::respond(tree, jacobian);
      rows_.end(row, -room * ConstraintRows::kErp / dt_);
      row.upper = kStopImpulse;
    }
  }
}

// Where every joint has one motor, the impulses that give all joints the speeds asked for are M (wanted - now): the
// answer, but for contacts and for motors at the end of their force. What a motor may give against contact counts from
// what it takes where nothing touches: from what contacts bore in the step before, force would grow step by step.
void IslandSolver::start_motors(const Mover& mover, std::size_t first) {
  const Articulation& tree = *mover.tree;
  const auto count = static_cast<std::size_t>(tree.dofs());
  if (joints_.size() - first != count || mover.motors.size() != count) return;
  const double* speeds = speeds_.of(mover);
  const double* untouched = speeds_.untouched[static_cast<std::size_t>(mover.at)].v;
  std::vector<double>& missing = scratch_;
  missing.assign(4 * count, 0);  // speeds: now; where nothing touches; and the impulses that give them
  double *now = missing.data(), *alone = now + count, *impulses = alone + count, *own = impulses + count;
  for (std::size_t i = 0; i < count; ++i) {
    const auto dof = static_cast<std::size_t>(mover.motors[i]->dof);
    now[dof] = joints_[first + i].target - speeds[dof];
    alone[dof] = joints_[first + i].target - untouched[dof];
  }
  bool able = true;  // each of them can do what is asked of it: else the others must make up for it
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      const double mass = tree.mass(mover.motors[i]->dof, static_cast<int>(j));
      impulses[i] += mass * now[j];
      own[i] += mass * alone[j];
    }
    able = able && (mover.motors[i]->against_contact == 0 || std::abs(own[i]) <= joints_[first + i].upper);
  }
  for (std::size_t i = 0; i < count; ++i) {
    SolverRow& row = joints_[first + i];
    if (const double most = dt_ * mover.motors[i]->against_contact; most > 0 && able) {
      row.lower = std::max(row.lower, own[i] - most);
      row.upper = std::min(row.upper, own[i] + most);
    }
    const double start = mover.motors[i]->presses ? std::copysign(row.upper, row.target) : impulses[i];
    row.impulse = std::clamp(start, row.lower, row.upper);
  }
  for (std::size_t i = 0; i < count; ++i) rows_.start(joints_[first + i], joints_[first + i].impulse);
}

void IslandSolver::keep_results() {
  for (const auto& [index, motor] : motor_rows_) {
    const SolverRow& row = joints_[static_cast<std::size_t>(index)];
    motor->force = row.impulse / dt_;
    motor->saturated = row.impulse <= row.lower || row.impulse >= row.upper;
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const SolverContact& contact = contacts_[i];
    btManifoldPoint& point = *touched_[i].point;
    const SolverRow* normal = &contact_rows_[static_cast<std::size_t>(contact.normal)];
    point.m_appliedImpulse = normal[0].impulse;
    point.m_appliedImpulseLateral1 = normal[1].impulse;
    point.m_appliedImpulseLateral2 = normal[2].impulse;
    if (contact.spin < 0 && contact.roll < 0) continue;
    Vector3 impulse = Vector3::Zero();
    if (contact.spin >= 0)
      impulse += contact_rows_[static_cast<std::size_t>(contact.spin)].impulse * from_bullet(point.m_normalWorldOnB);
    if (contact.roll >= 0) {
      const SolverRow* roll = &contact_rows_[static_cast<std::size_t>(contact.roll)];
      impulse += roll[0].impulse * from_bullet(point.m_lateralFrictionDir1) +
                 roll[1].impulse * from_bullet(point.m_lateralFrictionDir2);
    }
    torsions_.push_back({touched_[i].first, touched_[i].second, impulse});
  }
}

}  // namespace stampede
