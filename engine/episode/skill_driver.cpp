#include "engine/episode/skill_driver.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/episode/call_motion.h"
#include "engine/episode/effects.h"
#include "engine/episode/language.h"
#include "engine/episode/passages.h"

namespace stampede {
namespace {

constexpr double kEffectWait = 1.0;  // s, at most, for declared effects to become steady
constexpr int kGraspCandidates = 6;
constexpr int kCallsPerSkill = 200;  // a skill that asks for more is a runaway

bool ends(Reason reason) {
  return reason == Reason::timeout || reason == Reason::interrupted || reason == Reason::out_of_order ||
         reason == Reason::failed_by_task;
}

Outcome outcome_of(Reason reason) { return reason == Reason::none ? Outcome::success : Outcome::failure; }

std::string text_of(const Literal& literal) {
  return literal.negated ? "(not " + to_text(literal.fact) + ")" : to_text(literal.fact);
}

// The argument bound to a parameter's name; a name that is no parameter stands for itself.
std::string argument(const std::vector<Parameter>& parameters, const std::vector<std::string>& arguments,
                     const std::string& name) {
  for (std::size_t i = 0; i < parameters.size() && i < arguments.size(); ++i)
    if (parameters[i].name == name) return arguments[i];
  return name;
}

std::vector<double> seven(const Transform& transform) {
  const Pose pose = to_pose(transform);
  std::vector<double> values(pose.position.begin(), pose.position.end());
  values.insert(values.end(), pose.quaternion.begin(), pose.quaternion.end());
  return values;
}

// Uniform where both bounds are finite; else it stays at its default.
void draw_within(const ContinuousInfo& info, RandomKey key, ParameterRecord& record) {
  if (info.source != ContinuousInfo::Source::value) return;
  Random random(key);
  for (std::size_t i = 0; i < record.values.size(); ++i) {
    if (!std::isfinite(info.lower[i]) || !std::isfinite(info.upper[i])) continue;
    record.values[i] = random.between(info.lower[i], info.upper[i]);
    record.chosen_by = "agent";
  }
}

}  // namespace

SkillResult SkillDriver::run(const PlanStep& step, int parent_segment, int position, int attempt,
                             const CallMode& mode) {
  const Action* action = rollout_.domain().action(step.action);
  const SkillInfo* info = action == nullptr ? nullptr : skills_.skill(action->skill);
  if (info == nullptr) throw Error("plan", "there is no skill for the action '" + step.action + "'");
  Context context{*action, *info, step.arguments, key_.with(position).with(attempt), attempt, -1, mode};
  if (mode.random_parameters)  // which of the candidates
    context.attempt = static_cast<int>(Random(context.key.with("candidate")).below(kGraspCandidates));
  SkillResult result = run_call(context, nullptr, parent_segment);
  result.step = step;
  return result;
}

SkillResult SkillDriver::run_call(Context& context, const SkillCall* preset, int parent) {
  const Facts before = rollout_.facts().facts();
  open_segment(context, parent, before);
  SegmentRecord& segment = rollout_.recorder().segment(context.segment);
  const auto finish = [&](SkillResult result) {
    result.segment = context.segment;
    rollout_.recorder().close_segment(context.segment, rollout_.step(), outcome_of(result.reason), result.reason,
                                      result.detail);
    return result;
  };
  const auto unmet_literals = unmet(context.action.precondition, before, rollout_.domain(), rollout_.facts().objects(),
                                    binding_of(context.action, context.arguments));
  segment.precondition_held = unmet_literals.empty();
  if (!unmet_literals.empty() && context.mode.refuse)
    return finish({Reason::precondition_false, unmet_literals.front() + " does not hold"});

  SkillCall call{context.info.name,       context.action.case_name, context.arguments, {},
                 context.info.controller, context.info.stiffness};
  if (preset != nullptr) call.continuous = preset->continuous;
  if (const auto chosen = controller_from(options_.controller)) call.controller = *chosen;
  std::string detail;
  const SkillCall undrawn = call;
  const Reason drawn = draw(context, call, detail);
  SegmentRecord& named = rollout_.recorder().segment(context.segment);
  named.controller = std::string(to_string(call.controller));
  for (const ContinuousValue& value : call.continuous) named.parameters.push_back(value.record);
  if (drawn != Reason::none) {
    SkillResult failed{drawn, detail};
    name_blockers(context, failed, [&] {
      SkillCall again = undrawn;
      std::string ignored;
      return draw(context, again, ignored) == Reason::none;
    });
    return finish(std::move(failed));
  }

  std::vector<Literal> effects;
  for (const EffectRecord& effect : named.declared_effects) effects.push_back({effect.fact, effect.negated});
  rollout_.world().apply(operation::Controller{call.controller, call.stiffness});
  SkillResult result = execute(context, call);
  if (result.ok()) result = settle_effects(context, effects);
  return finish(result);
}

void SkillDriver::open_segment(Context& context, int parent, const Facts& before) {
  SegmentRecord segment;
  segment.kind = "skill";
  segment.parent = parent;
  segment.robot = rollout_.view().scene().robot.name;
  segment.skill = context.info.name;
  segment.case_name = context.action.case_name;
  segment.arguments = context.arguments;
  segment.label = fill(context.info.label, context.info.parameters, context.arguments, rollout_.view().scene());
  segment.forgotten = context.info.forgets;
  for (const Literal& literal :
       ground_effects(context.action, context.arguments, before, rollout_.domain(), rollout_.facts().objects()))
    segment.declared_effects.push_back({literal.fact, literal.negated});
  context.segment = rollout_.recorder().open_segment(std::move(segment), rollout_.step());
}

Reason SkillDriver::draw(const Context& context, SkillCall& call, std::string& detail) {
  for (const ContinuousInfo& info : context.info.continuous) {
    const auto given = std::find_if(call.continuous.begin(), call.continuous.end(),
                                    [&](const ContinuousValue& value) { return value.record.name == info.name; });
    if (given != call.continuous.end()) continue;
    ContinuousValue value;
    value.record = {info.name, info.initial, {}, info.unit, info.frame, "default"};
    if (context.mode.random_parameters) draw_within(info, context.key.with(info.name), value.record);
    Reason reason = Reason::none;
    if (info.source == ContinuousInfo::Source::grasps) reason = draw_grasp(context, info, value, detail);
    if (info.source == ContinuousInfo::Source::sample) reason = draw_sample(context, info, value, detail);
    if (reason != Reason::none) return reason;
    call.continuous.push_back(std::move(value));
  }
  return Reason::none;
}

Reason SkillDriver::draw_grasp(const Context& context, const ContinuousInfo& info, ContinuousValue& value,
                               std::string& detail) {
  const std::string name = argument(context.info.parameters, context.arguments, info.object);
  const auto space = planning_space(rollout_, touchable(context));
  const auto candidates =
      grasp_candidates(*space, rollout_.world(), rollout_.view().object(name), planning_start(rollout_.world()),
                       context.key.with(info.name), kGraspCandidates);
  if (candidates.empty()) {
    detail = "no grasp of " + name + " is reachable and free";
    return Reason::no_grasp;
  }
  const GraspCandidate& grasp = candidates[static_cast<std::size_t>(context.attempt) % candidates.size()];
  value.grasp = grasp;
  value.record.values = seven(grasp.object_from_tip);
  value.record.values.push_back(grasp.width);
  value.record.frame = name;
  value.record.chosen_by = "stream";
  return Reason::none;
}

Reason SkillDriver::draw_sample(const Context& context, const ContinuousInfo& info, ContinuousValue& value,
                                std::string& detail) {
  constexpr int kSamples = 64;
  Fact fact{info.literal.predicate, {}};
  for (const std::string& name : info.literal.arguments)
    fact.arguments.push_back(argument(context.info.parameters, context.arguments, name));
  const auto space = planning_space(rollout_, touchable(context));
  const World& world = rollout_.world();
  int wanted = context.attempt % 6;
  for (const Placement& placement :
       symbols_.sample(fact, rollout_.view(), *space, context.key.with(info.name), kSamples)) {
    const Transform* pose = std::get_if<Transform>(&placement.value);
    if (pose == nullptr) continue;
    if (space->held() && rollout_.view().part_of(placement.object).body == *space->held()) {
      const Transform object_from_tip = rollout_.view().world_from(placement.object).inverse() * world.world_from_tip();
      const auto ways =  // as many as a grasp is given: the nearest one may touch something
          world.arm().solutions(*pose * object_from_tip, planning_start(world), context.key.with("ik"), 3, 12);
      if (std::none_of(ways.begin(), ways.end(), [&](const JointVector& q) { return space->free(q); })) continue;
    }
    if (!value.pose || wanted-- > 0) value.pose = *pose;
    if (wanted < 0 || context.attempt == 0) break;
  }
  if (!value.pose) {
    detail = "no reachable and free pose makes " + to_text(fact) + " true";
    return Reason::no_placement;
  }
  value.record.values = seven(*value.pose);
  value.record.frame = "world";
  value.record.chosen_by = "stream";
  return Reason::none;
}

// What may be touched near the targets: by the empty hand only what it is to grasp, by a held object all arguments.
std::vector<PartRef> SkillDriver::touchable(const Context& context) const {
  std::vector<std::string> names;
  if (rollout_.keep) {
    names = context.arguments;
  } else {
    for (const ContinuousInfo& info : context.info.continuous)
      if (info.source == ContinuousInfo::Source::grasps)
        names.push_back(argument(context.info.parameters, context.arguments, info.object));
  }
  std::vector<PartRef> parts;
  for (const std::string& name : names) {
    const Object* thing = rollout_.view().scene().object(name);
    if (thing == nullptr || thing->body.empty()) continue;
    const bool region = thing->kind == ObjectKind::region;  // then: the part that it is fixed to
    parts.push_back(region ? PartRef{rollout_.view().scene().body_index(thing->body), thing->part}
                           : rollout_.view().part_of(name));
  }
  return parts;
}

SkillResult SkillDriver::execute(const Context& context, const SkillCall& call) {
  const auto run = skills_.start(call, rollout_.view());
  for (int number = 0; number < kCallsPerSkill; ++number) {
    const RobotCall next = run->next(rollout_.view());
    if (std::holds_alternative<robot_call::Done>(next)) return {};
    if (const auto* fail = std::get_if<robot_call::Fail>(&next)) return {fail->reason, fail->detail};
    const RandomKey key = context.key.with("call").with(number);
    const auto* child = std::get_if<robot_call::RunSkill>(&next);
    const SkillResult result = child ? run_child(context, child->call, key) : run_motion(context, next, key);
    if (!result.ok()) return result;
  }
  return {Reason::budget, "the skill asked for more than " + std::to_string(kCallsPerSkill) + " motions"};
}

SkillResult SkillDriver::run_child(const Context& context, const SkillCall& call, RandomKey key) {
  const SkillInfo* info = skills_.skill(call.skill);
  if (info == nullptr || info->actions.empty()) return {Reason::script_error, "there is no skill '" + call.skill + "'"};
  std::string name = info->actions.front();
  if (!call.case_name.empty()) name = call.skill + "_" + call.case_name;
  const Action* action = rollout_.domain().action(name);
  if (action == nullptr)
    return {Reason::script_error, "skill '" + call.skill + "' has no case '" + call.case_name + "'"};
  Context child{*action, *info, call.arguments, key, context.attempt, -1};
  child.mode.find_blockers = context.mode.find_blockers;
  return run_call(child, &call, context.segment);
}

SkillResult SkillDriver::run_motion(const Context& context, const RobotCall& call, RandomKey key) {
  PlannedCall planned = plan_call(rollout_, call, touchable(context), key);
  if (!planned.motion) {
    SkillResult failed{planned.reason, planned.detail};
    name_blockers(context, failed,
                  [&] { return plan_call(rollout_, call, touchable(context), key).motion != nullptr; });
    return failed;
  }
  SegmentRecord segment;
  segment.kind = "motion";
  segment.parent = context.segment;
  segment.robot = rollout_.view().scene().robot.name;
  segment.skill = planned.motion->kind();
  segment.controller = rollout_.recorder().segment(context.segment).controller;
  if (yields(call) && segment.controller == to_string(ControllerKind::joint_position))
    segment.controller = to_string(ControllerKind::cartesian_impedance);
  const int ordinal = rollout_.recorder().open_segment(std::move(segment), rollout_.step());
  const auto* hand = std::get_if<robot_call::Hand>(&call);
  if (hand != nullptr && hand->expect.empty()) rollout_.keep.reset();
  SkillResult result = follow(*planned.motion, ordinal);
  if (hand != nullptr) after_hand(*hand, ordinal, result.ok());
  rollout_.recorder().close_segment(ordinal, rollout_.step(), outcome_of(result.reason), result.reason, result.detail);
  return result;
}

SkillResult SkillDriver::follow(Motion& motion, int segment) {
  Passages passages(motion.vias(), segment);
  World& world = rollout_.world();
  SkillResult result;
  while (true) {
    const MotionResult status = motion.step(world);
    if (status.status == MotionStatus::failed) result = {status.reason, std::string(describe(status.reason))};
    if (status.status != MotionStatus::running) break;
    if (const Reason reason = rollout_.advance(); reason != Reason::none) {
      result = {reason, std::string(describe(reason)), ends(reason)};
      break;
    }
    passages.look(world);
  }
  for (ViaRecord& via : passages.in_order()) rollout_.recorder().vias.push_back(std::move(via));
  return result;
}

void SkillDriver::after_hand(const robot_call::Hand& hand, int segment, bool ok) {
  if (hand.expect.empty()) return;
  const WorldView& view = rollout_.view();
  GraspRecord grasp{segment, hand.expect,
                    to_pose(view.world_from(hand.expect).inverse() * view.world().world_from_tip()), view.opening(),
                    ok};
  rollout_.recorder().grasps.push_back(std::move(grasp));
  if (ok) rollout_.keep = view.part_of(hand.expect);
}

std::vector<std::string> SkillDriver::missing(const std::vector<Literal>& effects, bool& pending) const {
  std::vector<std::string> texts;
  pending = false;
  for (const Literal& literal : effects) {
    if (rollout_.facts().facts().contains(literal.fact) == literal.negated) texts.push_back(text_of(literal));
    pending = pending || rollout_.facts().pending(literal.fact);
  }
  return texts;
}

SkillResult SkillDriver::settle_effects(const Context& context, const std::vector<Literal>& effects) {
  SegmentRecord motion;
  motion.kind = "motion";
  motion.parent = context.segment;
  motion.robot = rollout_.view().scene().robot.name;
  motion.skill = "settle";
  motion.controller = rollout_.recorder().segment(context.segment).controller;
  const std::int64_t start = rollout_.step();
  const auto limit = start + static_cast<std::int64_t>(kEffectWait / rollout_.world().dt());
  SkillResult result;
  bool pending = false;
  std::vector<std::string> lacking = missing(effects, pending);
  const int ordinal = rollout_.recorder().open_segment(std::move(motion), start);
  while (result.ok() && (!rollout_.at_frame() || ((pending || !lacking.empty()) && rollout_.step() < limit))) {
    if (const Reason reason = rollout_.advance(); reason != Reason::none)
      result = {reason, std::string(describe(reason)), ends(reason)};
    if (rollout_.at_frame()) lacking = missing(effects, pending);
  }
  rollout_.recorder().close_segment(ordinal, rollout_.step(), outcome_of(result.reason), result.reason, result.detail);
  SegmentRecord& segment = rollout_.recorder().segment(context.segment);
  segment.effect_held = lacking.empty();
  segment.missing_effects = lacking;
  if (result.ok() && !lacking.empty()) result = {Reason::effect_mismatch, lacking.front() + " did not come true"};
  return result;
}

SkillResult SkillDriver::watch_goal(std::int64_t patience, std::int64_t hold) {
  std::int64_t held = 0;
  bool seen = rollout_.at_frame() && rollout_.goal_holds();
  for (std::int64_t frame = 0; seen ? held < hold : frame < patience; ++frame) {
    do {
      if (const Reason reason = rollout_.advance(); reason != Reason::none)
        return {reason, std::string(describe(reason)), ends(reason)};
    } while (!rollout_.at_frame());
    const bool now = rollout_.goal_holds();
    if (seen && !now) return {Reason::goal_unstable, std::string(describe(Reason::goal_unstable))};
    if (seen) ++held;
    seen = now;
  }
  if (!seen) return {Reason::goal_false, rollout_.unmet_goal()};
  return {};
}

SkillResult SkillDriver::wait_for_goal(std::int64_t patience, std::int64_t hold, int parent_segment) {
  SegmentRecord segment;
  segment.kind = "skill";
  segment.parent = parent_segment;
  segment.robot = rollout_.view().scene().robot.name;
  segment.skill = "wait";
  segment.label = "wait";
  const int ordinal = rollout_.recorder().open_segment(segment, rollout_.step());
  segment.kind = "motion";
  segment.parent = ordinal;
  const int motion = rollout_.recorder().open_segment(segment, rollout_.step());
  SkillResult result = watch_goal(patience, hold);
  for (const int closing : {motion, ordinal})
    rollout_.recorder().close_segment(closing, rollout_.step(), outcome_of(result.reason), result.reason,
                                      result.detail);
  result.segment = ordinal;
  return result;
}

}  // namespace stampede
