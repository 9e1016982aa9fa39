// What is let fall, thrown or let go only loses energy, and comes to rest: every shipped thing and mechanism.
#include <catch2/catch.hpp>
#include <set>

#include "engine/base/random.h"
#include "engine/sim/collision_state.h"
#include "engine/sim/world.h"
#include "tests/support/make_start.h"
#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

constexpr double kGravity = 9.81;
constexpr double kFall_s = 12;    // at most
constexpr double kDeep = 0.0025;  // m: what lands on a tip is so deep in the table before it is lifted out
constexpr int kTurns = 3;         // of each thing before it falls

double of_spring(const Joint& joint, double q) {
  const double way = std::abs(q - joint.spring_target);
  return joint.spring_force * way + joint.stiffness * way * way / 2;
}

// Of all that moves but the robot, J.
struct Energy {
  double kinetic = 0, potential = 0;
  double all() const { return kinetic + potential; }
};

Energy energy_of(const World& world) {
  Energy energy;
  const std::vector<Body>& bodies = world.scene().bodies;
  for (int b = 0; b < static_cast<int>(bodies.size()); ++b) {
    const Body& body = bodies[static_cast<std::size_t>(b)];
    for (int p = 0; p < static_cast<int>(body.parts.size()); ++p) {
      const Part& part = body.parts[static_cast<std::size_t>(p)];
      if (p == 0 && !body.free) continue;
      const Transform& place = world.world_from_part({b, p});
      const Vector3 spin = place.linear().transpose() * world.angular_velocity({b, p});
      energy.kinetic += part.mass * world.linear_velocity({b, p}).squaredNorm() / 2 + spin.dot(part.inertia * spin) / 2;
      energy.potential += part.mass * kGravity * (place * part.centre_of_mass).z();
      if (p > 0) energy.potential += of_spring(part.joint, world.joint_position({b, p}));
    }
  }
  return energy;
}

double mass_of(const Body& body) {
  double mass = 0;
  for (const Part& part : body.parts) mass += part.mass;
  return mass;
}

struct Fall {
  double gained = 0;  // J, at most, over the least there was
  double lost = 0;    // J, in all
  double left = 0;    // J, of motion, in the end
};

Fall watch(World& world, double seconds) {
  Fall fall;
  const double first = energy_of(world).all();
  double least = first;
  for (int step = 0; step < seconds / world.dt(); ++step) {
    world.step();
    const Energy energy = energy_of(world);
    fall.left = energy.kinetic;
    if (step > 1 / world.dt() && energy.kinetic == 0) break;
    const double now = energy.all();
    fall.gained = std::max(fall.gained, now - least);
    least = std::min(least, now);
  }
  fall.lost = first - least;
  return fall;
}

// Somewhere above where it is, turned anyhow, where it touches nothing.
bool lift(World& world, int body, Random& random) {
  const Transform from = world.world_from_part({body, 0});
  const CollisionState space = world.collision_state();
  for (double up = 0.1; up < 0.6; up += 0.05) {
    const double roll = random.between(-3, 3), pitch = random.between(-1.5, 1.5), yaw = random.between(-3, 3);
    const Transform to = make_transform(from.translation() + Vector3(0, 0, up),
                                        Quaternion(rotation_rpy(roll, pitch, yaw).linear() * from.linear()));
    if (!space.body_free(body, to, 0.002)) continue;
    world.apply(operation::Place{body, to});
    return true;
  }
  return false;
}

std::shared_ptr<const Scene> start_of(const std::string& task) {
  RunOptions options;
  options.seed = 4;
  EpisodeScripts scripts(shipped(), task, first_variation(task), options.seed);
  const Start start = make_start(scripts.task(), scripts.symbols(), options);
  INFO(task << " " << start.detail);
  REQUIRE(start.scene);
  return start.scene;
}

// Every free body of the task's start falls, one after the other; types that fell already do not again.
void let_fall(const std::string& task, std::set<std::string>& done) {
  const std::shared_ptr<const Scene> scene = start_of(task);
  INFO(task);
  World world(scene);
  world.keep_log(false);
  const Fall settling = watch(world, 1);
  CHECK(settling.gained < 0.005);
  world.apply(operation::Boundary{});
  const Snapshot settled = world.snapshot();
  for (const Object& object : scene->objects) {
    if (object.kind != ObjectKind::body) continue;
    const int index = scene->body_index(object.body);
    const Body& body = scene->bodies[static_cast<std::size_t>(index)];
    if (!body.free || !body.joined_to.empty() || !done.insert(object.class_name).second) continue;
    Random random(RandomKey("fall").with(object.class_name));
    for (int turn = 0; turn < kTurns; ++turn) {
      world.restore(settled);
      if (!lift(world, index, random)) continue;
      world.step();  // what is joined to it comes along
      const Fall fall = watch(world, kFall_s);
      INFO(object.name << ", turn " << turn);
      CHECK(fall.gained < mass_of(body) * kGravity * kDeep);
      CHECK(fall.left < 1e-5);
    }
  }
}

// All joints of the task's furniture at a share of their range, those that follow others where these have them.
Scene opened(const Scene& scene, double share) {
  Scene other = scene;
  for (Body& body : other.bodies)
    for (Part& part : body.parts)
      if (Joint& joint = part.joint; joint.lower < joint.upper && joint.follows.empty())
        joint.initial = joint.lower + share * (joint.upper - joint.lower);
  for (Body& body : other.bodies)
    for (Part& part : body.parts)
      for (const Part& leader : body.parts)
        if (!part.joint.follows.empty() && leader.joint.name == part.joint.follows)
          part.joint.initial = part.joint.follow_ratio * leader.joint.initial + part.joint.follow_offset;
  return other;
}

}  // namespace

TEST_CASE("what is let fall, whatever it is, wins no energy and comes to rest", "[energy]") {
  std::set<std::string> done;
  for (const std::string& name : shipped_tasks()) let_fall(name, done);
  CHECK(done.size() > 60);
}

TEST_CASE("a mechanism that is let go anywhere on its way wins no energy and comes to rest", "[energy]") {
  int mechanisms = 0;
  for (const std::string& name : shipped_tasks()) {
    const std::shared_ptr<const Scene> scene = start_of(name);
    if (std::ranges::any_of(scene->bodies, &Body::free)) continue;
    for (const double share : {0.15, 0.4, 0.8}) {
      INFO(name << " at " << share);
      World world(std::make_shared<const Scene>(opened(*scene, share)));
      world.keep_log(false);
      const Fall fall = watch(world, kFall_s);
      CHECK(fall.gained < 0.02 * fall.lost + 2e-4);  // a heavy flap is thrown back a little by its stop
      CHECK(fall.left < 1e-5);
    }
    ++mechanisms;
  }
  CHECK(mechanisms > 15);
}
