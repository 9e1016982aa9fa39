#include "engine/rollout/skill_track.h"

#include <cmath>

namespace stampede {
namespace {

constexpr double kGoalPatience = 1.0;  // s for the goal's facts to become steady after the last skill

}  // namespace

SkillTrack::SkillTrack(Rollout& rollout, Symbols& symbols, SkillLibrary& skills, const RunOptions& options,
                       RandomKey key)
    : rollout_(rollout), options_(options), key_(key), execution_(rollout, symbols, skills, options) {
  open_subgoal();
}

SkillResult SkillTrack::run(const PlanStep& step, std::size_t position, const CallSettings& set, CallMode mode) {
  mode.find_blockers = !mode.random_parameters && asked_.emplace(position, step).second;
  mode.explain = mode.find_blockers || options_.services.explain;
  SkillRequest request;
  request.step = step;
  request.set = set;
  request.mode = mode;
  if (const auto refusal = begin(std::move(request), position)) throw Error(*refusal);
  run_to_end(execution_, rollout_);
  return end(position);
}

std::optional<Error> SkillTrack::begin(SkillRequest request, std::size_t position) {
  const auto tried = tries_.find(position);
  const int tries = tried == tries_.end() ? 0 : tried->second;
  request.key = key_.with(static_cast<std::int64_t>(position)).with(tries);
  request.attempt = tries;
  request.parent_segment = subgoal_segment_;
  return execution_.begin(request);
}

SkillResult SkillTrack::end(std::size_t position) {
  const SkillResult result = execution_.result();
  remember(result.segment, position);
  if (result.ok()) advance_subgoals();
  return result;
}

void SkillTrack::advance_subgoals() {
  const auto& subgoals = rollout_.task().subgoals;
  while (subgoal_ < subgoals.size() && rollout_.holds_now(subgoals[subgoal_].formula)) {
    rollout_.close_segment(subgoal_segment_);
    ++subgoal_;
    open_subgoal();
  }
}

std::unique_ptr<GoalWatch> SkillTrack::watch_goal(std::int64_t held) {
  return std::make_unique<GoalWatch>(rollout_, frames(kGoalPatience), hold_frames(), held, subgoal_segment_);
}

void SkillTrack::end_goal(const SkillResult& result, std::size_t position) { remember(result.segment, position); }

SkillResult SkillTrack::finish_goal(std::size_t position) {
  const std::unique_ptr<GoalWatch> watch = watch_goal(0);
  const SkillResult result = run_to_end(*watch, rollout_);
  end_goal(result, position);
  return result;
}

SkillTrack::State SkillTrack::state() const {
  State state{subgoal_, subgoal_segment_, {}, tries_};
  for (const auto& [segment, slot] : slots_) state.slots[segment] = {slot.position, slot.try_number};
  return state;
}

void SkillTrack::restore(const State& state) {
  subgoal_ = state.subgoal;
  subgoal_segment_ = state.subgoal_segment;
  tries_ = state.tries;
  slots_.clear();
  for (const auto& [segment, slot] : state.slots) slots_[segment] = {slot.first, slot.second};
}

void SkillTrack::forget() {
  rollout_.recorder().forget_segments(static_cast<std::size_t>(subgoal_segment_) + 1);
  slots_.clear();
  tries_.clear();
}

void SkillTrack::close(const SkillResult& verdict) {
  if (!rollout_.at_frame() || rollout_.step() == 0) {
    const int hold = rollout_.open_motion(kHold, subgoal_segment_);
    do rollout_.advance();
    while (!rollout_.at_frame());  // also after an end between two frames: a frame is what is recorded and replayed
    rollout_.close_segment(hold);
  }
  rollout_.close_segment(subgoal_segment_, verdict.reason, verdict.detail);
}

std::int64_t SkillTrack::hold_frames() const { return frames(rollout_.task().hold_s); }

std::int64_t SkillTrack::frames(double seconds) const {
  return std::llround(std::ceil(seconds * rollout_.view().scene().frame_hz - 1e-9));
}

void SkillTrack::open_subgoal() {
  const auto& subgoals = rollout_.task().subgoals;
  SegmentRecord segment;
  segment.kind = SegmentKind::subgoal;
  segment.robot = rollout_.view().scene().robot.name;
  segment.skill = subgoal_ < subgoals.size() ? subgoals[subgoal_].name : "goal";
  segment.label = segment.skill;
  if (subgoal_ < subgoals.size() && !subgoals[subgoal_].sentence.empty()) segment.label = subgoals[subgoal_].sentence;
  subgoal_segment_ = rollout_.recorder().open_segment(std::move(segment), rollout_.step());
}

void SkillTrack::remember(int segment, std::size_t position) { slots_[segment] = {position, ++tries_[position]}; }

SkillTrack::Place SkillTrack::here() { return {rollout_.checkpoint(), subgoal_, subgoal_segment_}; }

void SkillTrack::back_to(const Place& place) {
  Recorder& recorder = rollout_.recorder();
  const std::size_t kept = place.checkpoint.record.segments;
  Slot slot;
  for (std::size_t i = kept; i < recorder.segments.size(); ++i) {
    const auto own = slots_.find(static_cast<int>(i));  // of the skills and of standing still at the end
    if (own != slots_.end()) slot = own->second;
    if (own == slots_.end() && recorder.segments[i].kind != SegmentKind::skill) continue;
    recorder.attempts.push_back({recorder.segments[i], static_cast<int>(slot.position), slot.try_number});
  }
  slots_.erase(slots_.lower_bound(static_cast<int>(kept)), slots_.end());
  rollout_.restore(place.checkpoint);
  subgoal_ = place.subgoal;
  subgoal_segment_ = place.subgoal_segment;
}

// Until here an attempt knows its place in the plan; now it learns the segment that took its place in the end.
void SkillTrack::place_attempts() {
  Recorder& recorder = rollout_.recorder();
  for (std::size_t i = 0; i < recorder.attempts.size(); ++i) {
    AttemptRecord& attempt = recorder.attempts.edit(i);
    const auto position = static_cast<std::size_t>(attempt.before_segment);
    attempt.before_segment = static_cast<int>(recorder.segments.size());
    for (const auto& [segment, slot] : slots_)
      if (slot.position == position) attempt.before_segment = segment;
  }
}

}  // namespace stampede
