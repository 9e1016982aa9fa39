#include "engine/sim/sleep.h"

#include <btBulletCollisionCommon.h>

#include <algorithm>

#include "engine/sim/bullet_convert.h"

namespace stampede {
namespace {

constexpr double kSmoothing = 0.125;  // of the speeds that are looked at: resting things tremble
constexpr int kRestSteps = 24;        // at rest for so long, an island falls asleep
constexpr int kFindSteps = 8;         // that it stays awake for at least, where contacts have to be found anew
constexpr double kMeetGap = 1e-3;     // m: what will be nearer than that at the end of the step meets

}  // namespace

bool Sleep::meet(const btPersistentManifold& manifold) const {
  const MoverLink one = MoverLink::of(manifold.getBody0()), other = MoverLink::of(manifold.getBody1());
  for (int p = 0; p < manifold.getNumContacts(); ++p) {
    const btManifoldPoint& point = manifold.getContactPoint(p);
    const Vector3 apart = movers_[one.mover].velocity_at(one.link, from_bullet(point.m_positionWorldOnA)) -
                          movers_[other.mover].velocity_at(other.link, from_bullet(point.m_positionWorldOnB));
    if (point.getDistance() + dt_ * from_bullet(point.m_normalWorldOnB).dot(apart) < kMeetGap) return true;
  }
  return false;
}

void Sleep::wake_what_is_met() {
  btDispatcher& dispatcher = *world_.getDispatcher();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    const MoverLink one = MoverLink::of(manifold.getBody0()), other = MoverLink::of(manifold.getBody1());
    if (one.mover < 0 || other.mover < 0 || movers_.asleep(one) == movers_.asleep(other) || !meet(manifold)) continue;
    wake_with_neighbours(movers_.asleep(one) ? one.mover : other.mover);
  }
}

void Sleep::rouse(int mover) {
  movers_[mover].set_asleep(false);
  static_cast<Rest&>(movers_[mover]) = {};
  waking_.push_back(mover);
}

void Sleep::rouse_neighbours(int woken, const MoverLink& one, const MoverLink& other) {
  if (one.mover == woken && movers_.asleep(other)) rouse(other.mover);
  if (other.mover == woken && movers_.asleep(one)) rouse(one.mover);
}

void Sleep::wake_with_neighbours(int first) {
  waking_.clear();
  rouse(first);
  btDispatcher& dispatcher = *world_.getDispatcher();
  while (!waking_.empty()) {
    const int woken = waking_.back();
    waking_.pop_back();
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
      if (manifold.getNumContacts() > 0)
        rouse_neighbours(woken, MoverLink::of(manifold.getBody0()), MoverLink::of(manifold.getBody1()));
    }
    for (const Bond& bond : movers_.bonds())
      if (bond.holds) rouse_neighbours(woken, MoverLink::of(bond.body->object), MoverLink::of(bond.on));
  }
}

void Sleep::wake(const btCollisionObject& object) {
  const MoverLink node = MoverLink::of(&object);
  if (node.mover >= 0) wake_with_neighbours(node.mover);
}

void Sleep::wake_all() {
  for (Mover& mover : movers_.all()) {
    if (mover.asleep) mover.set_asleep(false);
    mover.rest = std::min(mover.rest, kRestSteps - kFindSteps);
  }
}

void Sleep::fall_asleep(const std::vector<Island>& islands) {
  least_rest_.assign(movers_.all().size(), 0);
  for (const Island& island : islands) least_rest_[static_cast<std::size_t>(island.number)] = kRestSteps;
  for (Mover& mover : movers_.all()) {
    if (mover.asleep) continue;
    if (const auto twist = mover.free_twist()) {
      mover.mean_linear += kSmoothing * (twist->first - mover.mean_linear);
      mover.mean_angular += kSmoothing * (twist->second - mover.mean_angular);
    }
    mover.rest = mover.may_sleep && mover.at_rest() ? std::min(mover.rest + 1, kRestSteps) : 0;
    int& least = least_rest_[static_cast<std::size_t>(mover.island)];
    least = std::min(least, mover.rest);
  }
  for (Mover& mover : movers_.all())
    if (!mover.asleep && least_rest_[static_cast<std::size_t>(mover.island)] == kRestSteps) mover.set_asleep(true);
}

}  // namespace stampede
