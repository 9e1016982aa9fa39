#include "engine/sim/world.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/sim/collision_state.h"
#include "engine/sim/impl.h"

namespace stampede {

constexpr int kSolverIterations = 20;  // measured: fewer lets grasps slip, more buys little
constexpr int kStrainedIterations =
    120;                          // a light part between a stop and a strong arm: 20 let it sink in by centimetres
constexpr double kAskew = 3e-4;   // m between two coupled fingers
constexpr double kStrain = 5e-5;  // m or rad beyond its stop
constexpr double kOverStop_rad = 1e-3;

// Bullet's own pools are 7 MB that each new world clears. A scene has some hundred pairs; more of them go to the heap.
static btDefaultCollisionConstructionInfo small_pools() {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = info.m_defaultMaxCollisionAlgorithmPoolSize = 256;
  return info;
}

World::Impl::Impl(std::shared_ptr<const Scene> scene_in)
    : scene(std::move(scene_in)),
      arm(scene->robot),
      dt(1.0 / scene->physics_hz),
      configuration(small_pools()),
      dispatcher(&configuration),
      world(&dispatcher, &broadphase, &configuration),
      dynamics(world, scene->gravity, dt) {
  world.setForceUpdateAllAabbs(false);  // what stands still does
  broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
  world.getDispatchInfo().m_deterministicOverlappingPairs = true;  // else results depend on the broadphase's history
  poses.resize(scene->bodies.size() + 1);
  pose_stamps.resize(poses.size());
  efforts.resize(poses.size());
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const std::size_t parts = body(static_cast<int>(b) - 1).parts.size();
    poses[b].resize(parts, Transform::Identity());
    pose_stamps[b].resize(parts, 0);
    efforts[b].resize(parts, 0);
  }
  build();
  canonicalise();
}

World::Impl::~Impl() {
  // Bullet's lists hold plain pointers: emptied before the owners let go.
  for (auto it = objects.rbegin(); it != objects.rend(); ++it)
    if ((*it)->getBroadphaseHandle()) world.removeCollisionObject(it->get());
}

const Body& World::Impl::body(int index) const {
  return index == kRobot ? scene->robot.body : scene->bodies[static_cast<std::size_t>(index)];
}

const Part& World::Impl::part(PartRef ref) const { return body(ref.body).parts[static_cast<std::size_t>(ref.part)]; }

const PartSlot& World::Impl::slot(PartRef ref) const {
  return body_slot(ref.body).parts[static_cast<std::size_t>(ref.part)];
}

const Transform& World::Impl::world_from_part(PartRef ref) const {
  const auto b = static_cast<std::size_t>(ref.body + 1), p = static_cast<std::size_t>(ref.part);
  if (pose_stamps[b][p] != stamp) {
    const PartSlot& here = bodies[b].parts[p];
    poses[b][p] = from_bullet(here.object->getWorldTransform()) * here.link_from_part;
    pose_stamps[b][p] = stamp;
  }
  return poses[b][p];
}

double World::Impl::position(PartRef ref) const {
  const PartSlot& here = slot(ref);
  if (ref.part == 0 && body_slot(ref.body).bond) return body_slot(ref.body).bond->position;
  return here.dof >= 0 ? here.tree->position[static_cast<std::size_t>(here.dof)] : 0;
}

JointVector World::Impl::arm_position_now() const {
  JointVector q(static_cast<Eigen::Index>(arm_motors.size()));
  for (std::size_t j = 0; j < arm_motors.size(); ++j)
    q[static_cast<Eigen::Index>(j)] = body_slot(kRobot).tree->position[static_cast<std::size_t>(arm_motors[j]->dof)];
  return q;
}

JointVector World::Impl::arm_velocity_now() const {
  JointVector v(static_cast<Eigen::Index>(arm_motors.size()));
  for (std::size_t j = 0; j < arm_motors.size(); ++j)
    v[static_cast<Eigen::Index>(j)] = body_slot(kRobot).tree->velocity[static_cast<std::size_t>(arm_motors[j]->dof)];
  return v;
}

void World::Impl::check_robot(int robot) const {
  if (robot != 0) throw Error("robot", "there is no robot " + std::to_string(robot), "the scene has one: robot 0");
}

Vector3 World::Impl::velocity(PartRef ref, Vector3* linear) const {
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

void World::Impl::read_efforts() {
  const auto applied = [](const JointMotor* motor) { return motor ? motor->force : 0.0; };
  const Robot& robot = scene->robot;
  for (std::size_t j = 0; j < arm_motors.size(); ++j)
    efforts[0][static_cast<std::size_t>(robot.arm[j])] =
        applied(arm_motors[j]) + arm_torque[static_cast<Eigen::Index>(j)];
  for (std::size_t f = 0; f < finger_motors.size(); ++f)
    efforts[0][static_cast<std::size_t>(robot.fingers[f])] = applied(finger_motors[f]);
  for (const Mechanism& mechanism : mechanisms)
    efforts[static_cast<std::size_t>(mechanism.part.body + 1)][static_cast<std::size_t>(mechanism.part.part)] =
        applied(mechanism.brake) + applied(mechanism.spring) + mechanism.torque;
}

World::World(std::shared_ptr<const Scene> scene) : impl_(std::make_unique<Impl>(std::move(scene))) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const Scene& World::scene() const { return *impl_->scene; }
const Arm& World::arm(int robot) const {
  impl_->check_robot(robot);
  return impl_->arm;
}
std::int64_t World::step_count() const { return impl_->steps; }
double World::dt() const { return impl_->dt; }
std::vector<Command> World::log() const { return impl_->log.commands(); }

void World::let_sleep(bool sleep) { impl_->dynamics.let_sleep(sleep); }

void World::keep_log(bool keep) {
  impl_->keeps_log = keep;
  if (!keep) impl_->log.clear();
}

// Something presses a joint against its stop, or the hand holds what is joined to something.
bool World::Impl::strained() const {
  const auto beyond = [&](PartRef ref) {
    const Joint& joint = part(ref).joint;
    if (!(joint.lower < joint.upper)) return false;
    const double q = position(ref);
    return q < joint.lower - kStrain || q > joint.upper + kStrain;
  };
  const std::vector<int>& fingers = scene->robot.fingers;
  const bool askew =
      fingers.size() == 2 && std::abs(position({kRobot, fingers[0]}) - position({kRobot, fingers[1]})) > kAskew;
  const std::optional<PartRef> held = contacts.grasped(scene->robot.pads);
  const bool bonded = held && held->body >= 0 && body_slot(held->body).bond && body_slot(held->body).bond->holds;
  return askew || bonded ||
         std::any_of(mechanisms.begin(), mechanisms.end(), [&](const Mechanism& m) { return beyond(m.part); }) ||
         std::any_of(fingers.begin(), fingers.end(), [&](int finger) {
           return beyond({kRobot, finger});
         });
}

// A crash at full speed takes an arm's joint by a hundredth of a radian over its stop before Bullet's limit begins to
// act. The stop is rigid: it is put back, at rest.
void World::Impl::keep_within_stops() {
  Articulation& robot = *body_slot(kRobot).tree;
  bool moved = false;
  for (std::size_t j = 0; j < arm_motors.size(); ++j) {
    const JointLimits& limits = scene->robot.limits[j];
    const auto dof = static_cast<std::size_t>(arm_motors[j]->dof);
    const double q = robot.position[dof];
    if (!(limits.lower < limits.upper) || (q >= limits.lower - kOverStop_rad && q <= limits.upper + kOverStop_rad))
      continue;
    robot.position[dof] = std::clamp(q, limits.lower, limits.upper);
    robot.velocity[dof] = 0;
    moved = true;
  }
  if (moved) robot.place();
}

void World::step() {
  Impl& w = *impl_;
  w.control();
  w.move_mechanisms();
  w.anchors.before_step(w.world);
  w.dynamics.step(w.strained() ? kStrainedIterations : kSolverIterations);
  w.keep_within_stops();
  w.anchors.after_step(w.dispatcher);
  w.contacts.add_step(w.dispatcher, w.dt);
  w.read_efforts();
  ++w.steps;
  ++w.stamp;
  if (w.under_torque())
    w.reference_now = {w.arm_position_now(), w.arm_velocity_now(), JointVector::Zero(w.arm.joints())};
  w.canonical = false;
}

namespace {

void check_joints(const JointVector& v, int joints, const char* operation) {
  if (v.size() != joints || !v.allFinite())
    throw Error(operation, "it needs a finite number for each of the arm's " + std::to_string(joints) + " joints",
                "give one position and one velocity a joint");
}

}  // namespace

void World::apply(const Operation& operation) {
  Impl& w = *impl_;
  w.check_robot(robot_of(operation).value_or(0));
  if (std::holds_alternative<operation::Boundary>(operation)) {
    w.canonicalise();
  } else if (const auto* controller = std::get_if<operation::Controller>(&operation)) {
    w.controller = *controller;
  } else if (const auto* follow = std::get_if<operation::Follow>(&operation)) {
    if (follow->trajectory.knots.empty()) throw Error("follow", "the trajectory has no knots", "give at least one");
    for (const Trajectory::Knot& knot : follow->trajectory.knots) {
      check_joints(knot.position, w.arm.joints(), "follow");
      check_joints(knot.velocity, w.arm.joints(), "follow");
      check_joints(knot.acceleration, w.arm.joints(), "follow");
    }
    w.reference = {std::make_shared<const Trajectory>(follow->trajectory), w.steps, {}};
    w.reference_now = w.reference_at(w.steps);
  } else if (const auto* hand = std::get_if<operation::Hand>(&operation)) {
    if (!std::isfinite(hand->opening) || !(hand->force >= 0))
      throw Error("hand", "opening and force must be finite, the force not negative", "give m and N");
    w.hand = {std::clamp(hand->opening, 0.0, w.scene->robot.opening_max), hand->force};
    w.hand_step = w.steps;
  } else if (const auto* setpoint = std::get_if<operation::Setpoint>(&operation)) {
    check_joints(setpoint->position, w.arm.joints(), "setpoint");
    check_joints(setpoint->velocity, w.arm.joints(), "setpoint");
    const JointVector still = JointVector::Zero(w.arm.joints());
    w.reference = {nullptr, w.steps, {setpoint->position, setpoint->velocity, still}};
    w.reference_now = w.reference.setpoint;
  } else if (const auto* servo = std::get_if<operation::Servo>(&operation)) {
    if (servo->value.size() != w.arm.joints() || !servo->value.allFinite())
      throw Error("servo",
                  "it needs a finite number for each of the arm's " + std::to_string(w.arm.joints()) + " joints",
                  "give rad, rad/s or N m");
    w.serve(*servo);
  } else if (const auto* place = std::get_if<operation::Place>(&operation)) {
    w.place(place->body, place->world_from_body);
  }
  if (w.keeps_log) w.log.add({w.steps, operation});
}

const Transform& World::world_from_part(PartRef part) const { return impl_->world_from_part(part); }

Vector3 World::linear_velocity(PartRef part) const {
  Vector3 linear;
  impl_->velocity(part, &linear);
  return linear;
}

Vector3 World::angular_velocity(PartRef part) const { return impl_->velocity(part, nullptr); }
double World::joint_position(PartRef part) const { return impl_->position(part); }

double World::joint_velocity(PartRef part) const {
  const PartSlot& slot = impl_->slot(part);
  if (joined(part)) {
    const Body& body = scene().bodies[static_cast<std::size_t>(part.body)];
    const Joint& joint = body.parts.front().joint;
    const PartRef on{scene().body_index(body.joined_to), body.joined_part};
    const Vector3 axis = world_from_part(part).linear() * joint.axis.normalized();
    const bool slides = joint.kind == JointKind::slider;
    return axis.dot(slides ? Vector3(linear_velocity(part) - linear_velocity(on))
                           : Vector3(angular_velocity(part) - angular_velocity(on)));
  }
  return slot.dof >= 0 ? slot.tree->velocity[static_cast<std::size_t>(slot.dof)] : 0;
}

double World::joint_effort(PartRef part) const {
  return impl_->efforts[static_cast<std::size_t>(part.body + 1)][static_cast<std::size_t>(part.part)];
}

bool World::joined(PartRef part) const {
  const Bond* bond = part.part == 0 ? impl_->body_slot(part.body).bond : nullptr;
  return bond != nullptr && bond->holds;
}

bool World::latched(PartRef part) const {
  return std::any_of(impl_->mechanisms.begin(), impl_->mechanisms.end(),
                     [&](const Mechanism& m) { return m.part == part && m.locked; });
}

JointVector World::arm_position(int robot) const {
  impl_->check_robot(robot);
  return impl_->arm_position_now();
}

const operation::Controller& World::controller(int robot) const {
  impl_->check_robot(robot);
  return impl_->controller;
}

JointVector World::arm_velocity(int robot) const {
  impl_->check_robot(robot);
  return impl_->arm_velocity_now();
}

JointState World::reference(int robot) const {
  impl_->check_robot(robot);
  return impl_->reference_now;
}

bool World::following(int robot) const {
  impl_->check_robot(robot);
  const Reference& reference = impl_->reference;
  return reference.trajectory && impl_->steps - reference.start_step < reference.trajectory->steps();
}

Transform World::world_from_tip(int robot) const {
  impl_->check_robot(robot);
  const Robot& its = impl_->scene->robot;
  return impl_->world_from_part(PartRef::of_robot(its.tip_part, robot)) * its.tip_part_from_tip;
}

bool World::steered(int robot) const {
  impl_->check_robot(robot);
  return impl_->reference.servo.has_value();
}

std::vector<std::string> World::limited(int robot) const {
  impl_->check_robot(robot);
  return impl_->acted.names();
}

void World::forget_limited() { impl_->acted = {}; }

double World::opening(int robot) const {
  impl_->check_robot(robot);
  double sum = 0;
  for (const int finger : impl_->scene->robot.fingers) sum += impl_->position({kRobot, finger});
  return sum;
}

double World::commanded_opening(int robot) const {
  impl_->check_robot(robot);
  return impl_->hand.opening;
}

const std::vector<Contact>& World::contacts() const { return impl_->contacts.closed(); }
void World::close_window() { impl_->contacts.close(); }

CollisionState World::Impl::now_for_planning() const {
  const Impl& w = *this;
  if (!w.collision_model) w.collision_model = std::make_shared<const CollisionModel>(w.scene);
  std::vector<Transform> world_from_part;
  for (int b = 0; b < static_cast<int>(w.scene->bodies.size()); ++b)
    for (int p = 0; p < static_cast<int>(w.body(b).parts.size()); ++p)
      world_from_part.push_back(w.world_from_part({b, p}));
  std::vector<double> robot_positions;
  for (int p = 0; p < static_cast<int>(w.scene->robot.body.parts.size()); ++p)
    robot_positions.push_back(w.position({kRobot, p}));
  return {w.collision_model, world_from_part, std::move(robot_positions)};
}

CollisionState World::collision_state() const {
  CollisionState state = impl_->now_for_planning();
  state.set_loads(loads());
  return state;
}

std::optional<PartRef> World::grasped(int robot) const {
  impl_->check_robot(robot);
  return impl_->contacts.grasped(impl_->scene->robot.pads);
}

}  // namespace stampede
