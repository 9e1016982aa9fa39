#include "engine/episode/part_questions.h"

#include "engine/episode/call_motion.h"

namespace stampede {

std::vector<GraspCandidate> grasps_to_go(const Rollout& rollout, const CollisionState& space, const std::string& object,
                                         const std::optional<PartWay>& follow, double from, double to, RandomKey key,
                                         int most) {
  const auto grasps = [&](const std::optional<PartWay>& way) {
    return grasp_candidates(space, rollout.world(), rollout.view().object(object), planning_start(rollout.world()), key,
                            most, way);
  };
  if (!follow) return grasps({});
  for (const double share : {1.0, 0.75, 0.5, 0.25, 0.125}) {
    // Of a straight way no second grip does what the first cannot: something is before it, and has to be found.
    if (share < 1 && follow->turn == 0) break;
    std::vector<GraspCandidate> found = grasps(first_of(*follow, share));
    for (GraspCandidate& grasp : found) grasp.reach = share == 1 ? to : from + share * (to - from);
    if (!found.empty()) return found;
  }
  return {};
}

std::optional<RobotAnswer> answer_to(Rollout& rollout, const RobotCall& call, const std::vector<PartRef>& touchable,
                                     RandomKey key) {
  if (const auto* asked = std::get_if<robot_call::ReachOfPart>(&call)) {
    PartWay way = way_of_part(rollout, asked->object, asked->position, asked->pivot);
    way.retreat = asked->retreat;
    const double here = rollout.view().joint(asked->object);
    const auto found =
        furthest_with_part(*planning_space(rollout, touchable), planning_start(rollout.world()), way, key);
    if (!found) return RobotAnswer{here, {}};
    return RobotAnswer{found->reach == 1 ? asked->position : here + found->reach * (asked->position - here), {}};
  }
  if (const auto* asked = std::get_if<robot_call::FindGrasp>(&call)) {
    PartWay way = way_of_part(rollout, asked->object, asked->position, asked->pivot);
    way.retreat = asked->retreat;
    const auto found = grasps_to_go(rollout, *planning_space(rollout, touchable), asked->object, way,
                                    rollout.view().joint(asked->object), asked->position, key, 1);
    return RobotAnswer{{}, found.empty() ? std::nullopt : std::optional(found.front())};
  }
  return std::nullopt;
}

}  // namespace stampede
