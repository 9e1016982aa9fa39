#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/base/error.h"
#include "engine/motion/candidate_shapes.h"
#include "engine/motion/candidates.h"
#include "engine/motion/checker.h"

namespace stampede {
namespace {

constexpr double kDepth_m = 0.030;  // the palm is 37 mm behind the tip
constexpr double kApproach_m = 0.08;
constexpr double kHair_m =
    0.001;  // between the open hand and what is beside it: the arm is not quite where it should be
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

// Everything that might be a grasp.
std::vector<Option> make_options(const Robot& robot, const Object& object, const Part& part, RandomKey key) {
  std::vector<Option> options;
  for (const Grasp& grasp : object.grasps)
    options.push_back({grasp.object_from_tip, grasp.width, grasp.force, grasp.approach, 0});
  if (object.grasps.empty()) {
    const double force = force_for(part.mass, robot.grip_force);
    for (std::size_t i = 0; i < part.shapes.size(); ++i) {
      if (!part.shapes[i].collides) continue;
      const auto found = shape_grasps(part.shapes[i], robot.opening_max, kDepth_m,
                                      key.with("shape").with(static_cast<std::int64_t>(i)));
      for (const ShapeGrasp& grasp : found)
        options.push_back({grasp.part_from_tip, grasp.width, force, kApproach_m, 20 * grasp.off_centre});
    }
  }
  return options;
}

// Best first: from above, centred, the rest by chance.
void put_in_order(std::vector<Option>& options, const Transform& world_from_object, const Transform& world_from_tip,
                  Random random) {
  for (Option& option : options) {
    const double down = (world_from_object.linear() * option.object_from_tip.linear().col(2)).z();
    const Quaternion turned(world_from_object.linear() * option.object_from_tip.linear());
    const double turn = angle_between(turned, Quaternion(world_from_tip.linear())) / std::numbers::pi;
    // `down` is -1 from straight above; half a turn of the wrist costs a second.
    option.score += 2 * (1 + down) + 0.5 * turn + 0.5 * random.uniform();
  }
  std::stable_sort(options.begin(), options.end(), [](const Option& a, const Option& b) { return a.score < b.score; });
}

// Where the arm ends that follows a path of the tip in so many steps, without a jump; nothing: it cannot.
template <typename Path>
std::optional<JointVector> followed(const Arm& arm, JointVector q, int steps, const Path& path, RandomKey key) {
  constexpr double kMostJump = 0.6;  // rad
  for (int i = 1; i <= steps; ++i) {
    const std::optional<JointVector> next = arm.solve(path(static_cast<double>(i) / steps), q, key, 0);
    if (!next || (*next - q).cwiseAbs().maxCoeff() > kMostJump) return std::nullopt;
    q = *next;
  }
  return q;
}

// Whether the arm can go on with the part that it takes hold of. Asked once of each place: a hand that comes there less
// wide open, since nothing else found room, holds the part no differently.
class GoingOn {
 public:
  GoingOn(const std::optional<PartWay>& follow, RandomKey key) : follow_(follow), key_(key) {}
  bool from(const CollisionState& state, const JointVector& q, double width) {
    if (!follow_) return true;
    for (const Answer& one : known_)
      if (one.width == width && one.q == q) return one.goes;
    PartWay way = *follow_;
    way.opening = width;
    known_.push_back({q, width, can_go_with_part(state, q, way, key_)});
    return known_.back().goes;
  }
  // Who has to slide a part needs the right joints; a handle that turns in the hand leaves more of a choice.
  bool slides() const { return follow_ && follow_->turn == 0; }

 private:
  struct Answer {
    JointVector q;
    double width;
    bool goes;
  };
  std::optional<PartWay> follow_;
  RandomKey key_;
  std::vector<Answer> known_;
};

// Reachable and free at both poses, and the arm can go straight from one to the other.
bool feasible(const CollisionState& state, const GraspCandidate& grasp, const JointVector& start, RandomKey key,
              GoingOn& going_on) {
  const Arm& arm = state.arm();
  // The hand alone first: among neighbours most grasps end there, and need no inverse kinematics.
  if (!state.hand_free(grasp.world_from_tip, kHair_m) || !state.hand_free(grasp.world_from_approach)) return false;
  const int most = going_on.slides() ? 6 : 3, restarts = going_on.slides() ? 24 : 12;
  for (const JointVector& q : arm.solutions(grasp.world_from_approach, start, key, most, restarts)) {
    if (!state.free(q)) continue;
    const auto approach = [&](double way) {
      Transform tip = grasp.world_from_approach;
      tip.translation() += way * (grasp.world_from_tip.translation() - grasp.world_from_approach.translation());
      return tip;
    };
    const std::optional<JointVector> there = followed(arm, q, 4, approach, key);
    if (there && state.free(*there) && going_on.from(state, *there, grasp.width)) return true;
  }
  return false;
}

// What keeps the arm from a grasp, if anything.
Looked judged(const CollisionState& state, const GraspCandidate& grasp, const JointVector& start, RandomKey key) {
  Looked looked{Looked::Fate::out_of_reach, grasp.world_from_tip, grasp.opening};
  const auto free = [&](const std::vector<JointVector>& ways) {
    looked.touched = touched_in_all(state, ways);
    if (!looked.touched.empty()) looked.fate = Looked::Fate::touches;
    return !ways.empty() && looked.touched.empty();
  };
  if (!free(state.arm().solutions(grasp.world_from_tip, start, key, 3, 12))) return looked;
  looked.approach = true;
  if (!free(state.arm().solutions(grasp.world_from_approach, start, key, 3, 12))) return looked;
  looked.approach = false;
  GoingOn nowhere({}, key);
  looked.fate = feasible(state, grasp, start, key, nowhere) ? Looked::Fate::usable : Looked::Fate::no_way;
  return looked;
}

// How near a grasp came that is not feasible: how far the hand would have to be moved.
void measure_miss(const CollisionState& state, const GraspCandidate& grasp, const JointVector& start, RandomKey key,
                  Looked& looked) {
  const Transform& tip = looked.approach ? grasp.world_from_approach : grasp.world_from_tip;
  if (looked.fate == Looked::Fate::out_of_reach)
    note_shortfall(state.arm().shortfall(tip, start, key), state.scene().robot, looked);
  if (looked.fate != Looked::Fate::touches || state.hand_free(tip)) return;  // else it is the arm that touches
  std::vector<Vector3> directions = {Vector3::UnitZ()};
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) directions.push_back(sign * tip.linear().col(axis));
  looked.missed_m = way_to_free(tip, directions, [&](const Transform& moved) { return state.hand_free(moved); });
}

// All that might be a grasp of one object.
struct Search {
  explicit Search(const GraspQuery& query, const std::optional<PartWay>& follow = {})
      : opening_max(query.world.scene().robot.opening_max), authored(!query.object.grasps.empty()) {
    const Part& part = part_of(query.world.scene(), query.object, ref.body);
    ref.part = query.object.part;
    world_from_body = query.world.world_from_part(ref);
    if (follow) world_from_body = follow->before * world_from_body;
    options = make_options(query.world.scene().robot, query.object, part, query.key);
    put_in_order(options, world_from_body, query.state.arm().world_from_tip(query.start),
                 Random(query.key.with("order")));
    if (options.size() > kMostTested) options.resize(kMostTested);
  }
  // Authored grasps may touch what they were authored for; those from geometry start clear of it.
  CollisionState hand(const CollisionState& state) const {
    CollisionState hand = state;
    if (authored) hand.allow(ref);
    return hand;
  }
  GraspCandidate candidate(const Option& option, double room) const {
    GraspCandidate grasp;
    grasp.object_from_tip = option.object_from_tip;
    grasp.world_from_tip = world_from_body * option.object_from_tip;
    grasp.world_from_approach = grasp.world_from_tip * translation(0, 0, -option.approach);
    grasp.width = option.width;
    grasp.opening = std::min(opening_max, option.width + room);
    grasp.force = option.force;
    return grasp;
  }

  PartRef ref;
  double opening_max;
  bool authored;
  Transform world_from_body;
  std::vector<Option> options;
};

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

std::vector<GraspCandidate> grasp_candidates(const GraspQuery& query, int most, const std::optional<PartWay>& follow) {
  const Search search(query, follow);
  const RandomKey key = query.key.with("ik");
  GoingOn going_on(follow, key);
  std::vector<GraspCandidate> found;
  CollisionState hand = search.hand(query.state);
  for (const double room : {search.opening_max, kNarrow_m}) {  // among neighbours open fingers need not be wide open
    if (!found.empty()) break;
    for (const Option& option : search.options) {
      if (static_cast<int>(found.size()) >= most) break;
      GraspCandidate grasp = search.candidate(option, room);
      grasp.index = static_cast<int>(found.size());
      hand.set_opening(grasp.opening);
      if (!feasible(hand, grasp, query.start, key, going_on)) continue;
      if (!query.wanted || query.wanted(grasp)) found.push_back(grasp);
    }
  }
  return found;
}

std::vector<Looked> look_at_grasps(const GraspQuery& query, bool measure) {
  constexpr int kMostMeasured = 12;  // of each cause
  const Search search(query);
  CollisionState hand = search.hand(query.state);
  std::vector<Looked> all;
  std::map<std::string, int> measured;
  for (const Option& option : search.options) {
    const GraspCandidate grasp = search.candidate(option, kNarrow_m);
    hand.set_opening(grasp.opening);
    Looked looked = judged(hand, grasp, query.start, query.key.with("ik"));
    looked.best = option.score < search.options.front().score + 1;  // from above, where there are such
    if (measure && ++measured[cause_of(looked)] <= kMostMeasured)
      measure_miss(hand, grasp, query.start, query.key.with("miss"), looked);
    all.push_back(std::move(looked));
  }
  return all;
}

std::string why_no_grasp(std::span<const Looked> grasps) {
  if (grasps.empty()) return "no two sides of it fit between the fingers, and it says no grasps";
  Causes best, others;
  for (const Looked& one : grasps) (one.best ? best : others).add(cause_of(one));
  return "of " + std::to_string(grasps.size()) + " grasps the best: " + best.text() +
         (others.empty() ? "" : "; others: " + others.text());
}

}  // namespace stampede
