#include "engine/rollout/call_motion.h"

#include <algorithm>
#include <cmath>

#include "engine/motion/candidates.h"
#include "engine/motion/passable.h"
#include "engine/motion/stops.h"
#include "engine/rollout/call_follow.h"
#include "engine/sim/paces.h"

namespace stampede {
namespace {

int robot_of(const RobotCall& call) {
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { one.robot; }) return one.robot;
        return 0;
      },
      call);
}

// From where on a motion follows lines.
std::int64_t lines_from(const PlannedMotion& planned, const std::string& kind) {
  if (kind == "move_to" || kind == "move_joints") return planned.trajectory.steps();
  return kind == "move_through" && !planned.vias.empty() ? planned.vias.front().step : 0;
}

// Of a motion that presses, gives way or moves the fingers.
void set_contact(const Rollout& rollout, double most_force, double press, const Vector3& press_along,
                 FollowOptions& options) {
  options.most_force = most_force;
  options.press = press;
  if (!press_along.isZero()) options.press_along = press_along.normalized();
  options.hand_force = rollout.view().scene().robot.grip_force;
}

// Makes a motion of one call, whichever it is. `stop`: with stops at its vias.
class CallPlanner {
 public:
  CallPlanner(Rollout& rollout, int robot, const std::vector<PartRef>& touchable, RandomKey key, bool stop)
      : rollout_(rollout),
        world_(rollout.world()),
        robot_(robot),
        touchable_(touchable),
        key_(key),
        stop_(stop),
        start_(planning_start(world_, robot)),
        limits_(motion_limits(rollout)) {}

  // ask(problem, targets, then)
  template <typename Ask>
  auto through(const robot_call::MoveThrough& call, const Ask& ask) const;

  PlannedCall operator()(const robot_call::MoveThrough& call) const;
  PlannedCall operator()(const robot_call::MoveLine& call) const;
  PlannedCall operator()(const robot_call::Follow& call) const;
  PlannedCall operator()(const robot_call::MoveJoints& call) const;
  PlannedCall operator()(const robot_call::MovePart& call) const;
  PlannedCall operator()(const robot_call::Hand& call) const;
  PlannedCall operator()(const robot_call::Wait& call) const {
    return {make_wait(std::max<std::int64_t>(1, std::llround(call.seconds / world_.dt()))), Reason::none, {}};
  }
  template <typename Other>
  PlannedCall operator()(const Other&) const {
    return {nullptr, Reason::script_error, "not a motion"};
  }

 private:
  std::unique_ptr<CollisionState> space() const { return planning_space(rollout_, touchable_); }
  MotionProblem problem(const CollisionState& space) const { return {space, start_, limits_, key_}; }
  FollowOptions options(std::string kind) const {
    FollowOptions options;
    options.kind = std::move(kind);
    options.keep = rollout_.keep;
    options.robot = robot_;
    return options;
  }
  // Of a motion that meets something or takes something along: with stops, an agent is to be able to do it again.
  MotionLimits in_contact(LineOptions& line) const;
  PlannedCall made(PlannedMotion planned, FollowOptions options) const;

  Rollout& rollout_;
  const World& world_;
  int robot_;
  const std::vector<PartRef>& touchable_;
  RandomKey key_;
  bool stop_;
  JointVector start_;
  MotionLimits limits_;
};

MotionLimits CallPlanner::in_contact(LineOptions& line) const {
  MotionLimits limits = limits_;
  if (!stop_) return limits;
  limits.speed = world_.grasped() ? kHoldingPace : kMeetingPace;
  line.tool_speed = std::min(line.tool_speed, limits.speed * limits.tool_speed);
  return limits;
}

PlannedCall CallPlanner::made(PlannedMotion planned, FollowOptions options) const {
  if (planned.reason != Reason::none) return {nullptr, planned.reason, planned.detail};
  if (stop_)
    stop_at_vias(world_.arm(robot_), {}, world_.scene().physics_hz, lines_from(planned, options.kind), planned);
  options.vias = std::move(planned.vias);
  for (const PlannedHand& hand : planned.hands) options.hands.push_back(hand);
  return {make_follow(std::move(planned.trajectory), std::move(options)), Reason::none, {}};
}

template <typename Ask>
auto CallPlanner::through(const robot_call::MoveThrough& call, const Ask& ask) const {
  // A hand that is shut is not about to grasp anything.
  const bool shut = !rollout_.keep && world_.commanded_opening(robot_) < kShut_m;
  const auto space = planning_space(rollout_, shut ? std::vector<PartRef>{} : touchable_);
  const std::vector<ToolPiece> pieces =
      tool_pieces(call.then_follow, rollout_.view(), call.targets.back().world_from_tip);
  ThenDo then;
  if (!pieces.empty()) then.pieces = &pieces;
  PartWay part;
  if (!call.then_part.empty()) {
    part = way_of_part(rollout_.view(), call.then_part, call.position, call.pivot);
    part.opening = call.opening;
    part.retreat = call.retreat;
    then.part = &part;
  }
  return ask(problem(*space), call.targets, then);
}

PlannedCall CallPlanner::operator()(const robot_call::MoveThrough& call) const {
  return made(through(call, plan_through), options(call.targets.size() > 1 ? "move_through" : "move_to"));
}

PlannedCall CallPlanner::operator()(const robot_call::MoveLine& call) const {
  FollowOptions follow = options(call.kind);
  follow.stop_on_contact = call.stop_on_contact;
  follow.contact_force = call.force;
  const bool steered = call.press > 0 || call.search > 0;  // it says itself when it has failed
  follow.tolerate_error = call.tolerate || (!steered && (call.stop_on_contact || call.most_force > 0));
  set_contact(rollout_, call.most_force, call.press, call.press_along, follow);
  follow.search = call.search;
  follow.search_pitch = call.search_pitch;
  follow.search_force = call.force;
  if (call.opening) follow.hands.push_back({0, *call.opening});
  LineOptions line;
  line.tool_speed = call.speed;
  line.keep_clear = call.keep_clear;
  if (call.as_far_as_it_goes) line.least_share = 0.5;
  const auto space = this->space();
  MotionProblem asked = problem(*space);
  if (call.stop_on_contact || call.most_force > 0 || call.press > 0) asked.limits = in_contact(line);
  return made(plan_line(asked, call.target, line), std::move(follow));
}

PlannedCall CallPlanner::operator()(const robot_call::Follow& call) const {
  FollowOptions follow = options("follow");
  follow.tolerate_error = call.tolerate || (call.press == 0 && call.most_force > 0);
  set_contact(rollout_, call.most_force, call.press, call.press_along, follow);
  const auto pieces = tool_pieces(call.pieces, rollout_.view(), world_.arm(robot_).world_from_tip(start_));
  return made(plan_pieces(problem(*space()), pieces, {call.blend, call.keep_clear}), std::move(follow));
}

PlannedCall CallPlanner::operator()(const robot_call::MoveJoints& call) const {
  return made(plan_joints(problem(*space()), call.target), options("move_joints"));
}

PlannedCall CallPlanner::operator()(const robot_call::MovePart& call) const {
  FollowOptions follow = options("move_part");
  follow.most_force = call.most_force;
  follow.tolerate_error = true;  // the joint's own position is the measure, and effects test it
  PartWay way = way_of_part(rollout_.view(), call.object, call.position, call.pivot);
  way.retreat = call.retreat;
  const Transform held = world_.arm(robot_).world_from_tip(start_);
  LineOptions line;
  line.tool_speed = call.speed;
  const auto space = this->space();
  MotionProblem asked = problem(*space);
  asked.limits = in_contact(line);
  const auto moving = [&](double reach) {  // the part goes with the hand, the first `reach` of its way
    return [&way, reach](CollisionState& state, double share) {
      if (way.part.body >= 0) state.move_part(way.part, way.moved(reach * share));
    };
  };
  const auto along = [&](const ArmWay& found, double reach, double least_share) {
    LineOptions guided = line;
    guided.near = found.arm;
    guided.least_share = least_share;
    return plan_tool_path(asked, found.world_from_tip, guided, moving(reach));
  };
  if (call.then_to) {
    PartWay onward = way_of_part(rollout_.view(), call.object, *call.then_to, call.pivot);
    onward.retreat = call.retreat;
    const double here = rollout_.view().joint(call.object), whole = *call.then_to - here;
    const double share = whole == 0 ? 1 : std::clamp((call.position - here) / whole, 0.0, 1.0);
    if (const std::optional<ArmWay> found = way_with_part(*space, start_, onward, key_)) {
      PlannedMotion motion = along(first_of(*found, share), 1, 1);
      if (motion.reason == Reason::none) return made(std::move(motion), std::move(follow));
    }
  }
  if (const std::optional<ArmWay> found = way_with_part(*space, start_, way, key_)) {
    PlannedMotion motion = along(*found, 1, 1);
    if (motion.reason == Reason::none) return made(std::move(motion), std::move(follow));
  }
  const auto rigid = [&](double share) { return Transform(way.moved(share) * held); };
  PlannedMotion whole = plan_tool_path(asked, rigid, line, moving(1));
  const bool good =  // the arm goes on from there
      whole.reason == Reason::none && free_at_end(*space, start_, way, whole.trajectory.knots.back().position);
  if (!good && call.as_far_as_it_goes)
    if (const std::optional<ArmWay> found = furthest_with_part(*space, start_, way, key_))
      whole = along(*found, found->reach, 0);
  return made(std::move(whole), std::move(follow));
}

PlannedCall CallPlanner::operator()(const robot_call::Hand& call) const {
  if (!call.expect.empty())
    return {make_hand(call.opening, call.force, rollout_.view().part_of(call.expect), robot_), Reason::none, {}};
  double opening = call.opening;
  if (opening > world_.opening(robot_))
    opening = opening_beside(world_.arm_position(robot_), *space(), rollout_.keep, opening, true);
  return {make_hand(opening, call.force, std::nullopt, robot_), Reason::none, {}};
}

}  // namespace

// What is held may touch what it is joined to, and what is joined to it comes along.
static void allow_joined(const World& world, const std::optional<PartRef>& keep, CollisionState& space) {
  if (!keep || keep->body < 0) return;
  const std::vector<Body>& bodies = world.scene().bodies;
  const Body& held = bodies[static_cast<std::size_t>(keep->body)];
  for (int i = 0; i < static_cast<int>(bodies.size()); ++i) {
    const Body& body = bodies[static_cast<std::size_t>(i)];
    if (!body.joined_to.empty() && body.joined_to == held.name && world.joined({i, 0})) space.remove({i, 0});
    if (body.name != held.joined_to || !world.joined({keep->body, 0})) continue;
    for (int part = 0; part < static_cast<int>(body.parts.size()); ++part) space.allow({i, part});
  }
}

MotionLimits motion_limits(const Rollout& rollout) {
  MotionLimits limits;
  limits.planner = rollout.task().motion_planner;
  return limits;
}

std::unique_ptr<CollisionState> planning_space(Rollout& rollout, const std::vector<PartRef>& touchable) {
  World& world = rollout.world();
  auto space = std::make_unique<CollisionState>(world.collision_state());
  space->set_opening(rollout.view().opening());
  if (rollout.keep && rollout.keep->body >= 0 &&
      world.scene().bodies[static_cast<std::size_t>(rollout.keep->body)].free)
    space->hold(rollout.keep->body, rollout.view().world_from_tip().inverse() * world.world_from_part(*rollout.keep));
  for (const PartRef part : touchable) space->allow(part);
  allow_joined(world, rollout.keep, *space);
  for (const PartRef part : rollout.imagined_away) space->remove(part);
  return space;
}

double opening_beside(const JointVector& arm, CollisionState space, std::optional<PartRef> held, double wanted_m,
                      bool lets_go) {
  space.release();
  space.clear_allowed();  // where it is put may be touched by what is held, not by the fingers
  if (held) space.allow(*held);
  return widest_opening(space, arm, wanted_m, lets_go);
}

Yielding yielding(const RobotCall& call) {
  const auto of = [](double most_force, bool steered) {
    return steered ? Yielding::always : most_force > 0 ? Yielding::where_stiff : Yielding::no;
  };
  if (const auto* line = std::get_if<robot_call::MoveLine>(&call))
    return of(line->most_force, line->press > 0 || line->search > 0);
  if (const auto* follow = std::get_if<robot_call::Follow>(&call)) return of(follow->most_force, follow->press > 0);
  if (const auto* part = std::get_if<robot_call::MovePart>(&call)) return of(part->most_force, false);
  return Yielding::no;
}

bool moves_fingers(const RobotCall& call) {
  if (const auto* line = std::get_if<robot_call::MoveLine>(&call)) return line->opening.has_value();
  const auto* follow = std::get_if<robot_call::Follow>(&call);
  return follow != nullptr && std::any_of(follow->pieces.begin(), follow->pieces.end(),
                                          [](const robot_call::Piece& piece) { return piece.opening.has_value(); });
}

PlannedCall plan_call(Rollout& rollout, const RobotCall& call, const std::vector<PartRef>& touchable, RandomKey key,
                      bool stop_at_vias) {
  return std::visit(CallPlanner(rollout, robot_of(call), touchable, key, stop_at_vias), call);
}

bool may_be_possible(Rollout& rollout, const RobotCall& call, const std::vector<PartRef>& touchable, RandomKey key) {
  const auto* through = std::get_if<robot_call::MoveThrough>(&call);
  return through == nullptr || CallPlanner(rollout, through->robot, touchable, key, false).through(*through, passable);
}

std::optional<RobotAnswer> answer_to(Rollout& rollout, const RobotCall& call, const std::vector<PartRef>& touchable,
                                     RandomKey key) {
  if (const auto* asked = std::get_if<robot_call::ReachOfPart>(&call)) {
    PartWay way = way_of_part(rollout.view(), asked->object, asked->position, asked->pivot);
    way.retreat = asked->retreat;
    const double here = rollout.view().joint(asked->object);
    const auto found =
        furthest_with_part(*planning_space(rollout, touchable), planning_start(rollout.world()), way, key);
    if (!found) return RobotAnswer{here, {}};
    return RobotAnswer{found->reach == 1 ? asked->position : here + found->reach * (asked->position - here), {}};
  }
  if (const auto* asked = std::get_if<robot_call::FindGrasp>(&call)) {
    PartWay way = way_of_part(rollout.view(), asked->object, asked->position, asked->pivot);
    way.retreat = asked->retreat;
    const auto found =
        grasps_to_go(grasp_query(rollout.view(), *planning_space(rollout, touchable), asked->object, key), 1,
                     PartMove{way, rollout.view().joint(asked->object), asked->position});
    return RobotAnswer{{}, found.empty() ? std::nullopt : std::optional(found.front())};
  }
  return std::nullopt;
}

}  // namespace stampede
