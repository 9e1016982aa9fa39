#include "engine/sim/world.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/sim/collision_state.h"
#include "engine/sim/impl.h"

namespace stampede {

constexpr int kSolverIterations = 20;     // measured: fewer lets grasps slip, more buys little
constexpr int kStrainedIterations = 120;  // of a light part between a stop and a strong arm: 20 let it sink in

World::Impl::Impl(std::shared_ptr<const Scene> scene_in)
    : scene(std::move(scene_in)),
      clock{1.0 / scene->physics_hz},
      dynamics(finder, scene->gravity, clock.dt),
      bodies(scene),
      control(bodies, contacts, dynamics.movers(), clock) {
  efforts.resize(scene->bodies.size() + 1);
  for (std::size_t b = 0; b < efforts.size(); ++b)
    efforts[b].resize(bodies.body(static_cast<int>(b) - 1).parts.size(), 0);
  bodies.build(finder, dynamics.movers());
  control.build();
  mechanisms = build_mechanisms(bodies, dynamics.movers(), clock.dt);
  canonicalise();
}

void World::Impl::check_robot(int robot) const {
  if (robot != 0) throw Error("robot", "there is no robot " + std::to_string(robot), "the scene has one: robot 0");
}

void World::Impl::read_efforts() {
  control.read_efforts(efforts[0]);
  for (const Mechanism& mechanism : mechanisms)
    efforts[static_cast<std::size_t>(mechanism.part.body + 1)][static_cast<std::size_t>(mechanism.part.part)] =
        mechanism.effort();
}

World::World(std::shared_ptr<const Scene> scene) : impl_(std::make_unique<Impl>(std::move(scene))) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const Scene& World::scene() const { return *impl_->scene; }
const Arm& World::arm(int robot) const {
  impl_->check_robot(robot);
  return impl_->control.arm();
}
std::int64_t World::step_count() const { return impl_->clock.steps; }
double World::dt() const { return impl_->clock.dt; }
std::vector<Command> World::log() const { return impl_->log.commands(); }

void World::let_sleep(bool sleep) { impl_->dynamics.let_sleep(sleep); }

void World::keep_log(bool keep) {
  impl_->keeps_log = keep;
  if (!keep) impl_->log.clear();
}

// Something presses a joint against its stop, or the hand holds what is joined to something.
bool World::Impl::strained() const {
  return control.strained() || std::any_of(mechanisms.begin(), mechanisms.end(),
                                           [&](const Mechanism& one) { return bodies.strains(one.part); });
}

void World::Impl::move_mechanisms() {
  for (Mechanism& mechanism : mechanisms) {
    const Joint& joint = bodies.part(mechanism.part).joint;
    mechanism.turn_lock(joint);
    mechanism.give_forces(joint, clock.dt);
  }
}

void World::Impl::step() {
  control.step();
  move_mechanisms();
  anchors.before_step(finder.world);
  dynamics.step(strained() ? kStrainedIterations : kSolverIterations);
  control.keep_within_stops();
  anchors.after_step(finder.dispatcher);
  contacts.add_step(finder.dispatcher, clock.dt);
  read_efforts();
  ++clock.steps;
  bodies.moved();
  control.after_step();
  canonical = false;
}

void World::step() { impl_->step(); }

namespace {

void check_joints(const JointVector& v, int joints, const char* operation) {
  if (v.size() != joints || !v.allFinite())
    throw Error(operation, "it needs a finite number for each of the arm's " + std::to_string(joints) + " joints",
                "give one position and one velocity a joint");
}

}  // namespace

void World::apply(const Operation& operation) {
  Impl& w = *impl_;
  const int joints = w.control.arm().joints();
  w.check_robot(robot_of(operation).value_or(0));
  if (std::holds_alternative<operation::Boundary>(operation)) {
    w.canonicalise();
  } else if (const auto* controller = std::get_if<operation::Controller>(&operation)) {
    w.control.controller = *controller;
  } else if (const auto* follow = std::get_if<operation::Follow>(&operation)) {
    if (follow->trajectory.knots.empty()) throw Error("follow", "the trajectory has no knots", "give at least one");
    for (const Trajectory::Knot& knot : follow->trajectory.knots) {
      check_joints(knot.position, joints, "follow");
      check_joints(knot.velocity, joints, "follow");
      check_joints(knot.acceleration, joints, "follow");
    }
    w.control.reference = {std::make_shared<const Trajectory>(follow->trajectory), w.clock.steps, {}};
    w.control.reference_now = w.control.reference_at(w.clock.steps);
  } else if (const auto* hand = std::get_if<operation::Hand>(&operation)) {
    if (!std::isfinite(hand->opening) || !(hand->force >= 0))
      throw Error("hand", "opening and force must be finite, the force not negative", "give m and N");
    w.control.hand = {std::clamp(hand->opening, 0.0, w.scene->robot.opening_max), hand->force};
    w.control.hand_step = w.clock.steps;
  } else if (const auto* setpoint = std::get_if<operation::Setpoint>(&operation)) {
    check_joints(setpoint->position, joints, "setpoint");
    check_joints(setpoint->velocity, joints, "setpoint");
    const JointVector still = JointVector::Zero(joints);
    w.control.reference = {nullptr, w.clock.steps, {setpoint->position, setpoint->velocity, still}};
    w.control.reference_now = w.control.reference.setpoint;
  } else if (const auto* servo = std::get_if<operation::Servo>(&operation)) {
    if (servo->value.size() != joints || !servo->value.allFinite())
      throw Error("servo", "it needs a finite number for each of the arm's " + std::to_string(joints) + " joints",
                  "give rad, rad/s or N m");
    w.control.serve(*servo);
  } else if (const auto* place = std::get_if<operation::Place>(&operation)) {
    w.place(place->body, place->world_from_body);
  }
  if (w.keeps_log) w.log.add({w.clock.steps, operation});
}

const Transform& World::world_from_part(PartRef part) const { return impl_->bodies.world_from_part(part); }

Vector3 World::linear_velocity(PartRef part) const {
  Vector3 linear;
  impl_->bodies.velocity(part, &linear);
  return linear;
}

Vector3 World::angular_velocity(PartRef part) const { return impl_->bodies.velocity(part, nullptr); }
double World::joint_position(PartRef part) const { return impl_->bodies.position(part); }

double World::joint_velocity(PartRef part) const {
  const PartSlot& slot = impl_->bodies.slot(part);
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

bool World::joined(PartRef part) const { return impl_->bodies.joined(part); }

bool World::latched(PartRef part) const {
  return std::any_of(impl_->mechanisms.begin(), impl_->mechanisms.end(),
                     [&](const Mechanism& m) { return m.part == part && m.locked; });
}

JointVector World::arm_position(int robot) const {
  impl_->check_robot(robot);
  return impl_->control.position();
}

const operation::Controller& World::controller(int robot) const {
  impl_->check_robot(robot);
  return impl_->control.controller;
}

JointVector World::arm_velocity(int robot) const {
  impl_->check_robot(robot);
  return impl_->control.velocity();
}

JointState World::reference(int robot) const {
  impl_->check_robot(robot);
  return impl_->control.reference_now;
}

bool World::following(int robot) const {
  impl_->check_robot(robot);
  const Reference& reference = impl_->control.reference;
  return reference.trajectory && impl_->clock.steps - reference.start_step < reference.trajectory->steps();
}

Transform World::world_from_tip(int robot) const {
  impl_->check_robot(robot);
  const Robot& its = impl_->scene->robot;
  return impl_->bodies.world_from_part(PartRef::of_robot(its.tip_part, robot)) * its.tip_part_from_tip;
}

bool World::steered(int robot) const {
  impl_->check_robot(robot);
  return impl_->control.reference.servo.has_value();
}

std::vector<std::string> World::limited(int robot) const {
  impl_->check_robot(robot);
  return impl_->control.acted().names();
}

void World::forget_limited() { impl_->control.acted() = {}; }

double World::opening(int robot) const {
  impl_->check_robot(robot);
  double sum = 0;
  for (const int finger : impl_->scene->robot.fingers) sum += impl_->bodies.position({kRobot, finger});
  return sum;
}

double World::commanded_opening(int robot) const {
  impl_->check_robot(robot);
  return impl_->control.hand.opening;
}

const std::vector<Contact>& World::contacts() const { return impl_->contacts.closed(); }
void World::close_window() { impl_->contacts.close(); }

CollisionState World::collision_state() const {
  CollisionState state = impl_->bodies.for_planning();
  state.set_loads(loads(*this));
  return state;
}

std::optional<PartRef> World::grasped(int robot) const {
  impl_->check_robot(robot);
  return impl_->control.grasped();
}

}  // namespace stampede
