// Builds Bullet's bodies from the scene's, always in the same order: Bullet's ids follow it.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/sim/impl.h"

namespace stampede {
namespace {

struct MassProperties {
  double mass = 0;
  Vector3 centre = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();  // about the centre
};

// Where the link's frame is (centre of mass, principal axes) and the principal moments.
struct LinkFrame {
  Transform part_from_link = Transform::Identity();
  Vector3 moments = Vector3::Ones();
};

MassProperties of_part(const Part& part, const Transform& host_from_part) {
  const Matrix3 turn = host_from_part.linear();
  return {part.mass, host_from_part * part.centre_of_mass, turn * part.inertia * turn.transpose()};
}

MassProperties combined(const MassProperties& a, const MassProperties& b) {
  if (!(b.mass > 0)) return a;
  if (!(a.mass > 0)) return b;
  MassProperties sum;
  sum.mass = a.mass + b.mass;
  sum.centre = (a.mass * a.centre + b.mass * b.centre) / sum.mass;
  const auto shifted = [&](const MassProperties& m) -> Matrix3 {
    const Vector3 d = m.centre - sum.centre;
    return m.inertia + m.mass * (d.squaredNorm() * Matrix3::Identity() - d * d.transpose());
  };
  sum.inertia = shifted(a) + shifted(b);
  return sum;
}

bool is_diagonal(const Matrix3& m) {
  const double scale = m.diagonal().cwiseAbs().maxCoeff() * 1e-9;
  return std::abs(m(0, 1)) <= scale && std::abs(m(0, 2)) <= scale && std::abs(m(1, 2)) <= scale;
}

// The one shape that collides, or the one that there is; null: several. What is only drawn must not change the physics.
const Shape* lone_shape(const Part& part) {
  const bool any = has_collision(part);
  const Shape* lone = nullptr;
  for (const Shape& shape : part.shapes) {
    if (any && !shape.collides) continue;
    if (lone != nullptr) return nullptr;
    lone = &shape;
  }
  return lone;
}

// Prefers the axes of a lone shape, then the part's, to those that a solver for eigenvectors would pick: the shape
// can then be used bare, and equal moments leave nothing to chance.
LinkFrame link_frame(const Part& part, const MassProperties& m, const std::string& where) {
  if (!(m.mass > 0)) throw Error(where, "a part that moves needs mass", "give its mass, or a density");
  LinkFrame frame;
  frame.part_from_link.translation() = m.centre;
  std::vector<Matrix3> candidates{Matrix3::Identity()};
  if (const Shape* lone = lone_shape(part))
    candidates.insert(candidates.begin(), Matrix3(lone->part_from_shape.linear()));
  for (const Matrix3& axes : candidates) {
    const Matrix3 turned = axes.transpose() * m.inertia * axes;
    if (!is_diagonal(turned)) continue;
    frame.part_from_link.linear() = axes;
    frame.moments = turned.diagonal();
    break;
  }
  if (!is_diagonal(frame.part_from_link.linear().transpose() * m.inertia * frame.part_from_link.linear())) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(m.inertia);
    Matrix3 axes = solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
    frame.part_from_link.linear() = axes;
    frame.moments = solver.eigenvalues();
  }
  if (!(frame.moments.minCoeff() > 0))
    throw Error(where, "its inertia is not positive definite", "leave the inertia out to have it computed");
  return frame;
}

bool has_flat_sides_only(const Part& part) {
  return std::all_of(part.shapes.begin(), part.shapes.end(), [](const Shape& shape) {
    return !shape.collides || shape.kind == ShapeKind::box || shape.kind == ShapeKind::hull;
  });
}

enum class Role { still, moving, free, pad };

// What measurements asked for. Pads: without anchor and coupling a held cube creeps or falls, and more rolling or
// spinning friction stops a handle from turning in the hand. Free bodies: without anchors five stacked cubes wander
// 15 mm in 30 s, with them less than 1 mm. Flat sides resist turning by themselves: rows for it cost time and drift.
void set_surface(btCollisionObject& object, const Part& part, Role role) {
  Surface surface = part.surface;
  if (role == Role::pad) {
    surface.anchor = true;
    surface.friction = std::max(surface.friction, 1.0);
    surface.rolling = surface.spinning = 0.01;
  } else if (role == Role::still || has_flat_sides_only(part)) {
    surface.rolling = surface.spinning = 0;
  }
  if (role == Role::free) surface.anchor = true;
  object.setFriction(surface.friction);
  object.setRollingFriction(surface.rolling);
  object.setSpinningFriction(surface.spinning);
  object.setRestitution(surface.restitution);
  if (surface.anchor) object.setCollisionFlags(object.getCollisionFlags() | btCollisionObject::CF_HAS_FRICTION_ANCHOR);
}

void set_identity(btCollisionObject& object, int body, int part, bool collides) {
  object.setUserIndex(body);
  object.setUserIndex2(part);
  object.setUserIndex3(collides ? 1 : 0);
  object.setActivationState(DISABLE_DEACTIVATION);  // sleeping holds state that no snapshot can reach
}

// Of each part of a fixed body: what it is rigidly part of, and how.
struct Assembly {
  std::vector<bool> still;  // never moves
  std::vector<int> host;    // the part whose link carries it; itself, unless merged
  std::vector<Transform> host_from_part;
  std::vector<MassProperties> masses;  // per host
  std::vector<int> link;               // per part: link of its host, -1 still
  int links = 0;
};

Assembly assemble(const Body& body) {
  const std::size_t count = body.parts.size();
  Assembly a{std::vector<bool>(count),
             std::vector<int>(count),
             std::vector<Transform>(count, Transform::Identity()),
             std::vector<MassProperties>(count),
             std::vector<int>(count, -1),
             0};
  for (std::size_t p = 0; p < count; ++p) {
    const Part& part = body.parts[p];
    const auto parent = static_cast<std::size_t>(std::max(part.parent, 0));
    if (p > 0 && (part.parent < 0 || parent >= p))
      throw Error(body.name, "part '" + part.name + "' comes before its parent", "order parts from the base outwards");
    const bool fixed = p == 0 || part.joint.kind == JointKind::fixed;
    a.still[p] = p == 0 || (fixed && a.still[parent]);
    a.host[p] = static_cast<int>(p);
    if (a.still[p]) continue;
    if (fixed && !has_collision(part)) {  // a frame or a lump of mass: Bullet need not know of it
      a.host[p] = a.host[parent];
      a.host_from_part[p] = a.host_from_part[parent] * part.joint.parent_from_joint;
    } else {
      a.link[p] = a.links++;
    }
    const auto host = static_cast<std::size_t>(a.host[p]);
    a.link[p] = a.link[host];
    a.masses[host] = combined(a.masses[host], of_part(part, a.host_from_part[p]));
  }
  return a;
}

}  // namespace

bool PairFilter::needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  const auto* one = static_cast<const btCollisionObject*>(a->m_clientObject);
  const auto* two = static_cast<const btCollisionObject*>(b->m_clientObject);
  if (one->getUserIndex() == two->getUserIndex()) return false;
  if (one->isStaticObject() && two->isStaticObject()) return false;
  return one->getUserIndex3() == 1 && two->getUserIndex3() == 1;
}

void World::Impl::build() {
  bodies.resize(scene->bodies.size() + 1);
  for (int index = kRobot; index < static_cast<int>(scene->bodies.size()); ++index) {
    const Body& description = body(index);
    if (description.parts.empty()) throw Error(description.name, "a body needs at least one part", "give it a part");
    body_slot(index).parts.resize(description.parts.size());
    if (description.free) {
      build_free(index);
    } else {
      build_fixed(index);
    }
  }
  build_robot_motors();
  build_mechanisms();
}

void World::Impl::build_free(int index) {
  const Body& description = body(index);
  const Part& part = description.parts[0];
  if (description.parts.size() != 1)
    throw Error(description.name, "a free body has exactly one part", "fix it to the world, or make it one part");
  const LinkFrame frame = link_frame(part, of_part(part, Transform::Identity()), description.name);
  const Transform link_from_part = frame.part_from_link.inverse();
  btRigidBody::btRigidBodyConstructionInfo info(part.mass, nullptr, make_part_shape(part, link_from_part, shapes),
                                                to_bullet(frame.moments));
  info.m_startWorldTransform = to_bullet(Transform(description.world_from_body * frame.part_from_link));
  auto rigid = std::make_unique<btRigidBody>(info);
  set_surface(*rigid, part, Role::free);
  set_identity(*rigid, index, 0, has_collision(part));
  BodySlot& slot = body_slot(index);
  slot.free = rigid.get();
  slot.parts[0].object = rigid.get();
  slot.parts[0].link_from_part = link_from_part;
  world.addRigidBody(rigid.get());
  objects.push_back(std::move(rigid));
}

void World::Impl::add_static_part(int index, int part_index, const Transform& world_from_part) {
  const Part& description = part({index, part_index});
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr,
                                                make_part_shape(description, Transform::Identity(), shapes));
  info.m_startWorldTransform = to_bullet(world_from_part);
  auto rigid = std::make_unique<btRigidBody>(info);
  set_surface(*rigid, description, Role::still);
  set_identity(*rigid, index, part_index, has_collision(description));
  body_slot(index).parts[static_cast<std::size_t>(part_index)].object = rigid.get();
  if (has_collision(description)) world.addRigidBody(rigid.get());
  objects.push_back(std::move(rigid));
}

void World::Impl::build_fixed(int index) {
  const Body& description = body(index);
  const Assembly assembly = assemble(description);
  BodySlot& slot = body_slot(index);
  std::vector<Transform> still(description.parts.size(), Transform::Identity());
  if (assembly.links > 0) {
    multibodies.push_back(
        std::make_unique<btMultiBody>(assembly.links, 1.0, btVector3(1, 1, 1), /*fixedBase=*/true, /*canSleep=*/false));
    slot.multibody = multibodies.back().get();
    slot.multibody->setBaseWorldTransform(to_bullet(description.world_from_body));
  }
  for (std::size_t p = 0; p < description.parts.size(); ++p) {
    const Part& part = description.parts[p];
    const auto parent = static_cast<std::size_t>(std::max(part.parent, 0));
    PartSlot& mine = slot.parts[p];
    if (assembly.still[p]) {
      still[p] = p == 0 ? Transform::Identity() : still[parent] * part.joint.parent_from_joint;
      add_static_part(index, static_cast<int>(p), description.world_from_body * still[p]);
      continue;
    }
    mine.multibody = slot.multibody;
    mine.link = assembly.link[p];
    if (assembly.host[p] != static_cast<int>(p)) {
      const PartSlot& host = slot.parts[static_cast<std::size_t>(assembly.host[p])];
      mine.link_from_part = host.link_from_part * assembly.host_from_part[p];
      continue;
    }
    const LinkFrame frame = link_frame(part, assembly.masses[p], description.name + "." + part.name);
    mine.link_from_part = frame.part_from_link.inverse();
    mine.driven_by_joint = part.joint.kind != JointKind::fixed;
    // Bullet chains centre-of-mass frames; a still parent counts as the base, whose frame is part 0's.
    const Transform parent_link_from_joint =
        (assembly.still[parent] ? still[parent] : slot.parts[parent].link_from_part) * part.joint.parent_from_joint;
    const int parent_link = assembly.still[parent] ? -1 : assembly.link[parent];
    const btQuaternion turn = to_bullet(
        Quaternion(Matrix3(mine.link_from_part.linear() * parent_link_from_joint.linear().transpose())).normalized());
    const btVector3 axis = to_bullet(Vector3(mine.link_from_part.linear() * part.joint.axis.normalized()));
    const btVector3 to_pivot = to_bullet(Vector3(parent_link_from_joint.translation()));
    const btVector3 to_centre = to_bullet(Vector3(-mine.link_from_part.translation()));
    const double mass = assembly.masses[p].mass;
    const btVector3 moments = to_bullet(frame.moments);
    if (part.joint.kind == JointKind::hinge) {
      slot.multibody->setupRevolute(mine.link, mass, moments, parent_link, turn, axis, to_pivot, to_centre, true);
    } else if (part.joint.kind == JointKind::slider) {
      slot.multibody->setupPrismatic(mine.link, mass, moments, parent_link, turn, axis, to_pivot, to_centre, true);
    } else {
      slot.multibody->setupFixed(mine.link, mass, moments, parent_link, turn, to_pivot, to_centre);
    }
  }
  if (slot.multibody) add_joint_constraints(index, assembly.host);
}

void World::Impl::add_joint_constraints(int index, const std::vector<int>& host) {
  const Body& description = body(index);
  BodySlot& slot = body_slot(index);
  btMultiBody& multibody = *slot.multibody;
  multibody.finalizeMultiDof();
  multibody.setLinearDamping(0);
  multibody.setAngularDamping(0);
  multibody.setHasSelfCollision(false);
  world.addMultiBody(&multibody);
  for (std::size_t p = 0; p < slot.parts.size(); ++p) {
    PartSlot& mine = slot.parts[p];
    const Part& part = description.parts[p];
    if (!mine.multibody || host[p] != static_cast<int>(p)) continue;
    // Every link gets a collider, if only an empty one: Bullet solves a joint's motor only where one is.
    auto collider = std::make_unique<btMultiBodyLinkCollider>(&multibody, mine.link);
    collider->setCollisionShape(make_part_shape(part, mine.link_from_part, shapes));
    const std::vector<int>& pads = scene->robot.pads;
    const bool pad = index == kRobot && std::find(pads.begin(), pads.end(), static_cast<int>(p)) != pads.end();
    set_surface(*collider, part, pad ? Role::pad : Role::moving);
    set_identity(*collider, index, static_cast<int>(p), has_collision(part));
    multibody.getLink(mine.link).m_collider = collider.get();
    mine.object = collider.get();
    world.addCollisionObject(collider.get(), 1, -1);
    objects.push_back(std::move(collider));
    if (!mine.driven_by_joint) continue;
    multibody.setJointPos(mine.link, part.joint.initial);
    if (part.joint.lower < part.joint.upper) {
      auto limit =
          std::make_unique<btMultiBodyJointLimitConstraint>(&multibody, mine.link, part.joint.lower, part.joint.upper);
      world.addMultiBodyConstraint(limit.get());
      constraints.push_back(std::move(limit));
    }
  }
  for (PartSlot& mine : slot.parts)  // merged parts were met before their host had its collider
    if (mine.multibody && !mine.object) mine.object = multibody.getLink(mine.link).m_collider;
  multibody.forwardKinematics(scratch_rotations, scratch_origins);
  multibody.updateCollisionObjectWorldTransforms(scratch_rotations, scratch_origins);
}

}  // namespace stampede
