#include "engine/start/standing.h"

#include <algorithm>
#include <cmath>

#include "engine/motion/looked.h"
#include "engine/sim/overlap.h"
#include "engine/sim/world.h"

namespace stampede {
namespace {

JointVector arm_at_start(const Robot& robot) {
  JointVector start(static_cast<Eigen::Index>(robot.arm.size()));
  for (std::size_t i = 0; i < robot.arm.size(); ++i)
    start[static_cast<Eigen::Index>(i)] = robot.body.parts[static_cast<std::size_t>(robot.arm[i])].joint.initial;
  return start;
}

// All that a body's parts are placed by, to the last bit.
std::string placing_of(const Body& body) {
  std::string bytes;
  const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (int i = 0; i < 16; ++i) add(body.world_from_body.matrix().data()[i]);
  for (const Part& part : body.parts) add(part.joint.initial);
  return bytes;
}

bool joints_at_rest(const World& world) {
  constexpr double kStill = 0.005;  // m/s or rad/s
  for (std::size_t b = 0; b < world.scene().bodies.size(); ++b)
    for (std::size_t p = 1; p < world.scene().bodies[b].parts.size(); ++p)
      if (std::abs(world.joint_velocity({static_cast<int>(b), static_cast<int>(p)})) > kStill) return false;
  return true;
}

}  // namespace

std::optional<Blocked> blocked_arm(const CollisionState& state, const Robot& robot) {
  const JointVector start = arm_at_start(robot);
  const std::optional<Overlap> deepest = deepest_overlap(state, start);
  if (!deepest) return std::nullopt;
  const std::string one = name_of_part(state.scene(), deepest->one),
                    other = name_of_part(state.scene(), deepest->other);
  Blocked blocked{"the arm being free where it starts: " + one + " touches " + other,
                  deepest->depth,
                  {},
                  one + other + placing_of(robot.body)};
  const auto link = [&](PartRef part) { return robot.body.parts[static_cast<std::size_t>(part.part)].name; };
  if (deepest->other.on_robot() && deepest->one.on_robot())
    blocked.cure = "where only their shapes say so: allowed = { { \"" + link(deepest->one) + "\", \"" +
                   link(deepest->other) + "\" } } in worlds/robots/" + robot.name + ".lua; else another home or shape";
  else
    blocked.moment += placing_of(state.scene().body_at(deepest->other.body));
  return blocked;
}

std::optional<Blocked> blocked_bodies(const CollisionState& state, bool settled) {
  const double most_m = settled ? 0.001 : kPlacedDepth_m;
  const Scene& scene = state.scene();
  std::vector<Overlap> all = overlapping_bodies(state, most_m);
  if (!settled)
    std::erase_if(all, [&](const Overlap& pair) {
      return scene.body_at(pair.one.body).free && scene.body_at(pair.other.body).free;
    });
  if (all.empty()) return std::nullopt;
  const Overlap& worst = all.front();
  const std::string one = name_of_part(scene, worst.one), other = name_of_part(scene, worst.other);
  return Blocked{other + " being clear of " + one,
                 worst.depth,
                 {},
                 one + other + placing_of(scene.body_at(worst.one.body)) + placing_of(scene.body_at(worst.other.body))};
}

bool all_at_rest(const WorldView& view) {
  if (!joints_at_rest(view.world())) return false;
  for (const Object& thing : view.scene().objects)
    if (thing.kind == ObjectKind::body && !view.at_rest(thing.name)) {
      const int body = view.scene().body_index(thing.body);
      if (body >= 0 && view.scene().bodies[static_cast<std::size_t>(body)].free) return false;
    }
  return true;
}

}  // namespace stampede
