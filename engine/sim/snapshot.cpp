// Snapshots that restore bit for bit. Bullet keeps state that cannot be read (pair order, contact caches, trees of the
// broadphase), so it is not saved but dropped, on both sides and in the same way; points of contact are kept.
#include <algorithm>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/sim/bullet_convert.h"
#include "engine/sim/impl.h"

namespace stampede {

struct Snapshot::Data {
  std::vector<double> state;  // bodies and joints, see Bodies::state
  std::vector<Rest> rest;
  std::vector<bool> locked;
  std::int64_t steps = 0;
  ControlState control;
  ContactPoints points;
  ContactWindow::State contacts;
  std::vector<std::vector<double>> efforts;
  CommandLog::Mark log;
};

void World::Impl::start_anew(ContactPoints kept) {
  finder.rebuild(std::move(kept));
  dynamics.forget_contacts();
  bodies.moved();
}

void World::Impl::canonicalise() {
  bodies.set_state(bodies.state());
  start_anew(finder.points());
  clock.boundary_step = clock.steps;
  canonical = true;
}

void World::Impl::place(int index, const Transform& world_from_body) {
  if (index < 0 || index >= bodies.count() || !bodies.body(index).free)
    throw Error("place", "body " + std::to_string(index) + " is not free", "place free bodies only");
  BodySlot& mine = bodies.body_slot(index);
  dynamics.wake(*mine.parts[0].object);
  if (mine.free) {
    mine.free->linear = mine.free->angular = Vector3::Zero();
    mine.free->object->setWorldTransform(
        to_bullet(Transform(world_from_body * mine.parts[0].link_from_part.inverse())));
  } else {
    std::fill(mine.tree->velocity.begin(), mine.tree->velocity.end(), 0.0);
    mine.tree->set_root(world_from_body);
  }
  forget_pairs(index);
  for (int other = 0; other < bodies.count(); ++other) {
    BodySlot& joined = bodies.body_slot(other);
    if (!joined.bond || !joined.bond->holds || bodies.body(other).joined_to != bodies.body(index).name) continue;
    joined.free->linear = joined.free->angular = Vector3::Zero();
    joined.bond->place_body();
    forget_pairs(other);
  }
  canonical = false;
  bodies.moved();
}

void World::Impl::forget_pairs(int index) {
  for (const PartSlot& slot : bodies.body_slot(index).parts) finder.forget_pairs(*slot.object);
}

Snapshot World::snapshot() const {
  const Impl& w = *impl_;
  if (!w.canonical)
    throw Error("World::snapshot", "bodies have moved since the last boundary", "apply operation::Boundary first");
  auto data = std::make_shared<Snapshot::Data>();
  data->state = w.bodies.state();
  data->rest = w.dynamics.rest();
  for (const Mechanism& mechanism : w.mechanisms) data->locked.push_back(mechanism.locked);
  data->steps = w.clock.steps;
  data->control = w.control;
  data->points = w.finder.dispatcher.kept;
  data->contacts = w.contacts.state();
  data->efforts = w.efforts;
  data->log = impl_->log.mark();
  return {data};
}

void World::restore(const Snapshot& snapshot) {
  Impl& w = *impl_;
  if (!snapshot.data) throw Error("World::restore", "an empty snapshot", "take it with World::snapshot");
  const Snapshot::Data& data = *snapshot.data;
  if (data.state.size() != w.bodies.state().size() || data.locked.size() != w.mechanisms.size())
    throw Error("World::restore", "the snapshot is of another scene", "restore into a world of an equal scene");
  w.bodies.set_state(data.state);
  w.start_anew(data.points);
  w.dynamics.set_rest(data.rest);
  for (std::size_t i = 0; i < w.mechanisms.size(); ++i) w.mechanisms[i].locked = data.locked[i];
  w.clock.steps = w.clock.boundary_step = data.steps;
  static_cast<ControlState&>(w.control) = data.control;
  w.contacts.set_state(data.contacts);
  w.control.acted() = {};
  w.efforts = data.efforts;
  w.log.back_to(data.log);
  w.canonical = true;
}

std::string World::state_hash() const {
  const std::vector<double> state = impl_->bodies.state();
  return Hasher().bytes(state.data(), state.size() * sizeof(double)).digest();
}

}  // namespace stampede
