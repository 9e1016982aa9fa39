#include "engine/sim/islands.h"

#include <btBulletCollisionCommon.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

#include "engine/sim/bullet_convert.h"

namespace stampede {
namespace {

// Points between two free bodies that lie further apart than this, across the longest way between two of them, resist
// turning by themselves.
constexpr double kNarrow_m = 0.008;
constexpr double kBears_m = 1e-4;  // a point of contact that is further away bears nothing
constexpr double kLeastWeight = 0.25;

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

}  // namespace

double Touching::weight(double depth) const { return deep_m > 0 ? std::clamp(depth / deep_m, kLeastWeight, 1.0) : 1; }

int Islands::root(int mover) const {
  while (movers_[mover].island != mover) mover = movers_[mover].island;
  return mover;
}

void Islands::unite(int one, int other) {
  const int a = root(one), b = root(other);
  movers_[std::max(a, b)].island = std::min(a, b);
}

void Islands::find_touching() {
  touching_.clear();
  btDispatcher& dispatcher = *world_.getDispatcher();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    btPersistentManifold* manifold = dispatcher.getManifoldByIndexInternal(i);
    if (manifold->getNumContacts() == 0) continue;
    const MoverLink one = MoverLink::of(manifold->getBody0()), other = MoverLink::of(manifold->getBody1());
    if (movers_.bonded(*manifold->getBody0(), *manifold->getBody1())) continue;
    if (movers_.asleep(one) || movers_.asleep(other)) continue;  // with another sleeper, or what it does not meet
    if (one.mover >= 0 && other.mover >= 0) unite(one.mover, other.mover);
    touching_.push_back({std::max(one.mover, other.mover), manifold->getBody0()->getWorldArrayIndex(),
                         manifold->getBody1()->getWorldArrayIndex(), manifold,
                         movers_.on_link(one) || movers_.on_link(other)});
  }
}

// How two lie on each other, all their manifolds together, which are next to each other.
void Islands::look_at_points() {
  for (auto it = touching_.begin(); it != touching_.end();) {
    auto end = it;
    points_.clear();
    depths_.clear();
    for (; end != touching_.end() && end->first == it->first && end->second == it->second; ++end)
      for (int p = 0; p < end->manifold->getNumContacts(); ++p)
        if (const btManifoldPoint& point = end->manifold->getContactPoint(p); point.getDistance() < kBears_m) {
          points_.push_back(from_bullet(point.m_positionWorldOnB));
          depths_.push_back(-point.getDistance());
        }
    it->narrow = lie_along_a_line(points_);
    it->deep_m = depths_.empty() ? 0 : std::max(0.0, *std::ranges::max_element(depths_) / 2);
    it->weights = depths_.empty() ? 1 : 0;
    for (const double depth : depths_) it->weights += it->weight(depth);
    for (auto next = it + 1; next != end; ++next)
      std::tie(next->deep_m, next->weights, next->narrow) = std::tie(it->deep_m, it->weights, it->narrow);
    it = end;
  }
}

bool Islands::in_bond(int island) const {
  const std::deque<Bond>& bonds = movers_.bonds();
  return std::any_of(bonds.begin(), bonds.end(), [&](const Bond& bond) { return movers_.holds_in(bond, island); });
}

void Islands::find() {
  const int count = static_cast<int>(movers_.all().size());
  for (int m = 0; m < count; ++m) movers_[m].island = m;
  for (const Bond& bond : movers_.bonds())
    if (bond.holds && MoverLink::of(bond.on).mover >= 0)
      unite(MoverLink::of(bond.on).mover, MoverLink::of(bond.body->object).mover);
  find_touching();
  for (int m = 0; m < count; ++m) movers_[m].island = root(m);
  for (Touching& touching : touching_) touching.island = movers_[touching.island].island;
  std::stable_sort(touching_.begin(), touching_.end(), [](const Touching& a, const Touching& b) {
    return std::tie(a.island, a.first, a.second) < std::tie(b.island, b.first, b.second);
  });
  look_at_points();
  islands_.clear();
  auto next = touching_.begin();
  for (int m = 0; m < count; ++m) {
    if (movers_[m].island != m || movers_[m].asleep) continue;
    const auto begin = next;
    while (next != touching_.end() && next->island == m) ++next;
    if (begin != next || movers_[m].tree || in_bond(m)) islands_.push_back({m, {begin, next}});
  }
}

}  // namespace stampede
