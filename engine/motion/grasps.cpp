#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "engine/motion/candidate_shapes.h"
#include "engine/motion/candidates.h"

namespace stampede {
namespace {

constexpr double kDepth_m = 0.030;  // the palm is 37 mm behind the tip
constexpr double kApproach_m = 0.08;
constexpr double kNarrow_m = 0.02;  // wider than the object, where wide open fingers meet something
constexpr std::size_t kMostTested = 96;

struct Option {
  Transform object_from_tip;
  double width = 0, force = 0, approach = kApproach_m;
  double score = 0;  // smallest first
};

double force_for(double mass, double most) {
  if (mass > 0 && mass < 0.1) return std::min(10.0, most);
  return mass > 0.35 ? std::max(40.0, most) : most;
}

const Part& part_of(const Scene& scene, const Object& object, int& body) {
  body = scene.body_index(object.body);
  if (body < 0) throw Error("grasps", "object '" + object.name + "' has no body");
  return scene.bodies[static_cast<std::size_t>(body)].parts.at(static_cast<std::size_t>(object.part));
}

// Everything that might be a grasp, best first: from above, centred, the rest by chance.
std::vector<Option> make_options(const Scene& scene, const Object& object, const Part& part,
                                 const Transform& world_from_object, const Transform& world_from_tip, RandomKey key) {
  std::vector<Option> options;
  for (const Grasp& grasp : object.grasps)
    options.push_back({grasp.object_from_tip, grasp.width, grasp.force, grasp.approach, 0});
  if (object.grasps.empty()) {
    const double force = force_for(part.mass, scene.robot.grip_force);
    for (std::size_t i = 0; i < part.shapes.size(); ++i) {
      if (!part.shapes[i].collides) continue;
      const auto found = shape_grasps(part.shapes[i], scene.robot.opening_max, kDepth_m,
                                      key.with("shape").with(static_cast<std::int64_t>(i)));
      for (const ShapeGrasp& grasp : found)
        options.push_back({grasp.part_from_tip, grasp.width, force, kApproach_m, 20 * grasp.off_centre});
    }
  }
  Random random(key.with("order"));
  for (Option& option : options) {
    const double down = (world_from_object.linear() * option.object_from_tip.linear().col(2)).z();
    const Quaternion turned(world_from_object.linear() * option.object_from_tip.linear());
    const double turn = angle_between(turned, Quaternion(world_from_tip.linear())) / std::numbers::pi;
    // `down` is -1 from straight above; half a turn of the wrist costs a second.
    option.score += 2 * (1 + down) + 0.5 * turn + 0.5 * random.uniform();
  }
  std::stable_sort(options.begin(), options.end(), [](const Option& a, const Option& b) { return a.score < b.score; });
  return options;
}

// Reachable and free at both poses, and the arm can go straight from one to the other.
bool feasible(const CollisionState& state, const GraspCandidate& grasp, const JointVector& start, RandomKey key) {
  const Arm& arm = state.arm();
  // The hand alone first: among neighbours most grasps end there, and need no inverse kinematics.
  if (!state.hand_free(grasp.world_from_tip) || !state.hand_free(grasp.world_from_approach)) return false;
  for (const JointVector& q : arm.solutions(grasp.world_from_approach, start, key, 3, 12)) {
    if (!state.free(q)) continue;
    constexpr int kSteps = 4;
    std::optional<JointVector> last = q;
    for (int i = 1; i <= kSteps && last; ++i) {
      Transform tip = grasp.world_from_approach;
      tip.translation() += (static_cast<double>(i) / kSteps) *
                           (grasp.world_from_tip.translation() - grasp.world_from_approach.translation());
      const JointVector before = *last;
      last = arm.solve(tip, before, key, 0);
      if (last && (*last - before).cwiseAbs().maxCoeff() > 0.6) last.reset();
    }
    if (last && state.free(*last)) return true;
  }
  return false;
}

}  // namespace

Transform world_from_object(const World& world, const Object& object) {
  const Scene& scene = world.scene();
  if (object.kind == ObjectKind::hand) return world.world_from_tip();
  if (object.kind == ObjectKind::region) {
    const int index = scene.region_index(object.name);
    if (index < 0) throw Error("motion", "object '" + object.name + "' names no region");
    const Region& region = scene.regions[static_cast<std::size_t>(index)];
    if (region.body.empty()) return region.part_from_region;
    return world.world_from_part({scene.body_index(region.body), region.part}) * region.part_from_region;
  }
  int body = 0;
  part_of(scene, object, body);
  return world.world_from_part({body, object.part});
}

std::vector<GraspCandidate> grasp_candidates(const CollisionState& state, const World& world, const Object& object,
                                             const JointVector& start, RandomKey key, int most) {
  int body = 0;
  const Scene& scene = world.scene();
  const Part& part = part_of(scene, object, body);
  const Transform world_from_body = world.world_from_part({body, object.part});
  std::vector<Option> options =
      make_options(scene, object, part, world_from_body, state.arm().world_from_tip(start), key);
  if (options.size() > kMostTested) options.resize(kMostTested);
  std::vector<GraspCandidate> found;
  CollisionState hand = state;
  // Authored grasps may touch what they were authored for; those from geometry start clear of it.
  if (!object.grasps.empty()) hand.allow({body, object.part});
  for (const double room :
       {scene.robot.opening_max, kNarrow_m}) {  // among neighbours open fingers need not be wide open
    if (!found.empty()) break;
    for (const Option& option : options) {
      if (static_cast<int>(found.size()) >= most) break;
      GraspCandidate grasp;
      grasp.object_from_tip = option.object_from_tip;
      grasp.world_from_tip = world_from_body * option.object_from_tip;
      grasp.world_from_approach = grasp.world_from_tip * translation(0, 0, -option.approach);
      grasp.width = option.width;
      grasp.opening = std::min(scene.robot.opening_max, option.width + room);
      grasp.force = option.force;
      grasp.index = static_cast<int>(found.size());
      hand.set_opening(grasp.opening);
      if (feasible(hand, grasp, start, key.with("ik"))) found.push_back(grasp);
    }
  }
  return found;
}

}  // namespace stampede
