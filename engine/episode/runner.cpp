#include "engine/episode/runner.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "engine/episode/altered_task.h"
#include "engine/episode/episode_runner.h"
#include "engine/episode/keyframes.h"
#include "engine/episode/language.h"
#include "engine/symbolic/pddl.h"

namespace stampede {

EpisodeRecord EpisodeRunner::run() {
  const auto began = std::chrono::steady_clock::now();  // host time, outside every hash
  const PreparedStart start = prepare_start(task_, symbols_, options_, stop_);
  describe_episode(start);
  if (start.scene) check_observation(*start.scene, chosen(observation_of(record_)));  // now, not after the run
  if (start.reason != Reason::none) {
    record_.reason = start.reason;
    record_.detail = start.detail;
    return std::move(record_);
  }
  SensorReader sensors(*start.scene, chosen(observation_of(record_)),
                       sensor_key(task_.name(), task_.variation(), options_.seed));
  rollout_.emplace(task_, symbols_, start, std::move(sensors), stop_);
  driver_.emplace(*rollout_, symbols_, skills_, options_,
                  RandomKey("skill").with(task_.name()).with(task_.variation()).with(options_.seed));
  for (const std::string& sentence : describe_world(rollout_->facts().facts(), symbols_.domain(), *start.scene))
    record_.language.push_back({"world", sentence, -1});
  open_subgoal();
  SkillResult result = make_plan();
  record_.documents.push_back({"plan", to_pddl(plan_)});
  if (result.ok()) result = behave();
  close(result);
  paint();
  record_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return std::move(record_);
}

void EpisodeRunner::describe_episode(const PreparedStart& start) {
  record_.task = task_.name();
  record_.variation = task_.variation();
  record_.axes = task_.axes();
  record_.seed = options_.seed;
  record_.split = options_.split;
  record_.options = options_.as_text();
  record_.options.merge(before(options_.observation, task_.observation()).as_text());
  record_.draws = start.draws;
  record_.beside_goal = beside_goal(task_);
  for (const std::string& sentence : task_.instructions()) record_.language.push_back({"task", sentence, -1});
  for (const Predicate& predicate : symbols_.domain().predicates)
    if (predicate.kind != PredicateKind::start)
      record_.predicates[predicate.name] = predicate.kind == PredicateKind::basic     ? "basic"
                                           : predicate.kind == PredicateKind::derived ? "derived"
                                                                                      : "fixed";
  if (!start.scene) return;
  const Scene& scene = *start.scene;
  record_.world = scene.world;
  record_.physics_hz = scene.physics_hz;
  record_.frame_hz = scene.frame_hz;
  record_.scene_document = scene_to_document(scene);
  record_.objects = scene.objects;
  record_.cameras = scene.cameras;
  record_.masks = mask_key(scene);
  record_.hands = {scene.robot.name + "." + scene.robot.hand};
}

std::int64_t EpisodeRunner::frames(double seconds) const {
  return std::llround(std::ceil(seconds * record_.frame_hz - 1e-9));
}

void EpisodeRunner::open_subgoal() {
  SegmentRecord segment;
  segment.kind = "subgoal";
  segment.robot = record_.hands.empty() ? "" : rollout_->view().scene().robot.name;
  segment.skill = subgoal_ < subgoals_.size() ? subgoals_[subgoal_].first : "goal";
  segment.label = segment.skill;
  subgoal_segment_ = rollout_->recorder().open_segment(std::move(segment), rollout_->step());
}

void EpisodeRunner::after_skill() {
  while (subgoal_ < subgoals_.size() && rollout_->holds_now(subgoals_[subgoal_].second)) {
    rollout_->recorder().close_segment(subgoal_segment_, rollout_->step(), Outcome::success, Reason::none, {});
    ++subgoal_;
    open_subgoal();
  }
}

EpisodeRunner::Place EpisodeRunner::here() { return {rollout_->checkpoint(), subgoal_, subgoal_segment_}; }

void EpisodeRunner::back_to(const Place& place) {
  Recorder& recorder = rollout_->recorder();
  const std::size_t kept = place.checkpoint.record.segments;
  Slot slot;
  for (std::size_t i = kept; i < recorder.segments.size(); ++i) {
    if (recorder.segments[i].kind != "skill") continue;
    if (const auto own = slots_.find(static_cast<int>(i)); own != slots_.end()) slot = own->second;  // else a child's
    recorder.attempts.push_back({recorder.segments[i], static_cast<int>(slot.position), slot.try_number});
  }
  slots_.erase(slots_.lower_bound(static_cast<int>(kept)), slots_.end());
  rollout_->restore(place.checkpoint);
  subgoal_ = place.subgoal;
  subgoal_segment_ = place.subgoal_segment;
}

// Until here an attempt knows its place in the plan; now it learns the segment that took its place in the end.
void EpisodeRunner::place_attempts() {
  Recorder& recorder = rollout_->recorder();
  for (AttemptRecord& attempt : recorder.attempts) {
    const auto position = static_cast<std::size_t>(attempt.before_segment);
    attempt.before_segment = static_cast<int>(recorder.segments.size());
    for (const auto& [segment, slot] : slots_)
      if (slot.position == position) attempt.before_segment = segment;
  }
}

void EpisodeRunner::close(const SkillResult& result) {
  const bool success = result.ok();
  Recorder& recorder = rollout_->recorder();
  if (!rollout_->at_frame() || rollout_->step() == 0) driver_->wait_for_goal(1, 0, subgoal_segment_);
  recorder.close_segment(subgoal_segment_, rollout_->step(), success ? Outcome::success : Outcome::failure,
                         result.reason, result.detail);
  if (recorder.frames.size() > 1) {
    FrameRecord& last = recorder.frames[recorder.frames.size() - 2];
    last.done = true;
    if (success) last.reward += 1;
  }
  record_.outcome = success ? Outcome::success : Outcome::failure;
  record_.reason = result.reason;
  record_.detail = result.detail;
  record_.steps = rollout_->step();
  record_.commands = rollout_->world().log();
  record_.facts = rollout_->facts().intervals(record_.steps, rollout_->steps_per_frame());
  record_.observed_facts = rollout_->facts().observed_intervals(record_.steps, rollout_->steps_per_frame());
  record_.channels = rollout_->sensors().channels();
  record_.state_hash = rollout_->world().state_hash();
  record_.physics_wall_s = rollout_->physics_wall_s();
  place_attempts();
  recorder.finish(record_, record_.steps);
  for (const SegmentRecord& segment : record_.segments)
    if (segment.kind == "skill" && !segment.label.empty())
      record_.language.push_back({"skill", segment.label, segment.ordinal});
  record_.keyframes["stopped"] = stopped_keyframes(record_);
  for (DocumentRecord& document : record_.documents)
    if (document.kind == "plan") document.text = to_pddl(plan_);
}

// From what was recorded, as anybody could later.
void EpisodeRunner::paint() {
  if (chosen(observation_of(record_)).images == WhichFrames::none) return;
  const std::unique_ptr<Renderer> own = options_.renderer == nullptr ? make_osmesa_renderer() : nullptr;
  paint_episode(own ? *own : *options_.renderer, record_);
}

EpisodeRecord run_episode(Task& task, Symbols& symbols, SkillLibrary& skills, const RunOptions& options,
                          const std::atomic<bool>* stop) {
  AlteredTask altered(task, symbols, options);
  return EpisodeRunner(altered, symbols, skills, options, stop).run();
}

}  // namespace stampede
