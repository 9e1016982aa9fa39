#include "engine/rollout/skill_execution.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/names.h"
#include "engine/base/stopping.h"
#include "engine/base/text.h"
#include "engine/rollout/agent_action.h"
#include "engine/rollout/blockers.h"
#include "engine/rollout/call_motion.h"
#include "engine/rollout/skill_draws.h"
#include "engine/start/call_settings.h"
#include "engine/start/effects.h"
#include "engine/start/language.h"
#include "engine/start/part_questions.h"

namespace stampede {
namespace {

constexpr double kEffectWait = 1.0;  // s, at most, for declared effects to become steady
constexpr int kCallsPerSkill = 200;  // a skill that asks for more is a runaway

std::string text_of(const EffectRecord& effect) {
  return effect.negated ? "(not " + to_text(effect.fact) + ")" : to_text(effect.fact);
}

}  // namespace

SkillExecution::~SkillExecution() {
  if (owns_ && phase_ != Phase::over) rollout_.calling = false;
}

SkillStatus SkillExecution::status() const {
  if (phase_ != Phase::over) return SkillStatus::running;
  return result_.ok() ? SkillStatus::done : SkillStatus::failed;
}

std::optional<Error> SkillExecution::mistake_in(const SkillRequest& request) const {
  const std::string& name = request.step.action;
  const Action* action = rollout_.domain().action(name);
  if (action == nullptr || skills_.skill(action->skill) == nullptr)
    return Error("plan", "there is no skill for the action '" + name + "'");
  const std::vector<std::string>& arguments = request.step.arguments;
  if (arguments.size() != action->parameters.size())
    return Error(name,
                 "takes " + std::to_string(action->parameters.size()) + " arguments, was given " +
                     std::to_string(arguments.size()),
                 "they are: " + joined(names_of(action->parameters)));
  const auto& objects = rollout_.facts().objects();
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const auto is_it = [&](const TypedObject& object) { return object.name == arguments[i]; };
    const auto found = std::find_if(objects.begin(), objects.end(), is_it);
    if (found == objects.end()) return Error(name, "there is no '" + arguments[i] + "' here");
    const Parameter& parameter = action->parameters[i];
    const auto wants = [&](const std::string& what) {
      return Error(name, "'" + arguments[i] + "' cannot be its " + parameter.name + ", which is a " + what);
    };
    if (!parameter.type.empty() && !rollout_.domain().is_a(found->type, parameter.type)) return wants(parameter.type);
    for (const std::string& trait : parameter.traits)
      if (!rollout_.facts().facts().contains({trait, {arguments[i]}})) return wants(trait);
  }
  try {
    check_settings(*skills_.skill(action->skill), request.set, name);
  } catch (const Error& error) {
    return error;
  }
  return std::nullopt;
}

std::optional<Error> SkillExecution::begin(const SkillRequest& request) {
  if (phase_ != Phase::over || rollout_.calling)
    return Error(request.step.action, "another skill is being executed", "end it, or interrupt it");
  if (const Reason reason = rollout_.ended(); reason != Reason::none)
    return Error(request.step.action, "the episode has ended: " + std::string(describe(reason)), "begin another one");
  if (auto mistake = mistake_in(request)) return mistake;
  const Action* action = rollout_.domain().action(request.step.action);
  SkillContext context{action,
                       skills_.skill(action->skill),
                       request.step.arguments,
                       request.key,
                       request.attempt,
                       -1,
                       {{request.set, request.set_by}},
                       request.mode};
  if (request.mode.random_parameters)  // which of the candidates
    context.attempt = static_cast<int>(Random(context.key.with("candidate")).below(kGraspCandidates));
  owns_ = rollout_.calling = true;
  start(std::move(context), request.parent_segment);
  result_.step = request.step;
  return std::nullopt;
}

void SkillExecution::start(SkillContext context, int parent) {
  context_ = std::move(context);
  if (const auto set = options_.set.find(context_.info->name); set != options_.set.end())
    context_.given.push_back({set->second, ChosenBy::caller});
  result_ = {};
  calls_ = questions_ = redraws_ = 0;
  arm_moved_ = false;
  step_asked_ = false;
  phase_ = Phase::calling;
  forget_lost();
  const Facts before = rollout_.facts().facts();
  open_segment(parent, before);
  const auto unmet_literals = unmet(context_.action->precondition, before, rollout_.domain(),
                                    rollout_.facts().objects(), binding_of(*context_.action, context_.arguments));
  rollout_.recorder().segment(context_.segment).precondition_held = unmet_literals.empty();
  if (!unmet_literals.empty() && context_.mode.refuse) {
    finish({Reason::precondition_false, unmet_literals.front() + " does not hold"});
    return;
  }
  if (nothing_to_do()) {
    rollout_.recorder().segment(context_.segment).effect_held = true;
    finish({});
    return;
  }
  SkillCall call = undrawn_call();
  Impasse impasse;
  DrawnParameters drawn =
      draw_continuous(rollout_, symbols_, skills_, context_, options_.services.witness ? &impasse : nullptr);
  call.continuous = std::move(drawn.values);
  note_parameters(call);
  if (drawn.reason != Reason::none) {
    SkillResult failed{drawn.reason, drawn.detail};
    name_blockers(rollout_, context_, failed,
                  [&] { return draw_continuous(rollout_, symbols_, skills_, context_).reason == Reason::none; });
    impasse.state = state_of(rollout_.view());
    if (options_.services.witness) tell(std::move(impasse), failed);
    finish(std::move(failed));
    return;
  }
  looked_at_.reset();
  if (!impasse.looked.empty()) {
    impasse.state = state_of(rollout_.view());
    looked_at_ = std::move(impasse);
  }
  controller_ = {call.controller, call.stiffness};
  rollout_.world().apply(controller_);
  start_run(std::move(call));
  if (reference_moves(rollout_.world())) follow(make_brake());
}

// What the hand was asked to hold and no finger touches any more is not lost by this call: it was lost before.
void SkillExecution::forget_lost() {
  const World& world = rollout_.world();
  if (!rollout_.keep) return;
  const auto& pads = world.scene().robot.pads;
  const auto touches = [&](const Contact& contact) {
    return contact.a.on_robot() && contact.b == *rollout_.keep &&
           std::find(pads.begin(), pads.end(), contact.a.part) != pads.end();
  };
  if (std::ranges::none_of(world.contacts(), touches)) rollout_.keep.reset();
}

// All that it declares is so already, and of what it counts all, not just enough: it ends at once, and nothing moves.
bool SkillExecution::nothing_to_do() {
  return !rollout_.recorder().segment(context_.segment).declared_effects.empty() &&
         missing_effects().literals.empty() && not_needed().empty();
}

void SkillExecution::note_parameters(const SkillCall& call) {
  SegmentRecord& segment = rollout_.recorder().segment(context_.segment);
  segment.controller = std::string(to_string(call.controller));
  segment.parameters.clear();
  for (const ContinuousValue& value : call.continuous) segment.parameters.push_back(value.record);
  for (const GivenSettings& given : context_.given)
    if (given.set.controller == call.controller)
      segment.parameters.push_back({"controller", {}, segment.controller, {}, {}, given.by});
}

void SkillExecution::start_run(SkillCall call) {
  call_ = std::move(call);
  run_ = skills_.start(call_, rollout_.view());
}

// Where the arm cannot get to the grasp or the place that was drawn, the run begins anew with the next one, as long as
// no more than fingers have moved. False: all have had their turn, or it is too late.
bool SkillExecution::draw_again() {
  const auto streamed = [](const ContinuousValue& value) { return value.record.chosen_by == ChosenBy::stream; };
  if (arm_moved_ || redraws_ + 1 >= kPlaceCandidates || std::ranges::none_of(call_.continuous, streamed)) return false;
  if (redraws_++ == 0) first_drawn_ = call_.continuous;
  ++context_.attempt;
  DrawnParameters drawn = draw_continuous(rollout_, symbols_, skills_, context_);
  if (drawn.reason != Reason::none) return false;
  SkillCall call = undrawn_call();
  call.continuous = std::move(drawn.values);
  const auto same = [](const ContinuousValue& a, const ContinuousValue& b) {
    return a.record.values == b.record.values;
  };
  for (const auto* before : {&first_drawn_, &call_.continuous})
    if (std::ranges::equal(call.continuous, *before, same)) return false;
  note_parameters(call);
  start_run(std::move(call));
  return true;
}

void SkillExecution::tell(Impasse impasse, const SkillResult& failed) const {
  const Task& task = rollout_.task();
  impasse.task = task.name;
  impasse.variation = task.variation;
  impasse.seed = options_.seed;
  impasse.step = context_.info->name;
  for (const std::string& argument : context_.arguments) impasse.step += " " + argument;
  impasse.reason = failed.reason;
  impasse.detail = failed.detail;
  impasse.scene = rollout_.scene();
  options_.services.witness(impasse);
}

// The run's own words go first: of this skill, then of all; then those of the call; then the skill's.
SkillCall SkillExecution::undrawn_call() const {
  const SkillInfo& info = *context_.info;
  SkillCall call{info.name, context_.action->case_name, context_.arguments, {}, info.controller, info.stiffness};
  for (const GivenSettings& given : context_.given) call.controller = given.set.controller.value_or(call.controller);
  const auto set = options_.set.find(info.name);
  if (set == options_.set.end() || !set->second.controller)
    call.controller = controller_from(options_.controller).value_or(call.controller);
  return call;
}

void SkillExecution::open_segment(int parent, const Facts& before) {
  SegmentRecord segment;
  segment.kind = SegmentKind::skill;
  segment.parent = parent;
  segment.robot = rollout_.view().scene().robot.name;
  segment.skill = context_.info->name;
  segment.case_name = context_.action->case_name;
  segment.arguments = context_.arguments;
  segment.label = fill(context_.info->label, context_.info->parameters, context_.arguments, rollout_.view().scene());
  segment.forgotten = context_.info->forgets;
  segment.preconditions =
      ground_precondition(*context_.action, context_.arguments, before, rollout_.domain(), rollout_.facts().objects());
  for (const Literal& literal :
       ground_effects(*context_.action, context_.arguments, before, rollout_.domain(), rollout_.facts().objects()))
    segment.declared_effects.push_back({literal.fact, literal.negated});
  counted_ =
      counted_effects(*context_.action, context_.arguments, before, rollout_.domain(), rollout_.facts().objects());
  context_.segment = rollout_.recorder().open_segment(std::move(segment), rollout_.step());
}

SkillStatus SkillExecution::tick() {
  if (phase_ == Phase::over) return status();
  if (step_asked_) after_step();
  while (phase_ != Phase::over && !step_due()) {
  }
  step_asked_ = phase_ != Phase::over;
  return status();
}

// Why the step just made has ended the episode, if it has.
std::optional<SkillResult> SkillExecution::ended() const {
  const Reason reason = rollout_.ended();
  if (reason == Reason::none) return std::nullopt;
  return SkillResult{reason, std::string(describe(reason)), true};
}

void SkillExecution::after_step() {
  if (phase_ == Phase::moving) {
    if (auto end = ended())
      end_motion(std::move(*end));
    else
      motion_->look_at_passages();
  } else if (phase_ == Phase::settling) {
    if (rollout_.at_frame()) missing_ = missing_effects();
    if (auto end = ended()) end_settling(std::move(*end));
  }
}

// True: a physics step is due before anything else. False: the phase has changed.
bool SkillExecution::step_due() {
  switch (phase_) {
    case Phase::calling:
      return ask_script();
    case Phase::moving:
      return step_motion();
    case Phase::child:
      if (child_->tick() == SkillStatus::running) return true;
      if (!child_->result().ok()) return finish(child_->result());
      restore_controller();
      phase_ = Phase::calling;
      return false;
    case Phase::settling:
      return !settled();
    case Phase::over:
      break;
  }
  return false;
}

void SkillExecution::restore_controller() {
  const operation::Controller& now = rollout_.world().controller();
  if (now.kind != controller_.kind || now.stiffness != controller_.stiffness) rollout_.world().apply(controller_);
}

bool SkillExecution::ask_script() {
  if (calls_ == kCallsPerSkill)
    return finish({Reason::budget, "the skill asked for more than " + std::to_string(kCallsPerSkill) + " motions"});
  if (policy_) return go_on_with_policy(context_.key.with("call").with(calls_++));
  const RobotCall next = run_->next(rollout_.view());
  if (const auto answer =
          answer_to(rollout_, next, touchable(rollout_, context_), context_.key.with("question").with(questions_))) {
    if (++questions_ > kCallsPerSkill)
      return finish({Reason::budget, "the skill asked more than " + std::to_string(kCallsPerSkill) + " questions"});
    run_->answer(*answer);
    return false;
  }
  const RandomKey key = context_.key.with("call").with(calls_++);
  if (std::holds_alternative<robot_call::Done>(next)) return begin_settling();
  if (const auto* fail = std::get_if<robot_call::Fail>(&next)) return finish({fail->reason, fail->detail});
  if (const auto* child = std::get_if<robot_call::RunSkill>(&next)) return start_child(child->call, key);
  if (const auto* policy = std::get_if<robot_call::Policy>(&next)) return start_policy(*policy);
  return plan_motion(next, key);
}

bool SkillExecution::start_policy(const robot_call::Policy& call) {
  arm_moved_ = true;
  PolicyCall told{.skill = context_.info->name, .parameters = call.with};
  for (std::size_t i = 0; i < context_.arguments.size(); ++i)
    told.arguments[context_.info->parameters[i].name] = context_.arguments[i];
  for (const ContinuousValue& value : call_.continuous)
    told.parameters.try_emplace(value.record.name, value.record.values);
  policy_ = std::make_unique<SkillPolicy>(
      rollout_, options_, call, context_.segment,
      [this, until = call.until_effect] { return until && missing_effects().literals.empty(); });
  try {
    policy_->begin(told);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    return finish({Reason::policy_error, error.what()});
  }
  follow(policy_->motion());
  return false;
}

// What it asked for beside set-points is done to its end, then it goes on.
bool SkillExecution::go_on_with_policy(RandomKey key) {
  World& world = rollout_.world();
  if (reference_moves(world)) {
    follow(make_brake());
    return false;
  }
  rollout_.keep = world.grasped();  // the policy moved the fingers as it liked
  if (policy_->over()) {
    policy_.reset();
    restore_controller();
    return false;
  }
  const std::optional<AgentAction> asked = policy_->take_pending();
  if (!asked) {
    follow(policy_->motion());
    return false;
  }
  if (asked->space == "skill")
    start_asked_skill(*asked, key);
  else
    plan_motion(robot_call::MoveThrough{{{"goal", tool_target(*asked, world)}}}, key);
  if (phase_ == Phase::over) rollout_.recorder().refuse_asked(context_.segment);
  return false;
}

bool SkillExecution::start_asked_skill(const AgentAction& asked, RandomKey key) {
  const Action* action = rollout_.domain().action(asked.skill);
  if (action == nullptr) return finish({Reason::policy_error, "there is no skill '" + asked.skill + "'"});
  SkillRequest request;
  request.step = {asked.skill, asked.arguments};
  request.set = settings_of(asked);
  if (const auto mistake = mistake_in(request)) return finish({Reason::policy_error, mistake->what()});
  return start_child({action->skill, action->case_name, asked.arguments, request.set}, key);
}

bool SkillExecution::start_child(const AskedCall& call, RandomKey key) {
  arm_moved_ = true;
  const SkillInfo* info = skills_.skill(call.skill);
  if (info == nullptr || info->actions.empty())
    return finish({Reason::script_error, "there is no skill '" + call.skill + "'"});
  std::string name = info->actions.front();
  if (!call.case_name.empty()) name = call.skill + "_" + call.case_name;
  const Action* action = rollout_.domain().action(name);
  if (action == nullptr)
    return finish({Reason::script_error, "skill '" + call.skill + "' has no case '" + call.case_name + "'"});
  SkillContext context{action, info, call.arguments, key, context_.attempt, -1, {{call.set, ChosenBy::caller}}};
  context.mode.find_blockers = context_.mode.find_blockers;
  context.mode.explain = context_.mode.explain;
  child_ = std::make_unique<SkillExecution>(rollout_, symbols_, skills_, options_);
  child_->start(std::move(context), context_.segment);
  phase_ = Phase::child;
  return false;
}

bool SkillExecution::plan_motion(const RobotCall& call, RandomKey key) {
  const auto plan = [&] {
    return plan_call(rollout_, call, touchable(rollout_, context_), key, stops_at_vias(options_.set));
  };
  PlannedCall planned = plan();
  if (!planned.motion) {
    const bool of_draw = planned.reason == Reason::no_path || planned.reason == Reason::unreachable;
    if (of_draw && draw_again()) return false;
    SkillResult failed{planned.reason, planned.detail};
    name_blockers(rollout_, context_, failed, [&] { return plan().motion != nullptr; });
    return finish(std::move(failed));
  }
  if (!std::holds_alternative<robot_call::Hand>(call) && !std::holds_alternative<robot_call::Wait>(call))
    arm_moved_ = true;
  follow(std::move(planned.motion), &call);
  return false;
}

void SkillExecution::follow(std::unique_ptr<Motion> motion, const RobotCall* call) {
  motion_.emplace(rollout_, context_.segment, std::move(motion), call);
  phase_ = Phase::moving;
}

bool SkillExecution::step_motion() {
  const MotionResult moved = motion_->step();
  if (moved.status == MotionStatus::running) return true;
  SkillResult result;
  if (moved.status == MotionStatus::failed)
    result = {moved.reason, moved.detail.empty() ? std::string(describe(moved.reason)) : moved.detail};
  end_motion(std::move(result));
  return false;
}

void SkillExecution::end_motion(SkillResult result) {
  motion_->end(result);
  motion_.reset();
  if (result.ok())
    phase_ = Phase::calling;
  else
    finish(std::move(result));
}

// Literals that do not hold, of effects of which enough others do.
std::vector<EffectRecord> SkillExecution::not_needed() const {
  std::vector<EffectRecord> all;
  for (const CountedEffects& counted : counted_) {
    std::vector<EffectRecord> missing;
    for (const Literal& one : counted.literals)
      if (rollout_.facts().facts().contains(one.fact) == one.negated) missing.push_back({one.fact, one.negated});
    if (counted.literals.size() - missing.size() >= counted.enough)
      all.insert(all.end(), missing.begin(), missing.end());
  }
  return all;
}

SkillExecution::MissingEffects SkillExecution::missing_effects() const {
  MissingEffects missing;
  const std::vector<EffectRecord> spare = not_needed();
  for (const EffectRecord& effect : rollout_.recorder().segment(context_.segment).declared_effects) {
    if (rollout_.facts().facts().contains(effect.fact) == effect.negated &&
        std::ranges::find(spare, effect) == spare.end())
      missing.literals.push_back(text_of(effect));
    missing.pending = missing.pending || rollout_.facts().pending(effect.fact);
  }
  return missing;
}

bool SkillExecution::begin_settling() {
  settle_until_ = rollout_.step() + static_cast<std::int64_t>(kEffectWait / rollout_.world().dt());
  missing_ = missing_effects();
  settle_segment_ =
      rollout_.open_motion("settle", context_.segment, rollout_.recorder().segment(context_.segment).controller);
  phase_ = Phase::settling;
  return false;
}

// At a frame at which all that was declared is steady, or at the end of patience.
bool SkillExecution::settled() {
  const bool waiting = (missing_.pending || !missing_.literals.empty()) && rollout_.step() < settle_until_;
  if (!rollout_.at_frame() || waiting) return false;
  end_settling({});
  return true;
}

void SkillExecution::end_settling(SkillResult result) {
  rollout_.close_segment(settle_segment_, result.reason, result.detail);
  SegmentRecord& segment = rollout_.recorder().segment(context_.segment);
  segment.effect_held = missing_.literals.empty();
  segment.missing_effects = missing_.literals;
  const std::vector<EffectRecord> spare = not_needed();  // which of the counted ones came true is known now
  std::erase_if(segment.declared_effects,
                [&](const auto& one) { return std::ranges::find(spare, one) != spare.end(); });
  if (result.ok() && !missing_.literals.empty())
    result = {Reason::effect_mismatch, missing_.literals.front() + " did not come true"};
  finish(std::move(result));
}

void SkillExecution::interrupt(const std::string& why) {
  if (phase_ == Phase::over) return;
  const SkillResult result{Reason::interrupted, why};
  if (phase_ == Phase::child) child_->interrupt(why);
  if (phase_ == Phase::settling) rollout_.close_segment(settle_segment_, result.reason, result.detail);
  if (phase_ == Phase::moving) {
    motion_->interrupt(result);
    motion_.reset();
  }
  finish(result);
}

// Always false, as step_due says that no step is due.
bool SkillExecution::finish(SkillResult result) {
  if (policy_) policy_->end_asked();
  result.segment = context_.segment;
  result.step = result_.step;
  rollout_.close_segment(context_.segment, result.reason, result.detail);
  if (looked_at_ && !result.ok()) tell(*std::exchange(looked_at_, std::nullopt), result);
  result_ = std::move(result);
  run_.reset();
  child_.reset();
  policy_.reset();
  phase_ = Phase::over;
  if (owns_) rollout_.calling = false;
  return false;
}

}  // namespace stampede
