#include "engine/sim/bodies.h"

#include "engine/sim/bullet_convert.h"

namespace stampede {
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

Bodies::Bodies(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {
  poses_.resize(scene_->bodies.size() + 1);
  pose_stamps_.resize(poses_.size());
  for (std::size_t b = 0; b < poses_.size(); ++b) {
    const std::size_t parts = body(static_cast<int>(b) - 1).parts.size();
    poses_[b].resize(parts, Transform::Identity());
    pose_stamps_[b].resize(parts, 0);
  }
}

const Body& Bodies::body(int index) const {
  return index == kRobot ? scene_->robot.body : scene_->bodies[static_cast<std::size_t>(index)];
}

const std::vector<Transform>& Bodies::world_from_robot_parts() const {
  for (std::size_t p = 0; p < poses_[0].size(); ++p) world_from_part({kRobot, static_cast<int>(p)});
  return poses_[0];
}

bool Bodies::joined(PartRef ref) const {
  const Bond* bond = ref.part == 0 ? body_slot(ref.body).bond : nullptr;
  return bond != nullptr && bond->holds;
}

bool Bodies::strains(PartRef ref) const {
  constexpr double kStrain = 5e-5;  // m or rad
  const Joint& joint = part(ref).joint;
  if (!(joint.lower < joint.upper)) return false;
  const double q = position(ref);
  return q < joint.lower - kStrain || q > joint.upper + kStrain;
}

const Transform& Bodies::world_from_part(PartRef ref) const {
  const auto b = static_cast<std::size_t>(ref.body + 1), p = static_cast<std::size_t>(ref.part);
  if (pose_stamps_[b][p] != stamp_) {
    const PartSlot& here = slots_[b].parts[p];
    poses_[b][p] = from_bullet(here.object->getWorldTransform()) * here.link_from_part;
    pose_stamps_[b][p] = stamp_;
  }
  return poses_[b][p];
}

double Bodies::position(PartRef ref) const {
  const PartSlot& here = slot(ref);
  if (ref.part == 0 && body_slot(ref.body).bond) return body_slot(ref.body).bond->position;
  return here.dof >= 0 ? here.tree->position[static_cast<std::size_t>(here.dof)] : 0;
}

Vector3 Bodies::velocity(PartRef ref, Vector3* linear) const {
  if (linear) linear->setZero();
  const BodySlot& mine = body_slot(ref.body);
  if (mine.free) {
    if (linear) *linear = mine.free->linear;
    return mine.free->angular;
  }
  Vector3 angular = Vector3::Zero();
  const Vector3 centre = world_from_part(ref) * part(ref).centre_of_mass;
  if (mine.floats()) {
    const std::vector<double>& v = mine.tree->velocity;
    angular = {v[3], v[4], v[5]};
    if (linear)
      *linear = Vector3(v[0], v[1], v[2]) + angular.cross(centre - mine.tree->world_from_root().translation());
  }
  for (int at = ref.part; at >= 0; at = part({ref.body, at}).parent) {
    const PartSlot& here = slot({ref.body, at});
    if (here.dof < 0) continue;
    const Transform& pose = world_from_part({ref.body, at});
    const Joint& joint = part({ref.body, at}).joint;
    const Vector3 rate =
        pose.linear() * joint.axis.normalized() * here.tree->velocity[static_cast<std::size_t>(here.dof)];
    if (joint.kind != JointKind::slider) angular += rate;
    if (!linear) continue;
    if (joint.kind == JointKind::slider)
      *linear += rate;
    else
      *linear += rate.cross(centre - pose.translation()) + lead_of(joint) * rate;
  }
  return angular;
}

CollisionState Bodies::for_planning() const {
  if (!collision_model_) collision_model_ = std::make_shared<const CollisionModel>(scene_);
  std::vector<Transform> still;
  for (int b = 0; b < count(); ++b)
    for (int p = 0; p < static_cast<int>(body(b).parts.size()); ++p) still.push_back(world_from_part({b, p}));
  std::vector<double> robot_positions;
  for (int p = 0; p < static_cast<int>(scene_->robot.body.parts.size()); ++p)
    robot_positions.push_back(position({kRobot, p}));
  return {collision_model_, still, std::move(robot_positions)};
}

// Free bodies: rotation matrix, origin, velocities; whether a bond holds, and where. Trees: of a floating one the
// rotation matrix and origin, positions, velocities.
std::vector<double> Bodies::state() const {
  std::vector<double> out;
  for (const BodySlot& slot : slots_) {
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

void Bodies::set_state(const std::vector<double>& state) {
  Reader in{state.data()};
  for (BodySlot& slot : slots_) {
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

}  // namespace stampede
