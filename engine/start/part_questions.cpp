#include "engine/start/part_questions.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/base/error.h"
#include "engine/motion/candidates.h"
#include "engine/motion/looked.h"

namespace stampede {
namespace {

constexpr double kFollowsReference = 0.02;  // rad: further off, contact holds the arm
constexpr std::size_t kEnoughGrasps = 2;    // grasps: not by a hair

void put(const WorldView& view, const std::string& part, double position, CollisionState& space) {
  space.move_part(view.part_of(part), view.part_at(part, position) * view.world_from(part).inverse());
}

// The world as planning sees it, with a part that is in front of something open, as far as it is pulled.
CollisionState space_behind(const WorldView& view, const std::string& before) {
  CollisionState space = view.world().collision_state();
  if (before.empty()) return space;
  const auto& numbers = view.object(before).numbers;
  put(view, before, numbers.contains("pull") ? numbers.at("pull") : view.joint_range(before).second, space);
  return space;
}

// Where a number of the part lies on its way from where its joint is to where another of its numbers says.
std::optional<double> share_of(const WorldView& view, const std::string& part, const std::string& to,
                               const std::string& number) {
  const auto& numbers = view.object(part).numbers;
  if (!numbers.contains(to) || !numbers.contains(number)) return std::nullopt;
  const double from = view.joint(part);
  return (numbers.at(number) - from) / (numbers.at(to) - from);
}

// That the arm can go with the part no further.
Looked stopped_short(const WorldView& view, const std::string& part) {
  Looked looked{Looked::Fate::no_follow, view.world_from(part)};
  looked.opening = view.scene().robot.opening_max;
  return looked;
}

// What keeps the arm from each grasp of a part; from those that it could take, that it cannot go with the part.
void look_at_move(const WorldView& view, const CollisionState& space, const std::string& part,
                  std::vector<Looked>& turned_down) {
  for (Looked& one : look_at_grasps(grasp_query(view, space, part, RandomKey("can_move")), true)) {
    if (one.fate == Looked::Fate::usable) one.fate = Looked::Fate::no_follow;
    turned_down.push_back(std::move(one));
  }
}

}  // namespace

JointVector planning_start(const World& world, int robot) {
  const JointVector reference = world.reference(robot).position, actual = world.arm_position(robot);
  return (reference - actual).cwiseAbs().maxCoeff() > kFollowsReference ? actual : reference;
}

PartWay way_of_part(const WorldView& view, const std::string& name, double position, double pivot) {
  const PartRef part = view.part_of(name);
  const Joint& joint = view.scene().body_at(part.body).parts[static_cast<std::size_t>(part.part)].joint;
  const double here = view.world().joint_position(part);
  const Transform part_from_world = view.world_from(name).inverse();
  PartWay way;
  way.part = part;
  way.pivot = pivot;
  way.opening = view.world().opening();
  way.moved = [&view, name, here, position, part_from_world](double share) {
    return Transform(view.part_at(name, here + share * (position - here)) * part_from_world);
  };
  way.axis = view.world_from(name).linear() * joint.axis.normalized();
  if (joint.kind != JointKind::slider) way.turn = position - here;
  const double last = std::clamp(position, joint.lower, joint.upper);
  if (last != position) way.stop = std::clamp((last - here) / (position - here), 0.0, 1.0);
  return way;
}

GraspQuery grasp_query(const WorldView& view, const CollisionState& space, const std::string& object, RandomKey key) {
  return {space, view.world(), view.object(object), planning_start(view.world()), key};
}

std::vector<GraspCandidate> grasps_to_go(const GraspQuery& query, int most, const std::optional<PartMove>& follow) {
  if (!follow) return grasp_candidates(query, most);
  for (const double share : {1.0, 0.75, 0.5, 0.25, 0.125}) {
    // Of a straight way no second grip does what the first cannot: something is before it, and has to be found.
    if (share < 1 && follow->way.turn == 0) break;
    std::vector<GraspCandidate> found = grasp_candidates(query, most, first_of(follow->way, share));
    for (GraspCandidate& grasp : found)
      grasp.reach = share == 1 ? follow->to : follow->from + share * (follow->to - follow->from);
    if (!found.empty()) return found;
  }
  return {};
}

std::optional<PartMove> part_move_to(const WorldView& view, const std::string& name, const std::string& to) {
  const auto& numbers = view.object(name).numbers;
  const auto found = numbers.find(to);
  if (found == numbers.end()) return std::nullopt;
  const auto pivot = numbers.find("pivot");
  PartWay way = way_of_part(view, name, found->second, pivot == numbers.end() ? 0 : pivot->second);
  way.retreat = 0.08;  // m: what is let go is then left
  return PartMove{std::move(way), view.joint(name), found->second};
}

bool can_grasp(const WorldView& view, const std::string& name, const std::string& before,
               std::vector<Looked>* turned_down) {
  const CollisionState space = space_behind(view, before);
  const World& world = view.world();
  const auto query = [&](const char* draw) {
    return GraspQuery{space, world, view.object(name), world.arm_position(), RandomKey(draw)};
  };
  for (const char* draw : {"can_grasp", "again", "once more"}) {
    if (grasp_candidates(query(draw), kEnoughGrasps).size() == kEnoughGrasps) continue;
    if (turned_down != nullptr) std::ranges::move(look_at_grasps(query(draw), true), std::back_inserter(*turned_down));
    return false;
  }
  return true;
}

bool can_move(const WorldView& view, const std::string& part, const std::string& to, const std::string& before,
              const std::string& enough, std::vector<Looked>* turned_down) {
  constexpr int kMostGrips = 8;  // half of what a skill may take (worlds/lib/grips.lua): a start has something in hand
  constexpr double kSlack = 0.03;  // of the way: what a handle gives in the hand
  CollisionState space = space_behind(view, before);
  // What else of the furniture is open may be shut first: that is for the plan to find.
  for (const Object& other : view.scene().objects)
    if (other.kind == ObjectKind::part && other.body == view.object(part).body && other.name != part &&
        other.name != before && other.numbers.contains("closed_at"))
      put(view, other.name, other.numbers.at("closed_at"), space);
  for (const PartRef one : with_mounted(view.scene(), view.part_of(part))) space.allow(one);
  const std::optional<PartMove> move = part_move_to(view, part, to);
  const auto needed = share_of(view, part, to, enough.empty() ? to : enough);
  if (!move || !needed) throw Error("can_move", "'" + part + "' has no number '" + (move ? enough : to) + "'");
  const double least = std::min(1.0, *needed + kSlack);
  double done = 0;  // share of the way, grip by grip
  for (int grip = 0; grip < kMostGrips && done < least; ++grip) {
    CollisionState there = space;
    there.move_part(move->way.part, move->way.moved(done));
    const std::size_t wanted = grip == 0 ? kEnoughGrasps : 1;
    const auto found = grasps_to_go(grasp_query(view, there, part, RandomKey("can_move")), wanted,
                                    PartMove{rest_of(move->way, done), done, 1});
    if (found.size() < wanted) {
      if (turned_down != nullptr && grip == 0) look_at_move(view, there, part, *turned_down);
      if (turned_down != nullptr && grip > 0) turned_down->push_back(stopped_short(view, part));
      return false;
    }
    done = *found.front().reach;
  }
  if (done < least && turned_down != nullptr) turned_down->push_back(stopped_short(view, part));
  return done >= least;
}

}  // namespace stampede
