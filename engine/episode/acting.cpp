#include "engine/episode/acting.h"

#include <algorithm>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/base/stopping.h"
#include "engine/episode/account.h"
#include "engine/rollout/agent_action.h"
#include "engine/rollout/call_motion.h"
#include "engine/start/call_settings.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr std::int64_t kWhoDrives = -1;      // instead of a skill's segment
constexpr const char* kControl = "control";  // the motion of a stretch of low-level actions
constexpr int kMostFrames = std::numeric_limits<int>::max();

SkillEnd told(const SegmentRecord& segment, const PlanStep& step, const SkillResult& result) {
  return {step.action,         step.arguments,
          result.ok(),         std::string(to_string(result.reason)),
          result.detail,       segment.precondition_held,
          segment.effect_held, segment.missing_effects};
}

}  // namespace

Acting::Acting(EpisodeSource::Opened opened_in, const EnvironmentSettings& settings, EpisodeRecord described_record,
               const PreparedStart& start, std::unique_ptr<Renderer>& renderer)
    : opened(std::move(opened_in)),
      record(std::move(described_record)),
      rollout(*opened.symbols, start, sensors_of(*start.scene, record, opened.options.sensors), nullptr),
      track(rollout, *opened.symbols, *opened.skills, opened.options, draw_key("skill", record)),
      observer(rollout, opened.options, settings, renderer),
      spaces(action_spaces(*start.scene)) {}

std::optional<ActionRefusal> Acting::refusal_of(const AgentAction& action) const {
  if (ended || over != Reason::none || success) return ActionRefusal{"the episode has ended", "call reset()"};
  if (auto mistake = mistake_in(action, spaces)) return mistake;
  if (action.space == "go_on" && running.what == Running::What::nothing)
    return ActionRefusal{"there is nothing that could go on", "it follows a skill, path or hold that `frames` cut off"};
  return std::nullopt;
}

std::optional<ActionRefusal> Acting::do_asked(const AgentAction& action, StepResult& result) {
  rollout.note_asked(action, kWhoDrives);
  auto refusal = carry_out(action, result);
  if (refusal) rollout.recorder().refuse_asked(kWhoDrives);
  return refusal;
}

void Acting::note_result(const StepResult& result) {
  AskedAction* noted = rollout.recorder().last_asked(kWhoDrives);
  if (result.refusal || noted == nullptr) return;
  rollout.recorder().end_asked(kWhoDrives, rollout.step());
  noted->reward = result.reward;
  noted->terminated = result.terminated;
  noted->truncated = result.truncated;
}

std::optional<ActionRefusal> Acting::carry_out(const AgentAction& action, StepResult& result) {
  if (lasts_a_frame(action.space)) {
    auto asked = operations_for(action, rollout);
    if (const auto* refusal = std::get_if<ActionRefusal>(&asked)) return *refusal;
    end_running(result, "another action");
    one_frame(std::get<std::vector<Operation>>(asked));
    return std::nullopt;
  }
  std::optional<ActionRefusal> refusal;
  if (action.space == "skill") refusal = begin_skill(action, result);
  if (is_planned(action.space)) refusal = begin_path(action, result);
  if (action.space == "hold") begin_hold(result);
  if (!refusal) go_on(action.frames, result);
  return refusal;
}

// What the hand holds is found by looking, where it was not a skill that grasped or let go.
void Acting::look_at_hand() {
  if (!controlled) return;
  rollout.keep = rollout.world().grasped();
  controlled = false;
}

std::optional<ActionRefusal> Acting::begin_skill(const AgentAction& action, StepResult& result) {
  const Domain& domain = rollout.domain();
  if (domain.action(action.skill) == nullptr)
    return ActionRefusal{"there is no skill '" + action.skill + "'",
                         did_you_mean(action.skill, names_of(domain.actions))};
  SkillRequest request;
  request.step = {action.skill, action.arguments};
  request.set_by = ChosenBy::agent;
  request.set = settings_of(action);
  // Looked at before anything that runs is cut off: a refusal leaves all as it is.
  if (const auto mistake = track.execution().mistake_in(request)) return ActionRefusal{mistake->what(), {}};
  end_running(result, "another skill");
  to_frame();
  if (over != Reason::none || success) return std::nullopt;
  close_control();
  look_at_hand();
  track.here();
  if (const auto refusal = track.begin(std::move(request), skills)) return ActionRefusal{refusal->what(), {}};
  done.push_back({action.skill, action.arguments});
  ++skills;
  running.what = Running::What::skill;
  running.name = to_text(Fact{action.skill, action.arguments});
  return std::nullopt;
}

std::optional<ActionRefusal> Acting::begin_path(const AgentAction& action, StepResult& result) {
  World& world = rollout.world();
  const auto keep = rollout.keep;
  if (controlled) rollout.keep = world.grasped();
  const auto space = planning_space(rollout, {});
  const Transform target = tool_target(action, world);
  const MotionLimits limits = motion_limits(rollout);
  PlannedMotion planned = plan_through(
      {*space, planning_start(world), limits, draw_key("path", record).with(rollout.step())}, {{"goal", target}});
  if (planned.reason != Reason::none) {
    rollout.keep = keep;
    return ActionRefusal{std::string(describe(planned.reason)) + (planned.detail.empty() ? "" : ": " + planned.detail),
                         "another pose"};
  }
  end_running(result, "another action");
  if (over != Reason::none) return std::nullopt;
  if (!rollout.at_frame() || reference_moves(world)) {  // it was planned from rest: brake, then plan from there
    world.apply(rest(world));
    open_control();
    for (int i = 0; i < 20 && over == Reason::none && !success &&
                    (i == 0 || world.reference().velocity.cwiseAbs().maxCoeff() > 1e-9);
         ++i)
      to_frame(), one_frame({});
    planned = plan_through(
        {*planning_space(rollout, {}), planning_start(world), limits, draw_key("path", record).with(rollout.step())},
        {{"goal", target}});
  }
  close_control();
  look_at_hand();
  if (over != Reason::none || success) return std::nullopt;
  if (planned.reason != Reason::none) {
    result.ended.push_back(
        {action.space, {}, false, std::string(to_string(planned.reason)), planned.detail, {}, {}, {}});
    return std::nullopt;
  }
  if (action.gripper && *action.gripper != world.commanded_opening())
    world.apply(operation::Hand{*action.gripper, world.scene().robot.grip_force});
  if (const auto kind = controller_from(action.controller).value_or(ControllerKind::joint_position);
      kind != world.controller().kind)
    world.apply(operation::Controller{kind, 0});
  FollowOptions follow;
  follow.kind = "move_to";
  follow.keep = rollout.keep;
  running.segment =
      rollout.open_motion(follow.kind, track.subgoal_segment(), std::string(to_string(world.controller().kind)));
  running.what = Running::What::path;
  running.name = action.space;
  running.path = make_follow(std::move(planned.trajectory), std::move(follow));
  return std::nullopt;
}

void Acting::begin_hold(StepResult& result) {
  end_running(result, "another action");
  World& world = rollout.world();
  if (world.steered()) world.apply(rest(world));
  to_frame();
  if (over != Reason::none || success) return;
  close_control();
  track.here();
  running.what = Running::What::hold;
  running.name = "hold";
  running.watch = track.watch_goal(std::max<std::int64_t>(held, 0));
}

void Acting::advance() {
  heed_stop();
  over = rollout.advance();
}

// One frame of what was asked for; `control` in the record, from the first such frame to the next skill.
void Acting::one_frame(const std::vector<Operation>& operations) {
  open_control();
  for (const Operation& operation : operations) rollout.world().apply(operation);
  do advance();
  while (over == Reason::none && !rollout.at_frame());
  look_at_goal();
}

// After a skill, or an episode, that ended between two frames: a frame is what is observed.
void Acting::to_frame() {
  if (rollout.at_frame()) return;
  if (over == Reason::none) return one_frame({});
  while (!rollout.at_frame()) rollout.advance();
}

void Acting::open_control() {
  controlled = true;
  if (control_segment >= 0) return;
  control_segment =
      rollout.open_motion(kControl, track.subgoal_segment(), std::string(to_string(rollout.world().controller().kind)));
}

void Acting::close_control() {
  if (control_segment < 0) return;
  rollout.close_segment(control_segment);
  control_segment = -1;
  track.advance_subgoals();
  if (!rollout.keeps_record()) track.forget();
}

// At a frame at which no skill runs.
void Acting::look_at_goal() {
  if (over != Reason::none || !rollout.at_frame()) return;
  held = rollout.goal_holds() ? held + 1 : -1;
  if (running.what != Running::What::path) judge();  // a path is followed to its end, or as far as was asked
}

// The goal must hold for the task's `hold_s`.
void Acting::judge() {
  if (over == Reason::none && held >= track.hold_frames()) success = true;
}

// Ticks what is running: to its end, or for so many frames.
void Acting::go_on(int frames, StepResult& result) {
  const int most = frames > 0 ? frames : kMostFrames;
  for (int count = 0; running.what != Running::What::nothing && count < most;) {
    if (!tick(result)) break;
    advance();
    if (over != Reason::none) {
      tick(result);  // it learns that the episode has ended
      break;
    }
    if (!rollout.at_frame()) continue;
    ++count;
    if (running.what == Running::What::path) look_at_goal();
  }
  if (running.what == Running::What::hold) tick(result);  // its last frame may be the one that was missing
  to_frame();
  if (running.what != Running::What::skill) judge();
  if (success) end_running(result, "the goal has held long enough");
}

// False: it is over.
bool Acting::tick(StepResult& result) {
  if (running.what == Running::What::skill) {
    if (track.execution().tick() == SkillStatus::running) return true;
    skill_over(result);
    return false;
  }
  if (running.what == Running::What::hold) {
    if (running.watch->tick() == SkillStatus::running) return true;
    const SkillResult how = running.watch->result();
    held = running.watch->held();
    track.end_goal(how, skills);
    if (how.ok()) success = true;
    result.ended.push_back({"hold", {}, how.ok(), std::string(to_string(how.reason)), how.detail, {}, {}, {}});
    running = {};
    return false;
  }
  if (running.what != Running::What::path) return false;
  if (over != Reason::none) {
    path_over(result, {over, std::string(describe(over))});
    return false;
  }
  const MotionResult moved = running.path->step(rollout.world());
  if (moved.status == MotionStatus::running) return true;
  path_over(result, {moved.reason, moved.reason == Reason::none ? std::string() : std::string(describe(moved.reason))});
  return false;
}

void Acting::skill_over(StepResult& result) {
  const SkillResult how = track.execution().result();
  result.ended.push_back(told(rollout.recorder().segment(how.segment), done.back(), how));
  track.end(skills - 1);
  running = {};
  held = -1;
  if (!rollout.keeps_record()) track.forget();
  look_at_goal();
}

void Acting::path_over(StepResult& result, const SkillResult& how) {
  rollout.close_segment(running.segment, how.reason, how.detail);
  result.ended.push_back({running.name, {}, how.ok(), std::string(to_string(how.reason)), how.detail, {}, {}, {}});
  running = {};
  if (how.reason == Reason::dropped) rollout.keep.reset();
  if (!rollout.keeps_record()) track.forget();
}

void Acting::end_running(StepResult& result, const std::string& why) {
  if (running.what == Running::What::skill) {
    track.execution().interrupt(why);
    skill_over(result);
  } else if (running.what == Running::What::path) {
    running.path->interrupt(rollout.world());
    path_over(result, {Reason::interrupted, why});
  } else if (running.what == Running::What::hold) {
    running.watch->interrupt(why);
    held = running.watch->held();
    track.end_goal(running.watch->result(), skills);
    result.ended.push_back({"hold", {}, false, "interrupted", why, {}, {}, {}});
    running = {};
  }
}

void Acting::finish(const SkillResult& verdict) {
  StepResult ignored;
  end_running(ignored, "the episode was ended");
  to_frame();
  close_control();
  last = observer.observe();
  track.close(verdict);
  track.place_attempts();
  record.made.options["behaviour"] = "agent";
  close_record(rollout, verdict, to_pddl(done.copy()), record);
  ended = true;
}

}  // namespace stampede
