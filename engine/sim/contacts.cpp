#include "engine/sim/contacts.h"

#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <cmath>

#include "engine/sim/bullet_convert.h"

namespace stampede {
namespace {

constexpr double kGraspForce = 0.5;                        // N, mean on each pad
constexpr double kGraspOpposition = -0.70710678118654752;  // cosine: opposed within 45 degrees

std::uint64_t pair_hash(PartRef a, PartRef b) {
  const auto key = [](PartRef ref) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(ref.body + 1)) << 12) ^
           static_cast<std::uint64_t>(static_cast<std::uint32_t>(ref.part));
  };
  std::uint64_t h = (key(a) << 32) ^ key(b);
  h *= 0x9e3779b97f4a7c15ULL;
  return h ^ (h >> 32);
}

PartRef ref_of(const btCollisionObject& object) { return {object.getUserIndex(), object.getUserIndex2()}; }

}  // namespace

ContactWindow::ContactWindow() : table_(256, -1) {}

void ContactWindow::index_sums(std::size_t table_size) {
  table_.assign(table_size, -1);
  const std::size_t mask = table_.size() - 1;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    std::size_t at = pair_hash(sums_[i].a, sums_[i].b) & mask;
    while (table_[at] >= 0) at = (at + 1) & mask;
    table_[at] = static_cast<std::int32_t>(i);
  }
}

ContactWindow::Sum& ContactWindow::sum_of(PartRef a, PartRef b) {
  const std::size_t mask = table_.size() - 1;
  std::size_t at = pair_hash(a, b) & mask;
  for (; table_[at] >= 0; at = (at + 1) & mask) {
    Sum& sum = sums_[static_cast<std::size_t>(table_[at])];
    if (sum.a == a && sum.b == b) return sum;
  }
  table_[at] = static_cast<std::int32_t>(sums_.size());
  sums_.push_back({});
  sums_.back().a = a;
  sums_.back().b = b;
  if (sums_.size() * 2 > table_.size()) index_sums(table_.size() * 2);
  return sums_.back();
}

void ContactWindow::add_step(btDispatcher& dispatcher, double dt) {
  ++steps_;
  const int count = dispatcher.getNumManifolds();
  for (int i = 0; i < count; ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    double impulse = 0, depth = 0;
    btVector3 normal(0, 0, 0), point(0, 0, 0), total(0, 0, 0);
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& contact = manifold.getContactPoint(p);
      const double strength = contact.m_appliedImpulse;
      if (!(strength > 0)) continue;
      impulse += strength;
      depth = std::max(depth, -contact.getDistance());
      normal += contact.m_normalWorldOnB * strength;
      point += contact.m_positionWorldOnB * strength;
      total += contact.m_lateralFrictionDir1 * contact.m_appliedImpulseLateral1 +
               contact.m_lateralFrictionDir2 * contact.m_appliedImpulseLateral2;
    }
    if (!(impulse > 0)) continue;
    total += normal;
    PartRef a = ref_of(*manifold.getBody0()), b = ref_of(*manifold.getBody1());
    double sign = 1 / dt;  // Bullet's normals point from body 1 to body 0
    if (b < a) {
      std::swap(a, b);
      sign = -sign;
    }
    Sum& sum = sum_of(a, b);
    if (sum.step != steps_) {
      sum.peak = std::max(sum.peak, sum.step_normal);
      sum.step_normal = 0;
      sum.step = steps_;
    }
    sum.depth = std::max(sum.depth, depth);
    sum.normal += impulse / dt;
    sum.step_normal += impulse / dt;
    sum.normal_vector += sign * from_bullet(normal);
    sum.point += from_bullet(point) / dt;
    sum.force += sign * from_bullet(total);
  }
}

void ContactWindow::close() {
  closed_.clear();
  for (const Sum& sum : sums_) {
    Contact contact;
    contact.a = sum.a;
    contact.b = sum.b;
    contact.mean_force = sum.normal / static_cast<double>(steps_);
    contact.peak_force = std::max({sum.peak, sum.step_normal, contact.mean_force});  // a mean of equals is rounded
    contact.depth = sum.depth;
    const double length = sum.normal_vector.norm();
    if (length > 0) contact.normal = sum.normal_vector / length;
    contact.point = sum.point / sum.normal;
    contact.force = sum.force / static_cast<double>(steps_);
    closed_.push_back(contact);
  }
  std::sort(closed_.begin(), closed_.end(), [](const Contact& left, const Contact& right) {
    return left.a != right.a ? left.a < right.a : left.b < right.b;
  });
  sums_.clear();
  std::fill(table_.begin(), table_.end(), -1);
  steps_ = 0;
}

void ContactWindow::set_state(const State& state) {
  sums_ = state.open;
  steps_ = state.steps;
  closed_ = state.closed;
  std::size_t size = table_.size();
  while (sums_.size() * 2 > size) size *= 2;
  index_sums(size);
}

std::optional<PartRef> ContactWindow::grasped(const std::vector<int>& pads) const {
  // The robot sorts first, so a pad is always `a`, and the normal points from the thing to the pad.
  std::optional<PartRef> best;
  double best_force = 0;
  const auto is_pad = [&](const Contact& contact) {
    return contact.a.body == -1 && contact.b.body >= 0 && contact.mean_force >= kGraspForce &&
           std::find(pads.begin(), pads.end(), contact.a.part) != pads.end();
  };
  for (std::size_t i = 0; i < closed_.size(); ++i) {
    if (!is_pad(closed_[i])) continue;
    for (std::size_t j = i + 1; j < closed_.size(); ++j) {
      const Contact &one = closed_[i], &two = closed_[j];
      if (!is_pad(two) || one.b != two.b || one.a == two.a) continue;
      if (one.normal.dot(two.normal) > kGraspOpposition) continue;
      const double force = std::min(one.mean_force, two.mean_force);
      if (force > best_force) {
        best = one.b;
        best_force = force;
      }
    }
  }
  return best;
}

}  // namespace stampede
