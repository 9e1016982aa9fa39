#include "engine/sim/dynamics.h"

#include <btBulletCollisionCommon.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "engine/sim/bullet_convert.h"

namespace stampede {
namespace {

constexpr double kErp = 0.2;  // share of an error in position that a step takes away: contacts, anchors, stops
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
constexpr double kBounceSpeed = 0.2;    // m/s: nothing bounces below
constexpr double kFastestJoint = 100;   // m/s or rad/s
constexpr double kNearlyTooFast = 0.5;  // share of what a brake allows: slower, it is left out
constexpr double kSlowSpin = 1e-4;      // rad/s: gyroscopic torque is left out below
// Points between two free bodies that lie further apart than this, across the longest way between two of them, resist
// turning by themselves.
constexpr double kNarrow_m = 0.008;
constexpr double kBears_m = 1e-4;                       // a point of contact that is further away bears nothing
constexpr double kSoftForce = 80, kPointForce = 10;     // N: of a pair, and of each of its points at least
constexpr double kSoft_m = 0.0008, kHardness = 60'000;  // N/m
constexpr double kRestSpeed = 5e-4, kRestSpin = 5e-3;   // m/s, rad/s: slower is at rest
constexpr double kTrembling = 10, kSettling = 100;      // times that
constexpr double kSmoothing = 0.125;                    // of the speeds that are looked at: resting things tremble
constexpr int kRestSteps = 24;                          // at rest for so long, an island falls asleep
constexpr int kFindSteps = 8;      // that it stays awake for at least, where contacts have to be found anew
constexpr double kMeetGap = 1e-3;  // m: what will be nearer than that at the end of the step meets

Matrix3 skew(const Vector3& v) {
  Matrix3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// The spin after a step of torque-free rotation: one implicit step, which neither gains energy nor tumbles apart at
// 240 Hz (Catto, Numerical Methods, GDC 2015). World axes; `turn`: principal axes in the world.
Vector3 after_gyration(const Vector3& spin, const Vector3& moments, const Matrix3& turn, double dt) {
  const Vector3 local = turn.transpose() * spin, momentum = moments.cwiseProduct(local);
  const Vector3 error = dt * local.cross(momentum);
  Matrix3 slope = moments.asDiagonal();
  slope += dt * (skew(local) * Matrix3(moments.asDiagonal()) - skew(momentum));
  return turn * (local - slope.inverse() * error);
}

// The greatest force of one of so many points of contact with a robot, N. Its skin, pads and joints give way a little:
// perfectly rigid, 5 kg at a decimetre a second would strike with 120 N, all in one step. So it takes some steps,
// within a millimetre; deeper, it gets hard.
double softened(double distance, int points) {
  const double most = kSoftForce + kHardness * std::max(0.0, -distance - kSoft_m);
  return std::max(most / std::max(1, points), kPointForce);
}

bool lie_along_a_line(const std::vector<Vector3>& points) {
  if (points.size() <= 2) return true;
  Vector3 along = Vector3::Zero();
  for (const Vector3& one : points)
    for (const Vector3& other : points)
      if ((one - other).squaredNorm() > along.squaredNorm()) along = one - other;
  const double most = kNarrow_m * kNarrow_m * along.squaredNorm();
  return std::all_of(points.begin(), points.end(),
                     [&](const Vector3& one) { return along.cross(one - points.front()).squaredNorm() <= most; });
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

FreeBody& Dynamics::add_free(const FreeBody& body) {
  free_.push_back(body);
  Mover mover;
  mover.free = &free_.back();
  mover.quads = 2;
  nodes_.push_back({static_cast<int>(movers_.size()), -1});
  body.object->setUserPointer(&nodes_.back());
  mover.objects.push_back(body.object);
  movers_.push_back(mover);
  return free_.back();
}

Articulation& Dynamics::add_tree(const Transform& world_from_base, bool floating, bool may_sleep) {
  trees_.emplace_back(world_from_base, floating);
  Mover mover;
  mover.tree = &trees_.back();
  mover.may_sleep = may_sleep;
  movers_.push_back(mover);
  return trees_.back();
}

Dynamics::Mover& Dynamics::mover_of(const Articulation& tree) {
  return *std::find_if(movers_.begin(), movers_.end(), [&](const Mover& mover) { return mover.tree == &tree; });
}

void Dynamics::add_object(btCollisionObject& object, Articulation& tree, int link) {
  Mover& mover = mover_of(tree);
  nodes_.push_back({static_cast<int>(&mover - movers_.data()), link});
  object.setUserPointer(&nodes_.back());
  mover.objects.push_back(&object);
}

JointMotor& Dynamics::add_motor(Articulation& tree, int dof) {
  motors_.push_back({});
  motors_.back().dof = dof;
  mover_of(tree).motors.push_back(&motors_.back());
  return motors_.back();
}

void Dynamics::add_gear(Articulation& tree, const JointGear& gear) { mover_of(tree).gears.push_back(gear); }
void Dynamics::set_brakes(Articulation& tree, std::vector<SpeedBrake> brakes) {
  mover_of(tree).brakes = std::move(brakes);
}
void Dynamics::add_stop(Articulation& tree, const JointStop& stop) { mover_of(tree).stops.push_back(stop); }

void Dynamics::step(int iterations) {
  world_.performDiscreteCollisionDetection();
  find_encounters();
  torsions_.clear();
  wake_what_is_met();
  apply_forces();
  untouched_ = velocities_;
  find_touching();
  for (const Island& island : islands_) solve_island(island, iterations);
  move();
  forget_encounters();
  if (sleep_) fall_asleep();
}

void Dynamics::set_asleep(Mover& mover, bool asleep) {
  mover.asleep = asleep;
  for (btCollisionObject* object : mover.objects)
    object->forceActivationState(asleep ? ISLAND_SLEEPING : DISABLE_DEACTIVATION);
  if (!asleep) return;
  if (mover.free) mover.free->linear = mover.free->angular = Vector3::Zero();
  if (mover.tree) std::fill(mover.tree->velocity.begin(), mover.tree->velocity.end(), 0.0);
}

Vector3 Dynamics::velocity_at(const Node& node, const Vector3& point) const {
  const Mover& mover = movers_[static_cast<std::size_t>(node.mover)];
  if (mover.free)
    return mover.free->linear +
           mover.free->angular.cross(point - from_bullet(mover.free->object->getWorldTransform().getOrigin()));
  Vector3 velocity = Vector3::Zero();
  mover.tree->jacobian(node.link, point, [&](int dof, const Vector3& linear, const Vector3&) {
    velocity += mover.tree->velocity[static_cast<std::size_t>(dof)] * linear;
  });
  return velocity;
}

bool Dynamics::meet(const btPersistentManifold& manifold) const {
  const Node one = node_of(manifold.getBody0()), other = node_of(manifold.getBody1());
  for (int p = 0; p < manifold.getNumContacts(); ++p) {
    const btManifoldPoint& point = manifold.getContactPoint(p);
    const Vector3 apart = velocity_at(one, from_bullet(point.m_positionWorldOnA)) -
                          velocity_at(other, from_bullet(point.m_positionWorldOnB));
    if (point.getDistance() + dt_ * from_bullet(point.m_normalWorldOnB).dot(apart) < kMeetGap) return true;
  }
  return false;
}

void Dynamics::wake_what_is_met() {
  btDispatcher& dispatcher = *world_.getDispatcher();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    const Node one = node_of(manifold.getBody0()), other = node_of(manifold.getBody1());
    if (one.mover < 0 || other.mover < 0 || asleep(one) == asleep(other) || !meet(manifold)) continue;
    wake_with_neighbours(asleep(one) ? one.mover : other.mover);
  }
}

void Dynamics::wake_with_neighbours(int first) {
  const auto rouse = [&](int mover) {
    set_asleep(movers_[static_cast<std::size_t>(mover)], false);
    static_cast<Rest&>(movers_[static_cast<std::size_t>(mover)]) = {};
    waking_.push_back(mover);
  };
  waking_.clear();
  rouse(first);
  btDispatcher& dispatcher = *world_.getDispatcher();
  while (!waking_.empty()) {
    const int woken = waking_.back();
    waking_.pop_back();
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
      if (manifold.getNumContacts() == 0) continue;
      const Node one = node_of(manifold.getBody0()), other = node_of(manifold.getBody1());
      if (one.mover == woken && asleep(other)) rouse(other.mover);
      if (other.mover == woken && asleep(one)) rouse(one.mover);
    }
    for (const Bond& bond : bonds_) {
      const Node on = node_of(bond.on), own = node_of(bond.body->object);
      if (!bond.holds) continue;
      if (own.mover == woken && asleep(on)) rouse(on.mover);
      if (on.mover == woken && asleep(own)) rouse(own.mover);
    }
  }
}

void Dynamics::wake(const btCollisionObject& object) {
  const Node node = node_of(&object);
  if (node.mover >= 0) wake_with_neighbours(node.mover);
}

void Dynamics::let_sleep(bool sleep) {
  sleep_ = sleep;
  forget_contacts();
}

void Dynamics::forget_contacts() {
  torsions_.clear();
  for (Mover& mover : movers_) {
    if (mover.asleep) set_asleep(mover, false);
    mover.rest = std::min(mover.rest, kRestSteps - kFindSteps);
  }
}

std::vector<Dynamics::Rest> Dynamics::rest() const { return {movers_.begin(), movers_.end()}; }

void Dynamics::set_rest(const std::vector<Rest>& rest) {
  for (std::size_t m = 0; m < movers_.size(); ++m) static_cast<Rest&>(movers_[m]) = rest[m];
}

bool Dynamics::slower(const Mover& mover, double than) {
  const double speed = than * kRestSpeed, spin = than * kRestSpin;
  if (const auto twist = free_twist(mover);
      twist && (twist->first.squaredNorm() >= speed * speed || twist->second.squaredNorm() >= spin * spin))
    return false;
  if (!mover.tree) return true;
  const auto joints = mover.tree->velocity.begin() + (mover.tree->floating() ? 6 : 0);
  return std::all_of(joints, mover.tree->velocity.end(), [&](double rate) { return std::abs(rate) < speed; });
}

// Speed and spin of what moves freely: a free body, or the first link of a floating tree.
std::optional<std::pair<Vector3, Vector3>> Dynamics::free_twist(const Mover& mover) {
  if (mover.free) return std::pair(mover.free->linear, mover.free->angular);
  if (!mover.tree->floating()) return std::nullopt;
  const std::vector<double>& v = mover.tree->velocity;
  return std::pair(Vector3(v[0], v[1], v[2]), Vector3(v[3], v[4], v[5]));
}

bool Dynamics::at_rest(const Mover& mover) {
  if (!free_twist(mover)) return slower(mover, 1);
  return slower(mover, kTrembling) && mover.mean_linear.squaredNorm() < kRestSpeed * kRestSpeed &&
         mover.mean_angular.squaredNorm() < kRestSpin * kRestSpin;
}

// Whole islands at once. What hangs in the air has none.
void Dynamics::fall_asleep() {
  least_rest_.assign(movers_.size(), 0);
  for (const Island& island : islands_) least_rest_[static_cast<std::size_t>(island.number)] = kRestSteps;
  for (Mover& mover : movers_) {
    if (mover.asleep) continue;
    if (const auto twist = free_twist(mover)) {
      mover.mean_linear += kSmoothing * (twist->first - mover.mean_linear);
      mover.mean_angular += kSmoothing * (twist->second - mover.mean_angular);
    }
    mover.rest = mover.may_sleep && at_rest(mover) ? std::min(mover.rest + 1, kRestSteps) : 0;
    int& least = least_rest_[static_cast<std::size_t>(mover.island)];
    least = std::min(least, mover.rest);
  }
  for (Mover& mover : movers_)
    if (!mover.asleep && least_rest_[static_cast<std::size_t>(mover.island)] == kRestSteps) set_asleep(mover, true);
}

void Dynamics::apply_forces() {
  int quads = 0;
  for (Mover& mover : movers_) {
    if (mover.tree) mover.quads = mover.tree->width() / 4;
    mover.at = quads;
    quads += mover.quads;
  }
  velocities_.assign(static_cast<std::size_t>(quads), Quad{});
  for (Mover& mover : movers_) {
    if (mover.asleep) {
      if (mover.tree) std::fill(mover.tree->torque.begin(), mover.tree->torque.end(), 0.0);  // or it would add up
      continue;
    }
    double* speeds = velocities_[static_cast<std::size_t>(mover.at)].v;
    if (mover.free) {
      FreeBody& body = *mover.free;
      const Matrix3 turn = from_bullet(body.object->getWorldTransform()).linear();
      mover.inverse_inertia = turn * body.moments.cwiseInverse().asDiagonal() * turn.transpose();
      const Vector3 linear = body.linear + dt_ * gravity_;
      const Vector3 angular = body.angular.squaredNorm() > kSlowSpin * kSlowSpin
                                  ? after_gyration(body.angular, body.moments, turn, dt_)
                                  : body.angular;
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

// Islands: movers that touch each other, directly or through others. All in an order that knows nothing of the past.
void Dynamics::find_touching() {
  for (std::size_t m = 0; m < movers_.size(); ++m) movers_[m].island = static_cast<int>(m);
  const auto root = [&](int mover) {
    while (movers_[static_cast<std::size_t>(mover)].island != mover)
      mover = movers_[static_cast<std::size_t>(mover)].island;
    return mover;
  };
  const auto unite = [&](int one, int other) {
    const int a = root(one), b = root(other);
    movers_[static_cast<std::size_t>(std::max(a, b))].island = std::min(a, b);
  };
  for (const Bond& bond : bonds_)
    if (bond.holds && node_of(bond.on).mover >= 0) unite(node_of(bond.on).mover, node_of(bond.body->object).mover);
  touching_.clear();
  btDispatcher& dispatcher = *world_.getDispatcher();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    btPersistentManifold* manifold = dispatcher.getManifoldByIndexInternal(i);
    if (manifold->getNumContacts() == 0) continue;
    const Node one = node_of(manifold->getBody0()), other = node_of(manifold->getBody1());
    if (bonded(*manifold->getBody0(), *manifold->getBody1())) continue;
    if (asleep(one) || asleep(other)) continue;  // with another sleeper, or near something that it does not meet
    if (one.mover >= 0 && other.mover >= 0) unite(one.mover, other.mover);
    touching_.push_back({std::max(one.mover, other.mover), manifold->getBody0()->getWorldArrayIndex(),
                         manifold->getBody1()->getWorldArrayIndex(), manifold, on_link(one) || on_link(other)});
  }
  for (std::size_t m = 0; m < movers_.size(); ++m) movers_[m].island = root(static_cast<int>(m));
  for (Touching& touching : touching_) touching.island = movers_[static_cast<std::size_t>(touching.island)].island;
  std::stable_sort(touching_.begin(), touching_.end(), [](const Touching& a, const Touching& b) {
    return std::tie(a.island, a.first, a.second) < std::tie(b.island, b.first, b.second);
  });
  for (auto it = touching_.begin(); it != touching_.end();) {
    auto end = it;
    points_.clear();
    for (; end != touching_.end() && end->first == it->first && end->second == it->second; ++end)
      for (int p = 0; p < end->manifold->getNumContacts(); ++p)
        if (const btManifoldPoint& point = end->manifold->getContactPoint(p); point.getDistance() < kBears_m)
          points_.push_back(from_bullet(point.m_positionWorldOnB));
    const bool narrow = lie_along_a_line(points_);
    for (; it != end; ++it) {
      it->points = static_cast<int>(points_.size());
      it->narrow = narrow;
    }
  }
  islands_.clear();
  auto next = touching_.begin();
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    if (movers_[m].island != static_cast<int>(m) || movers_[m].asleep) continue;
    const auto begin = next;
    while (next != touching_.end() && next->island == static_cast<int>(m)) ++next;
    const bool in_bond = std::any_of(bonds_.begin(), bonds_.end(),
                                     [&](const Bond& bond) { return holds_in(bond, static_cast<int>(m)); });
    if (begin != next || movers_[m].tree || in_bond)
      islands_.push_back({static_cast<int>(m), static_cast<int>(begin - touching_.begin()),
                          static_cast<int>(next - touching_.begin())});
  }
}

void Dynamics::solve_island(const Island& island, int iterations) {
  numbers_.clear();
  joints_.clear();
  rows_.clear();
  motor_rows_.clear();
  contacts_.clear();
  touched_.clear();
  std::size_t link_contacts = 0;
  bool with_robot = false, with_mechanism = false, settling = true;
  for (const Mover& mover : movers_) {
    if (mover.island != island.number) continue;
    with_robot = with_robot || !mover.may_sleep;
    with_mechanism = with_mechanism || (mover.tree && mover.may_sleep);
    settling = settling && mover.may_sleep && slower(mover, kSettling);
  }
  const bool alone = !with_robot && !with_mechanism;
  const Motion before = with_mechanism ? Motion{} : free_motion(island);
  parting_ = 0;
  Bounds bounds;
  if (!with_mechanism) bounds.impulse = kWedge * before.momentum + (with_robot ? dt_ * kPressed : 0);
  if (alone) bounds.parting = std::max(kParting, std::sqrt(2 * before.energy / before.mass));
  for (const bool on_link : {false, true}) {
    if (on_link) link_contacts = contacts_.size();
    const double kept = !with_robot ? kKept : on_link ? kKeptOnRobot : kKeptBesideRobot;
    for (int i = island.touching_begin; i < island.touching_end; ++i)
      if (const Touching& touching = touching_[static_cast<std::size_t>(i)]; touching.on_link == on_link)
        add_contacts(touching, kept, bounds);
  }
  for (const Mover& mover : movers_)
    if (mover.tree && mover.island == island.number) add_joints(mover);
  const std::size_t joints = joints_.size();
  for (const Bond& bond : bonds_)
    if (holds_in(bond, island.number)) add_bond_rows(bond);
  const bool deep = std::any_of(touched_.begin(), touched_.end(), [](const Touched& touched) {
    return touched.point->getDistance() < -kDeep_m && node_of(touched.first).mover >= 0 &&
           node_of(touched.second).mover >= 0;
  });
  if (settling || deep) iterations = std::max(iterations, kPatience);
  const SolverIsland rows{numbers_.data(), velocities_.data(), rows_.data(), joints_.data(),         contacts_.data(),
                          link_contacts,   contacts_.size(),   joints,       joints_.size() - joints};
  bool agreed = false;
  for (int i = 0; i < iterations && !agreed; ++i) agreed = solve_rows_(rows, i % 2 == 1) <= kSettled;
  if (alone) take_no_energy(island, before);
  if (alone && settling && !agreed) slow_down(island, kUndecided);
  keep_results();
}

Dynamics::Motion Dynamics::free_motion(const Island& island) const {
  Motion motion;
  const double pressed = dt_ * gravity_.norm() + kParting;  // m/s
  for (const Mover& mover : movers_) {
    if (mover.island != island.number || !mover.free) continue;
    const FreeBody& body = *mover.free;
    const double* speeds = velocities_[static_cast<std::size_t>(mover.at)].v;
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
void Dynamics::take_no_energy(const Island& island, const Motion& before) {
  const double now = free_motion(island).energy;
  const double parting = std::min(parting_, kParting);
  const double most = std::max(before.energy, before.mass * parting * parting / 2);
  if (now <= most) return;
  slow_down(island, std::sqrt(most / now));
}

void Dynamics::slow_down(const Island& island, double share) {
  for (const Mover& mover : movers_) {
    if (mover.island != island.number) continue;
    double* speeds = velocities_[static_cast<std::size_t>(mover.at)].v;
    for (int i = 0; i < 6; ++i) speeds[i] *= share;
  }
}

Dynamics::Node Dynamics::node_of(const btCollisionObject* object) {
  const auto* node = static_cast<const Node*>(object->getUserPointer());
  return node ? *node : Node{};
}

// On a joint: the first link of a floating tree is as free as a free body.
bool Dynamics::on_link(const Node& node) const {
  return node.link > 0 || (node.link == 0 && !movers_[static_cast<std::size_t>(node.mover)].tree->floating());
}

SolverRow& Dynamics::begin_row(std::vector<SolverRow>& rows) {
  SolverRow& row = rows.emplace_back();
  row.numbers = static_cast<int>(numbers_.size());
  return row;
}

double* Dynamics::add_side(SolverRow& row, const Mover& mover) {
  const int side = row.quads[0] == 0 ? 0 : 1;
  row.at[side] = mover.at;
  row.quads[side] = mover.quads;
  const std::size_t begin = numbers_.size();
  numbers_.resize(begin + 2 * static_cast<std::size_t>(mover.quads));
  return numbers_[begin].v;
}

// A new side, or where two links of one tree meet, that of the first: the second adds to it, and its response is made
// anew.
double* Dynamics::tree_side(SolverRow& row, const Mover& mover) {
  if (row.quads[0] == 0 || row.at[0] != mover.at) return add_side(row, mover);
  const auto side = numbers_.begin() + row.numbers;
  std::fill(side + mover.quads, side + 2 * static_cast<std::ptrdiff_t>(mover.quads), Quad{});
  return side->v;
}

void Dynamics::respond(const Articulation& tree, double* jacobian) {
  const int count = tree.width();
  double* response = jacobian + count;
  for (int i = 0; i < tree.dofs(); ++i) {
    const double share = jacobian[i];
    if (share == 0) continue;
    const double* column = tree.inverse_mass(i);
    for (int j = 0; j < count; ++j) response[j] += share * column[j];
  }
}

void Dynamics::add_free_side(SolverRow& row, const Mover& mover, const Vector3& linear, const Vector3& angular) {
  double* jacobian = add_side(row, mover);
  const double lightness = 1 / mover.free->mass;
  const Vector3 turned = mover.inverse_inertia * angular;
  for (int i = 0; i < 3; ++i) {
    jacobian[i] = linear[i];
    jacobian[3 + i] = angular[i];
    jacobian[8 + i] = lightness * linear[i];
    jacobian[11 + i] = turned[i];
  }
}

void Dynamics::add_point(SolverRow& row, const Node& node, const Vector3& point, const Vector3& direction) {
  if (node.mover < 0) return;
  const Mover& mover = movers_[static_cast<std::size_t>(node.mover)];
  if (mover.free) {
    const Vector3 arm = point - from_bullet(mover.free->object->getWorldTransform().getOrigin());
    add_free_side(row, mover, direction, arm.cross(direction));
    return;
  }
  double* jacobian = tree_side(row, mover);
  mover.tree->jacobian(node.link, point,
                       [&](int dof, const Vector3& linear, const Vector3&) { jacobian[dof] += linear.dot(direction); });
  respond(*mover.tree, jacobian);
}

void Dynamics::add_turn(SolverRow& row, const Node& node, const Vector3& direction) {
  add_screw(row, node, Vector3::Zero(), Vector3::Zero(), direction);
}

// The speed of a point along one direction, and the spin about another.
void Dynamics::add_screw(SolverRow& row, const Node& node, const Vector3& point, const Vector3& linear,
                         const Vector3& angular) {
  if (node.mover < 0) return;
  const Mover& mover = movers_[static_cast<std::size_t>(node.mover)];
  if (mover.free) {
    const Vector3 arm = point - from_bullet(mover.free->object->getWorldTransform().getOrigin());
    add_free_side(row, mover, linear, arm.cross(linear) + angular);
    return;
  }
  double* jacobian = tree_side(row, mover);
  mover.tree->jacobian(node.link, point, [&](int dof, const Vector3& speed, const Vector3& spin) {
    jacobian[dof] += speed.dot(linear) + spin.dot(angular);
  });
  respond(*mover.tree, jacobian);
}

// The row is complete but for its bounds.
void Dynamics::end_row(SolverRow& row, double target) {
  const Quad* numbers = &numbers_[static_cast<std::size_t>(row.numbers)];
  row.response = 0;
  for (const int quads : row.quads) {
    for (int k = 0; k < quads; ++k)
      for (int i = 0; i < 4; ++i) row.response += numbers[k].v[i] * numbers[quads + k].v[i];
    numbers += 2 * quads;
  }
  row.response_inverse = row.response > 1e-15 ? 1 / row.response : 0;
  row.target = target;
}

void Dynamics::start(SolverRow& row, double impulse) {
  row.impulse = impulse;
  if (impulse != 0) push(numbers_.data(), velocities_.data(), row, impulse);
}

void Dynamics::add_contacts(const Touching& touching, double kept, const Bounds& bounds) {
  btPersistentManifold& manifold = *touching.manifold;
  const Node one = node_of(manifold.getBody0()), other = node_of(manifold.getBody1());
  const auto robot = [&](const Node& node) {
    return node.mover >= 0 && !movers_[static_cast<std::size_t>(node.mover)].may_sleep;
  };
  const bool of_robot = robot(one) || robot(other);
  for (int p = 0; p < manifold.getNumContacts(); ++p) {
    btManifoldPoint& point = manifold.getContactPoint(p);
    const Vector3 normal = from_bullet(point.m_normalWorldOnB);
    const Vector3 on_one = from_bullet(point.m_positionWorldOnA), on_other = from_bullet(point.m_positionWorldOnB);
    Vector3 across[2];
    tangents(normal, across[0], across[1]);
    SolverContact contact;
    contact.normal = static_cast<int>(rows_.size());
    contact.friction = point.m_combinedFriction;
    contact.spinning = point.m_combinedSpinningFriction;
    contact.rolling = point.m_combinedRollingFriction;
    const double distance = point.getDistance();
    SolverRow& row = begin_row(rows_);
    add_point(row, one, on_one, normal);
    add_point(row, other, on_other, -normal);
    end_row(row, distance > 0 ? -distance / dt_ : std::min(-distance * kErp / dt_, bounds.parting));
    parting_ = std::max(parting_, row.target);
    if (point.m_combinedRestitution > 0) {
      const double approach = speed(numbers_.data(), velocities_.data(), row);
      if (approach < -kBounceSpeed) row.target -= point.m_combinedRestitution * approach;
    }
    row.lower = 0;
    row.upper = of_robot ? dt_ * softened(distance, touching.points) : bounds.impulse;
    start(row, std::min(row.upper, kept * point.m_appliedImpulse));
    const bool anchored = (point.m_contactPointFlags & BT_CONTACT_FLAG_FRICTION_ANCHOR) != 0;
    for (int i = 0; i < 2; ++i) {
      SolverRow& friction = begin_row(rows_);
      add_point(friction, one, on_one, across[i]);
      add_point(friction, other, on_other, -across[i]);
      end_row(friction, anchored ? -(on_one - on_other).dot(across[i]) * kErp / dt_ : 0);
    }
    point.m_lateralFrictionDir1 = to_bullet(across[0]);
    point.m_lateralFrictionDir2 = to_bullet(across[1]);
    if (touching.on_link || touching.narrow) {
      const auto add_torsion = [&](const Vector3& axis) {
        SolverRow& torsion = begin_row(rows_);
        add_turn(torsion, one, axis);
        add_turn(torsion, other, -axis);
        end_row(torsion, 0);
        return static_cast<int>(rows_.size()) - 1;
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

void Dynamics::add_joints(const Mover& mover) {
  const Articulation& tree = *mover.tree;
  const auto add_row = [&](int dof, int other, double ratio) -> SolverRow& {
    SolverRow& row = begin_row(joints_);
    double* jacobian = add_side(row, mover);
    jacobian[dof] = 1;
    if (other >= 0) jacobian[other] = -ratio;
    respond(tree, jacobian);
    return row;
  };
  const std::size_t first = joints_.size();
  for (JointMotor* motor : mover.motors) {
    motor->force = 0;
    if (!(motor->most_force > 0)) continue;
    SolverRow& row = add_row(motor->dof, -1, 0);
    const double error = motor->position - tree.position[static_cast<std::size_t>(motor->dof)];
    const double wanted = motor->velocity + motor->position_gain * motor->erp * error / dt_;
    end_row(row, std::clamp(wanted, -motor->fastest, motor->fastest));
    row.upper = motor->most_force * dt_;
    row.lower = -row.upper;
    motor_rows_.push_back({static_cast<int>(joints_.size()) - 1, motor});
  }
  start_motors(mover, first);
  for (const SpeedBrake& brake : mover.brakes) {
    const double speed = std::inner_product(brake.jacobian.begin(), brake.jacobian.end(), tree.velocity.begin(), 0.0);
    if (std::abs(speed) < kNearlyTooFast * brake.most_speed) continue;
    SolverRow& row = begin_row(joints_);
    double* jacobian = add_side(row, mover);
    for (std::size_t i = 0; i < brake.jacobian.size(); ++i)
      jacobian[i] = std::copysign(1.0, -speed) * brake.jacobian[i];
    respond(tree, jacobian);
    end_row(row, -brake.most_speed);
    row.upper = brake.most_force * dt_;
  }
  for (const JointGear& gear : mover.gears) {
    SolverRow& row = add_row(gear.one, gear.other, gear.ratio);
    const double error = tree.position[static_cast<std::size_t>(gear.one)] - gear.offset -
                         gear.ratio * tree.position[static_cast<std::size_t>(gear.other)];
    end_row(row, -gear.erp * error / dt_);
    row.upper = gear.most_force * dt_;
    row.lower = -row.upper;
  }
  for (const JointStop& stop : mover.stops) {
    const double q = tree.position[static_cast<std::size_t>(stop.dof)];
    for (const double sign : {1.0, -1.0}) {
      const double room = sign > 0 ? q - stop.lower : stop.upper - q;
      if (room > 0) continue;
      SolverRow& row = begin_row(joints_);
      double* jacobian = add_side(row, mover);
      jacobian[stop.dof] = sign;
      respond(tree, jacobian);
      end_row(row, -room * kErp / dt_);
      row.upper = kStopImpulse;
    }
  }
}

// Where every joint has one motor, the impulses that give all joints the speeds asked for are M (wanted - now): the
// answer, but for contacts and for motors at the end of their force. What a motor may give against contact counts from
// what it takes where nothing touches: from what contacts bore in the step before, force would grow step by step.
void Dynamics::start_motors(const Mover& mover, std::size_t first) {
  const Articulation& tree = *mover.tree;
  const auto count = static_cast<std::size_t>(tree.dofs());
  if (joints_.size() - first != count || mover.motors.size() != count) return;
  const double* speeds = velocities_[static_cast<std::size_t>(mover.at)].v;
  const double* untouched = untouched_[static_cast<std::size_t>(mover.at)].v;
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
    row.impulse = std::clamp(impulses[i], row.lower, row.upper);
  }
  for (std::size_t i = 0; i < count; ++i) start(joints_[first + i], joints_[first + i].impulse);
}

void Dynamics::keep_results() {
  for (const auto& [index, motor] : motor_rows_) {
    const SolverRow& row = joints_[static_cast<std::size_t>(index)];
    motor->force = row.impulse / dt_;
    motor->saturated = row.impulse <= row.lower || row.impulse >= row.upper;
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const SolverContact& contact = contacts_[i];
    btManifoldPoint& point = *touched_[i].point;
    const SolverRow* normal = &rows_[static_cast<std::size_t>(contact.normal)];
    point.m_appliedImpulse = normal[0].impulse;
    point.m_appliedImpulseLateral1 = normal[1].impulse;
    point.m_appliedImpulseLateral2 = normal[2].impulse;
    if (contact.spin < 0 && contact.roll < 0) continue;
    Vector3 impulse = Vector3::Zero();
    if (contact.spin >= 0)
      impulse += rows_[static_cast<std::size_t>(contact.spin)].impulse * from_bullet(point.m_normalWorldOnB);
    if (contact.roll >= 0) {
      const SolverRow* roll = &rows_[static_cast<std::size_t>(contact.roll)];
      impulse += roll[0].impulse * from_bullet(point.m_lateralFrictionDir1) +
                 roll[1].impulse * from_bullet(point.m_lateralFrictionDir2);
    }
    torsions_.push_back({touched_[i].first, touched_[i].second, impulse});
  }
}

void Dynamics::move() {
  for (const Mover& mover : movers_) {
    if (mover.asleep) continue;
    const double* speeds = velocities_[static_cast<std::size_t>(mover.at)].v;
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
  move_bonds();
}

}  // namespace stampede
