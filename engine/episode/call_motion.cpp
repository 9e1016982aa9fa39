#include "engine/episode/call_motion.h"

#include <cmath>

namespace stampede {
namespace {

constexpr double kFollowsReference = 0.02;  // rad: further off, contact holds the arm

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

PlannedCall from(PlannedMotion planned, FollowOptions options) {
  if (planned.reason != Reason::none) return {nullptr, planned.reason, planned.detail};
  options.vias = std::move(planned.vias);
  return {make_follow(std::move(planned.trajectory), std::move(options)), Reason::none, {}};
}

PlannedCall plan_move_part(Rollout& rollout, const robot_call::MovePart& call, CollisionSpace& space,
                           const JointVector& start, FollowOptions options, RandomKey key) {
  const World& world = rollout.world();
  const PartRef ref = rollout.view().part_of(call.object);
  const double from_position = world.joint_position(ref);
  const Transform part_from_tip = world.world_from_part(ref).inverse() * world.arm().world_from_tip(start);
  const auto path = [&](double s) {
    return Transform(rollout.view().part_at(call.object, from_position + s * (call.position - from_position)) *
                     part_from_tip);
  };
  LineOptions line;
  line.tool_speed = call.speed;
  options.kind = "move_part";
  options.tolerate_error = true;  // the joint's own position is the measure, and effects test it
  return from(plan_tool_path(space, start, path, line, {}, key), std::move(options));
}

}  // namespace

JointVector planning_start(const World& world) {
  const JointVector reference = world.reference().position, actual = world.arm_position();
  return (reference - actual).cwiseAbs().maxCoeff() > kFollowsReference ? actual : reference;
}

std::unique_ptr<CollisionSpace> planning_space(Rollout& rollout, const std::vector<PartRef>& touchable) {
  World& world = rollout.world();
  auto space = world.collision_space();
  space->set_opening(world.opening());
  if (rollout.keep && rollout.keep->body >= 0 &&
      world.scene().bodies[static_cast<std::size_t>(rollout.keep->body)].free)
    space->hold(rollout.keep->body, world.world_from_tip().inverse() * world.world_from_part(*rollout.keep));
  for (const PartRef part : touchable) space->allow(part);
  for (const PartRef part : rollout.imagined_away) space->remove(part);
  return space;
}

PlannedCall plan_call(Rollout& rollout, const RobotCall& call, const std::vector<PartRef>& touchable, RandomKey key) {
  World& world = rollout.world();
  const JointVector start = planning_start(world);
  FollowOptions options;
  options.keep = rollout.keep;
  const auto space = [&] { return planning_space(rollout, touchable); };
  return std::visit(
      Overloaded{[&](const robot_call::MoveThrough& move) {
                   options.kind = move.targets.size() > 1 ? "move_through" : "move_to";
                   return from(plan_through(*space(), start, move.targets, {}, key), options);
                 },
                 [&](const robot_call::MoveLine& move) {
                   options.kind = move.kind;
                   options.stop_on_contact = move.stop_on_contact;
                   options.contact_force = move.force;
                   options.tolerate_error = move.tolerate || move.stop_on_contact;
                   LineOptions line;
                   line.tool_speed = move.speed;
                   line.collide = move.collide;
                   return from(plan_line(*space(), start, move.target, line, {}, key), options);
                 },
                 [&](const robot_call::MoveJoints& move) {
                   options.kind = "move_joints";
                   return from(plan_joints(*space(), start, move.target, {}, key), options);
                 },
                 [&](const robot_call::Hand& hand) {
                   const auto expect =
                       hand.expect.empty() ? std::nullopt : std::optional(rollout.view().part_of(hand.expect));
                   return PlannedCall{make_hand(hand.opening, hand.force, expect), Reason::none, {}};
                 },
                 [&](const robot_call::MovePart& move) {
                   return plan_move_part(rollout, move, *space(), start, options, key);
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

}  // namespace stampede
