// Snapshots that restore bit for bit. Bullet keeps state that cannot be read (pair order, contact caches, trees of the
// broadphase), so it is not saved but dropped, on both sides and in the same way.
#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/sim/impl.h"

namespace stampede {

struct Snapshot::Data {
  std::vector<double> state;  // bodies and joints, see World::Impl::state
  std::vector<Dynamics::Rest> rest;
  std::vector<bool> locked;
  std::int64_t steps = 0;
  operation::Controller controller;
  operation::Hand hand;
  std::int64_t hand_step = 0;
  Reference reference;
  JointState reference_now;
  ContactWindow::State contacts;
  JointVector arm_torque, foreseen;
  std::vector<std::vector<double>> efforts;
  CommandLog::Mark log;
};

namespace {

void put(std::vector<double>& out, const btVector3& v) { out.insert(out.end(), {v.x(), v.y(), v.z()}); }

struct Reader {
  const double* next;
  double number() { return *next++; }
  btVector3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
};

}  // namespace

// Free bodies: rotation matrix, origin, velocities; whether a bond holds, and where. Trees: of a floating one the
// rotation matrix and origin, positions, velocities.
std::vector<double> World::Impl::state() const {
  std::vector<double> out;
  for (const BodySlot& slot : bodies) {
    if (slot.free) {
      const btTransform& pose = slot.free->object->getWorldTransform();
      for (int row = 0; row < 3; ++row) put(out, pose.getBasis()[row]);
      put(out, pose.getOrigin());
      put(out, to_bullet(slot.free->linear));
      put(out, to_bullet(slot.free->angular));
    }
    if (slot.bond) out.insert(out.end(), {slot.bond->holds ? 1.0 : 0.0, slot.bond->position});
    if (!slot.tree) continue;
    if (slot.floats()) {
      const Transform& root = slot.tree->world_from_root();
      for (int row = 0; row < 3; ++row) put(out, to_bullet(Vector3(root.linear().row(row))));
      put(out, to_bullet(Vector3(root.translation())));
    }
    out.insert(out.end(), slot.tree->position.begin(), slot.tree->position.end());
    out.insert(out.end(), slot.tree->velocity.begin(), slot.tree->velocity.end());
  }
  return out;
}

void World::Impl::set_state(const std::vector<double>& state) {
  Reader in{state.data()};
  for (BodySlot& slot : bodies) {
    if (slot.free) {
      btTransform pose;
      for (int row = 0; row < 3; ++row) pose.getBasis()[row] = in.vector();
      pose.setOrigin(in.vector());
      slot.free->linear = from_bullet(in.vector());
      slot.free->angular = from_bullet(in.vector());
      slot.free->object->setWorldTransform(pose);
    }
    if (slot.bond) {
      slot.bond->holds = in.number() != 0;
      slot.bond->position = in.number();
    }
    if (!slot.tree) continue;
    if (slot.floats()) {
      Transform root = Transform::Identity();
      for (int row = 0; row < 3; ++row) root.linear().row(row) = from_bullet(in.vector());
      root.translation() = from_bullet(in.vector());
      slot.tree->set_root(root);
    }
    for (double& position : slot.tree->position) position = in.number();
    for (double& velocity : slot.tree->velocity) velocity = in.number();
    slot.tree->place();
  }
}

// Takes every body out and puts it back in creation order: trees, pairs, ids and manifolds are then those of a world
// that was just built, whatever came before.
void World::Impl::rebuild_broadphase() {
  btCollisionObjectArray& present = world.getCollisionObjectArray();
  std::vector<std::pair<int, int>> filters;
  for (int i = 0; i < present.size(); ++i) {
    btBroadphaseProxy* proxy = present[i]->getBroadphaseHandle();
    filters.emplace_back(proxy->m_collisionFilterGroup, proxy->m_collisionFilterMask);
    broadphase.getOverlappingPairCache()->cleanProxyFromPairs(proxy, &dispatcher);
    broadphase.destroyProxy(proxy, &dispatcher);
    present[i]->setBroadphaseHandle(nullptr);
  }
  broadphase.resetPool(&dispatcher);
  for (int i = 0; i < present.size(); ++i) {
    btCollisionObject* object = present[i];
    btVector3 lower, upper;
    object->getCollisionShape()->getAabb(object->getWorldTransform(), lower, upper);
    const auto& [group, mask] = filters[static_cast<std::size_t>(i)];
    object->setBroadphaseHandle(broadphase.createProxy(lower, upper, object->getCollisionShape()->getShapeType(),
                                                       object, group, mask, &dispatcher));
  }
  dynamics.forget_contacts();
}

void World::Impl::canonicalise() {
  set_state(state());
  rebuild_broadphase();
  boundary_step = steps;
  canonical = true;
  ++stamp;
}

void World::Impl::place(int index, const Transform& world_from_body) {
  if (index < 0 || index >= static_cast<int>(scene->bodies.size()) || !body(index).free)
    throw Error("place", "body " + std::to_string(index) + " is not free", "place free bodies only");
  BodySlot& mine = body_slot(index);
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
  for (int other = 0; other < static_cast<int>(scene->bodies.size()); ++other) {
    BodySlot& joined = body_slot(other);
    if (!joined.bond || !joined.bond->holds || body(other).joined_to != body(index).name) continue;
    joined.free->linear = joined.free->angular = Vector3::Zero();
    dynamics.place_bond(*joined.bond);
    forget_pairs(other);
  }
  canonical = false;
  ++stamp;
}

// What was moved by hand touches nothing until contacts are found anew.
void World::Impl::forget_pairs(int index) {
  for (const PartSlot& slot : body_slot(index).parts) {
    btCollisionObject* object = slot.object;
    if (!object->getBroadphaseHandle()) continue;
    broadphase.getOverlappingPairCache()->cleanProxyFromPairs(object->getBroadphaseHandle(), &dispatcher);
    world.updateSingleAabb(object);
  }
}

Snapshot World::snapshot() const {
  const Impl& w = *impl_;
  if (!w.canonical)
    throw Error("World::snapshot", "bodies have moved since the last boundary", "apply operation::Boundary first");
  auto data = std::make_shared<Snapshot::Data>();
  data->state = w.state();
  data->rest = w.dynamics.rest();
  for (const Mechanism& mechanism : w.mechanisms) data->locked.push_back(mechanism.locked);
  data->steps = w.steps;
  data->controller = w.controller;
  data->hand = w.hand;
  data->hand_step = w.hand_step;
  data->reference = w.reference;
  data->reference_now = w.reference_now;
  data->contacts = w.contacts.state();
  data->arm_torque = w.arm_torque;
  data->foreseen = w.foreseen;
  data->efforts = w.efforts;
  data->log = impl_->log.mark();
  return {data};
}

void World::restore(const Snapshot& snapshot) {
  Impl& w = *impl_;
  if (!snapshot.data) throw Error("World::restore", "an empty snapshot", "take it with World::snapshot");
  const Snapshot::Data& data = *snapshot.data;
  if (data.state.size() != w.state().size() || data.locked.size() != w.mechanisms.size())
    throw Error("World::restore", "the snapshot is of another scene", "restore into a world of an equal scene");
  w.set_state(data.state);
  w.rebuild_broadphase();
  w.dynamics.set_rest(data.rest);
  for (std::size_t i = 0; i < w.mechanisms.size(); ++i) w.mechanisms[i].locked = data.locked[i];
  w.steps = w.boundary_step = data.steps;
  w.controller = data.controller;
  w.hand = data.hand;
  w.hand_step = data.hand_step;
  w.reference = data.reference;
  w.reference_now = data.reference_now;
  w.contacts.set_state(data.contacts);
  w.arm_torque = data.arm_torque;
  w.foreseen = data.foreseen;
  w.acted = {};
  w.efforts = data.efforts;
  w.log.back_to(data.log);
  w.canonical = true;
  ++w.stamp;
}

std::string World::state_hash() const {
  const std::vector<double> state = impl_->state();
  return Hasher().bytes(state.data(), state.size() * sizeof(double)).digest();
}

}  // namespace stampede
