// What a skill asks of the robot, planned into a motion.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/motion/part_way.h"
#include "engine/motion/planner.h"
#include "engine/rollout/rollout.h"
#include "engine/start/part_questions.h"
#include "engine/start/robot_call.h"

namespace stampede {

struct PlannedCall {
  std::unique_ptr<Motion> motion;  // empty: reason says why
  Reason reason = Reason::none;
  std::string detail;
};

// Plans one robot call from where the reference is. `touchable`: parts that hand and held object may touch near the
// targets. Repeatable: a pure function of its arguments. RunSkill, Done, Fail and questions are not
// motions.
// `stop_at_vias`: see call_settings.h.
PlannedCall plan_call(Rollout& rollout, const RobotCall& call, const std::vector<PartRef>& touchable, RandomKey key,
                      bool stop_at_vias = false);

// Could a call be planned, wherever the arm comes from? Of MoveThrough alone; all others may. Repeatable.
bool may_be_possible(Rollout& rollout, const RobotCall& call, const std::vector<PartRef>& touchable, RandomKey key);

// Is it made on Cartesian impedance, whatever the skill's controller, or where that is stiff?
enum class Yielding { no, where_stiff, always };
Yielding yielding(const RobotCall& call);

// Does it open or close the hand beside what the arm does?
bool moves_fingers(const RobotCall& call);

// The world as the planner sees it: the held object moves with the tip, the fingers are as open as they are.
std::unique_ptr<CollisionState> planning_space(Rollout& rollout, const std::vector<PartRef>& touchable);

// As the task and its world ask for motions: with their planner of joint paths.
MotionLimits motion_limits(const Rollout& rollout);

// How far a hand opens around what it holds, up to `wanted_m`: a finger must not press against a neighbour or a rim.
// `lets_go`: a little further in any case. `arm`: where the arm is.
double opening_beside(const JointVector& arm, CollisionState space, std::optional<PartRef> held, double wanted_m,
                      bool lets_go);

// Of ReachOfPart and FindGrasp; nothing: the call is no question. `touchable` as of plan_call. Repeatable: a pure
// function of its arguments.
std::optional<RobotAnswer> answer_to(Rollout& rollout, const RobotCall& call, const std::vector<PartRef>& touchable,
                                     RandomKey key);

}  // namespace stampede
