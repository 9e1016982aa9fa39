#include "engine/rollout/call_motion.h"

#include <algorithm>
#include <cmath>

#include "engine/motion/stops.h"
#include "engine/motion/tool_line.h"
#include "engine/rollout/call_follow.h"
#include "engine/sim/paces.h"

namespace stampede {
namespace {

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // clang 16 does not know it by itself

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

// A motion as planned: where it is asked for, with stops.
class Planned {
 public:
  Planned(const Rollout& rollout, bool stop) : world_(rollout.world()), limits_(motion_limits(rollout)), stop_(stop) {}
  PlannedCall operator()(PlannedMotion planned, FollowOptions options) const {
    if (planned.reason != Reason::none) return {nullptr, planned.reason, planned.detail};
    if (stop_)
      stop_at_vias(world_.arm(options.robot), {}, world_.scene().physics_hz, lines_from(planned, options.kind),
                   planned);
    options.vias = std::move(planned.vias);
    for (const PlannedHand& hand : planned.hands) options.hands.push_back(hand);
    return {make_follow(std::move(planned.trajectory), std::move(options)), Reason::none, {}};
  }
  const MotionLimits& limits() const { return limits_; }
  // Of a motion that meets something or takes something along: with stops, an agent is to be able to do it again.
  MotionLimits in_contact(LineOptions& line) const {
    MotionLimits limits = limits_;
    if (!stop_) return limits;
    limits.speed = world_.grasped() ? kHoldingPace : kMeetingPace;
    line.tool_speed = std::min(line.tool_speed, limits.speed * limits.tool_speed);
    return limits;
  }

 private:
  const World& world_;
  MotionLimits limits_;
  bool stop_;
};

PlannedCall plan_move_part(Rollout& rollout, const robot_call::MovePart& call, const CollisionState& state,
                           const JointVector& start, FollowOptions options, RandomKey key, const Planned& from) {
  PartWay way = way_of_part(rollout.view(), call.object, call.position, call.pivot);
  way.retreat = call.retreat;
  const Transform held = rollout.world().arm(call.robot).world_from_tip(start);
  LineOptions line;
  line.tool_speed = call.speed;
  const MotionLimits limits = from.in_contact(line);
  const auto moving = [&](double reach) {  // the part goes with the hand, the first `reach` of its way
    return [&way, reach](CollisionState& space, double share) {
      if (way.part.body >= 0) space.move_part(way.part, way.moved(reach * share));
    };
  };
  const auto along = [&](const ArmWay& found, double reach, double least_share) {
    LineOptions guided = line;
    guided.near = found.arm;
    guided.least_share = least_share;
    return plan_tool_path_with(state, start, found.world_from_tip, guided, moving(reach), limits, key);
  };
  options.kind = "move_part";
  options.most_force = call.most_force;
  options.tolerate_error = true;  // the joint's own position is the measure, and effects test it
  if (call.then_to) {
    PartWay onward = way_of_part(rollout.view(), call.object, *call.then_to, call.pivot);
    onward.retreat = call.retreat;
    const double here = rollout.view().joint(call.object), whole = *call.then_to - here;
    const double share = whole == 0 ? 1 : std::clamp((call.position - here) / whole, 0.0, 1.0);
    if (const std::optional<ArmWay> found = way_with_part(state, start, onward, key)) {
      PlannedMotion motion = along(first_of(*found, share), 1, 1);
      if (motion.reason == Reason::none) return from(std::move(motion), std::move(options));
    }
  }
  if (const std::optional<ArmWay> found = way_with_part(state, start, way, key)) {
    PlannedMotion motion = along(*found, 1, 1);
    if (motion.reason == Reason::none) return from(std::move(motion), std::move(options));
  }
  const auto rigid = [&](double share) { return Transform(way.moved(share) * held); };
  PlannedMotion whole = plan_tool_path_with(state, start, rigid, line, moving(1), limits, key);
  const bool good =  // the arm goes on from there
      whole.reason == Reason::none && free_at_end(state, start, way, whole.trajectory.knots.back().position);
  if (!good && call.as_far_as_it_goes)
    if (const std::optional<ArmWay> found = furthest_with_part(state, start, way, key))
      whole = along(*found, found->reach, 0);
  return from(std::move(whole), std::move(options));
}

// Of a motion that presses, gives way or moves the fingers.
void set_contact(const Rollout& rollout, double most_force, double press, const Vector3& press_along,
                 FollowOptions& options) {
  options.most_force = most_force;
  options.press = press;
  if (!press_along.isZero()) options.press_along = press_along.normalized();
  options.hand_force = rollout.view().scene().robot.grip_force;
}

PlannedCall plan_move_line(Rollout& rollout, const robot_call::MoveLine& call, const CollisionState& state,
                           const JointVector& start, FollowOptions options, RandomKey key, const Planned& from) {
  options.kind = call.kind;
  options.stop_on_contact = call.stop_on_contact;
  options.contact_force = call.force;
  const bool steered = call.press > 0 || call.search > 0;  // it says itself when it has failed
  options.tolerate_error = call.tolerate || (!steered && (call.stop_on_contact || call.most_force > 0));
  set_contact(rollout, call.most_force, call.press, call.press_along, options);
  options.search = call.search;
  options.search_pitch = call.search_pitch;
  options.search_force = call.force;
  if (call.opening) options.hands.push_back({0, *call.opening});
  LineOptions line;
  line.tool_speed = call.speed;
  line.keep_clear = call.keep_clear;
  if (call.as_far_as_it_goes) line.least_share = 0.5;
  const bool touches = call.stop_on_contact || call.most_force > 0 || call.press > 0;
  const MotionLimits limits = touches ? from.in_contact(line) : from.limits();
  return from(plan_line(state, start, call.target, line, limits, key), std::move(options));
}

PlannedCall plan_follow(Rollout& rollout, const robot_call::Follow& call, const CollisionState& state,
                        const JointVector& start, FollowOptions options, RandomKey key, const Planned& from) {
  options.kind = "follow";
  options.tolerate_error = call.tolerate || (call.press == 0 && call.most_force > 0);
  set_contact(rollout, call.most_force, call.press, call.press_along, options);
  const auto pieces = tool_pieces(call, rollout.view(), rollout.world().arm(call.robot).world_from_tip(start));
  return from(plan_pieces(state, start, pieces, {call.blend, call.keep_clear}, from.limits(), key), std::move(options));
}

PlannedCall plan_hand(Rollout& rollout, const robot_call::Hand& call, const CollisionState& held) {
  if (!call.expect.empty())
    return {make_hand(call.opening, call.force, rollout.view().part_of(call.expect), call.robot), Reason::none, {}};
  double opening = call.opening;
  if (opening > rollout.world().opening(call.robot))
    opening = opening_beside(rollout.world(), held, rollout.keep, opening, true, call.robot);
  return {make_hand(opening, call.force, std::nullopt, call.robot), Reason::none, {}};
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
  space->set_opening(world.opening());
  if (rollout.keep && rollout.keep->body >= 0 &&
      world.scene().bodies[static_cast<std::size_t>(rollout.keep->body)].free)
    space->hold(rollout.keep->body, world.world_from_tip().inverse() * world.world_from_part(*rollout.keep));
  for (const PartRef part : touchable) space->allow(part);
  allow_joined(world, rollout.keep, *space);
  for (const PartRef part : rollout.imagined_away) space->remove(part);
  return space;
}

double opening_beside(const World& world, CollisionState space, std::optional<PartRef> held, double wanted_m,
                      bool lets_go, int robot) {
  space.release();
  space.clear_allowed();  // where it is put may be touched by what is held, not by the fingers
  if (held) space.allow(*held);
  return widest_opening(space, world.arm_position(robot), wanted_m, lets_go);
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
  World& world = rollout.world();
  const Planned from(rollout, stop_at_vias);
  const int robot = robot_of(call);
  const JointVector start = planning_start(world, robot);
  FollowOptions options;
  options.keep = rollout.keep;
  options.robot = robot;
  const auto space = [&] { return planning_space(rollout, touchable); };
  const auto free_space = [&] {  // a hand that is shut is not about to grasp anything
    const bool shut = !rollout.keep && world.commanded_opening(robot) < kShut_m;
    return planning_space(rollout, shut ? std::vector<PartRef>{} : touchable);
  };
  return std::visit(
      Overloaded{[&](const robot_call::MoveThrough& move) {
                   options.kind = move.targets.size() > 1 ? "move_through" : "move_to";
                   if (move.then_part.empty())
                     return from(plan_through(*free_space(), start, move.targets, from.limits(), key), options);
                   PartWay then = way_of_part(rollout.view(), move.then_part, move.position, move.pivot);
                   then.opening = move.opening;
                   then.retreat = move.retreat;
                   return from(plan_through(*free_space(), start, move.targets, from.limits(), key, &then), options);
                 },
                 [&](const robot_call::MoveLine& move) {
                   return plan_move_line(rollout, move, *space(), start, options, key, from);
                 },
                 [&](const robot_call::Follow& follow) {
                   return plan_follow(rollout, follow, *space(), start, options, key, from);
                 },
                 [&](const robot_call::MoveJoints& move) {
                   options.kind = "move_joints";
                   return from(plan_joints(*space(), start, move.target, from.limits(), key), options);
                 },
                 [&](const robot_call::Hand& hand) { return plan_hand(rollout, hand, *space()); },
                 [&](const robot_call::MovePart& move) {
                   return plan_move_part(rollout, move, *space(), start, options, key, from);
                 },
                 [&](const robot_call::Wait& wait) {
                   return PlannedCall{
                       make_wait(std::max<std::int64_t>(1, std::llround(wait.seconds / world.dt()))), Reason::none, {}};
                 },
                 [&](const auto&) {
                   return PlannedCall{nullptr, Reason::script_error, "not a motion"};
                 }},
      call);
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
    const auto found = grasps_to_go(rollout.view(), *planning_space(rollout, touchable), asked->object, way,
                                    rollout.view().joint(asked->object), asked->position, key, 1);
    return RobotAnswer{{}, found.empty() ? std::nullopt : std::optional(found.front())};
  }
  return std::nullopt;
}

}  // namespace stampede
