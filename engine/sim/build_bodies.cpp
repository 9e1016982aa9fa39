// Builds what moves and what is touched from the scene's bodies.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/sim/bodies.h"
#include "engine/sim/bullet_convert.h"

namespace stampede {
namespace {

enum class Role { still, moving, free, pad };  // of a part

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

void set_identity(btCollisionObject& object, int body, int part, Role role) {
  object.setUserIndex(body);
  object.setUserIndex2(part);
  // To Bullet's eyes what stands still is static and asleep, all else is awake: pairs that cannot touch cost nothing.
  const bool still = role == Role::still;
  const int flags = object.getCollisionFlags() & ~btCollisionObject::CF_STATIC_OBJECT;
  object.setCollisionFlags(still ? flags | btCollisionObject::CF_STATIC_OBJECT : flags);
  object.forceActivationState(still ? ISLAND_SLEEPING : DISABLE_DEACTIVATION);
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

Assembly assemble(const Body& body) {  // of a free one its first part moves
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
    a.still[p] = p == 0 ? !body.free : fixed && a.still[parent];
    a.host[p] = static_cast<int>(p);
    if (a.still[p]) continue;
    if (p > 0 && fixed && !has_collision(part)) {  // a frame or a lump of mass: Bullet need not know of it
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

class BodyBuilder {
 public:
  BodyBuilder(Bodies& bodies, ContactFinder& finder, Movers& movers)
      : bodies_(bodies), finder_(finder), movers_(movers) {}
  void build_free(int body);
  void build_jointed(int body);
  void let_links_meet();

 private:
  void join(int body, const Transform& part_from_link);
  btCollisionObject& add_object(PartRef ref, const Transform& link_from_part, Role role);

  Bodies& bodies_;
  ContactFinder& finder_;
  Movers& movers_;
};

void BodyBuilder::let_links_meet() {
  for (std::size_t p = 0; p < bodies_.scene().robot.body.parts.size(); ++p) {
    Dispatcher::Link& link = finder_.dispatcher.links.emplace_back();
    for (const Shape& shape : bodies_.scene().robot.body.parts[p].shapes)
      if (shape.collides)
        link.add({Convex(shape), bodies_.body_slot(kRobot).parts[p].link_from_part * shape.part_from_shape});
  }
}

void BodyBuilder::build_free(int index) {
  const Body& description = bodies_.body(index);
  const Part& part = description.parts[0];
  const LinkFrame frame = link_frame(part, of_part(part, Transform::Identity()), description.name);
  const Transform link_from_part = frame.part_from_link.inverse();
  btCollisionObject& object = add_object({index, 0}, link_from_part, Role::free);
  object.setWorldTransform(to_bullet(Transform(description.world_from_body * frame.part_from_link)));
  bodies_.body_slot(index).free =
      &movers_.add_free({&object, part.mass, frame.moments, Vector3::Zero(), Vector3::Zero()});
  if (!description.joined_to.empty()) join(index, frame.part_from_link);
}

// A free body to the joint of another body's part.
void BodyBuilder::join(int index, const Transform& part_from_link) {
  const Body& description = bodies_.body(index);
  const int host = bodies_.scene().body_index(description.joined_to);
  if (host < 0 || host >= index || description.joined_part >= static_cast<int>(bodies_.body(host).parts.size()) ||
      description.joined_part < 0)
    throw Error(description.name, "it is joined to '" + description.joined_to + "', which is no earlier body",
                "order bodies so that what carries comes first");
  const Joint& joint = description.parts[0].joint;
  const PartSlot& on = bodies_.slot({host, description.joined_part});
  Bond bond;
  bond.on = on.object;
  bond.body = bodies_.body_slot(index).free;
  bond.on_from_joint = on.link_from_part * joint.parent_from_joint;
  bond.body_from_joint = part_from_link.inverse();
  bond.kind = joint.kind;
  bond.axis = joint.axis.normalized();
  bond.lead = lead_of(joint);
  bond.lower = joint.lower;
  bond.upper = joint.upper;
  bond.friction = joint.friction;
  bond.lets_go = joint.lets_go;
  bond.upwards = joint.lets_go > joint.initial;
  bond.position = joint.initial;
  bodies_.body_slot(index).bond = &movers_.add_bond(bond);
}

void BodyBuilder::build_jointed(int index) {
  const Body& description = bodies_.body(index);
  const Assembly assembly = assemble(description);
  BodySlot& slot = bodies_.body_slot(index);
  std::vector<Transform> still(description.parts.size(), Transform::Identity());
  if (assembly.links > 0) slot.tree = &movers_.add_tree(description.world_from_body, description.free, index != kRobot);
  for (std::size_t p = 0; p < description.parts.size(); ++p) {
    const Part& part = description.parts[p];
    const auto parent = static_cast<std::size_t>(std::max(part.parent, 0));
    const PartRef ref{index, static_cast<int>(p)};
    PartSlot& mine = slot.parts[p];
    if (assembly.still[p]) {
      still[p] = p == 0 ? Transform::Identity() : still[parent] * part.joint.parent_from_joint;
      add_object(ref, Transform::Identity(), Role::still)
          .setWorldTransform(to_bullet(Transform(description.world_from_body * still[p])));
      continue;
    }
    if (assembly.host[p] != static_cast<int>(p)) {
      mine = slot.parts[static_cast<std::size_t>(assembly.host[p])];
      mine.link_from_part = mine.link_from_part * assembly.host_from_part[p];
      mine.dof = -1;
      continue;
    }
    const MassProperties& mass = assembly.masses[p];
    const LinkFrame frame = link_frame(part, mass, description.name + "." + part.name);
    const std::vector<int>& pads = bodies_.scene().robot.pads;
    const bool pad = index == kRobot && std::find(pads.begin(), pads.end(), static_cast<int>(p)) != pads.end();
    const bool root = description.free && p == 0;
    btCollisionObject& object = add_object(ref, frame.part_from_link.inverse(),
                                           pad    ? Role::pad
                                           : root ? Role::free
                                                  : Role::moving);
    Articulation::Link link;
    // The parent's part may be merged into another: the joint is seen from that one's frame.
    if (!root) {
      link.parent = assembly.still[parent] ? -1 : assembly.link[parent];
      link.parent_from_joint =
          (assembly.still[parent] ? still[parent] : assembly.host_from_part[parent]) * part.joint.parent_from_joint;
      link.kind = part.joint.kind;
    }
    link.axis = part.joint.axis.normalized();
    link.lead = lead_of(part.joint);
    link.mass = mass.mass;
    link.centre = mass.centre;
    link.inertia = mass.inertia;
    link.object = &object;
    link.link_from_object = frame.part_from_link;
    mine.tree = slot.tree;
    mine.link = slot.tree->add(link);
    mine.dof = root ? -1 : slot.tree->dof(mine.link);
    movers_.add_object(object, *slot.tree, mine.link);
    if (mine.dof < 0) continue;
    slot.tree->position[static_cast<std::size_t>(mine.dof)] = part.joint.initial;
    if (part.joint.lower < part.joint.upper)
      movers_.add_stop(*slot.tree, {mine.dof, part.joint.lower, part.joint.upper});
  }
  if (slot.tree) slot.tree->place();
}

// In the world only where it collides with anything.
btCollisionObject& BodyBuilder::add_object(PartRef ref, const Transform& link_from_part, Role role) {
  const Part& description = bodies_.part(ref);
  finder_.objects.push_back(std::make_unique<btCollisionObject>());
  btCollisionObject& object = *finder_.objects.back();
  object.setCollisionShape(make_part_shape(description, link_from_part, finder_.shapes));
  set_surface(object, description, role);
  set_identity(object, ref.body, ref.part, role);
  PartSlot& slot = bodies_.body_slot(ref.body).parts[static_cast<std::size_t>(ref.part)];
  slot.object = &object;
  slot.link_from_part = link_from_part;
  if (has_collision(description)) finder_.world.addCollisionObject(&object);
  return object;
}

}  // namespace

void Bodies::build(ContactFinder& finder, Movers& movers) {
  finder.filter.links = {scene_->robot.checked_pairs.begin(), scene_->robot.checked_pairs.end()};
  slots_.resize(scene_->bodies.size() + 1);
  BodyBuilder builder(*this, finder, movers);
  for (int index = kRobot; index < count(); ++index) {
    const Body& description = body(index);
    if (description.parts.empty()) throw Error(description.name, "a body needs at least one part", "give it a part");
    body_slot(index).parts.resize(description.parts.size());
    if (description.free && description.parts.size() == 1)
      builder.build_free(index);
    else
      builder.build_jointed(index);
  }
  builder.let_links_meet();
}

}  // namespace stampede
