// What a skill asks of the robot, planned into a motion.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/episode/interfaces.h"
#include "engine/episode/rollout.h"
#include "engine/motion/part_way.h"

namespace stampede {

struct PlannedCall {
  std::unique_ptr<Motion> motion;  // empty: reason says why
  Reason reason = Reason::none;
  std::string detail;
};

// Plans one robot call from where the reference is. `touchable`: parts that hand and held object may touch near the
// targets. Repeatable: a pure function of its arguments. RunSkill, Done and Fail are not motions.
PlannedCall plan_call(Rollout& rollout, const RobotCall& call, const std::vector<PartRef>& touchable, RandomKey key);

// Is it made by an arm that gives way to contact (on Cartesian impedance, where the skill's controller is stiff)?
bool yields(const RobotCall& call);

// The world as the planner sees it: the held object moves with the tip, the fingers are as open as they are.
std::unique_ptr<CollisionState> planning_space(Rollout& rollout, const std::vector<PartRef>& touchable);

// How a part goes from where its joint is to `position`, its handle free to turn in the hand by `pivot` rad.
PartWay way_of_part(const Rollout& rollout, const std::string& name, double position, double pivot);

// Where plans start: the reference, or the arm itself where contact keeps it away from its reference.
JointVector planning_start(const World& world, int robot = 0);

}  // namespace stampede
