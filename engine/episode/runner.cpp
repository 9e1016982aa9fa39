#include "engine/episode/runner.h"

#include <chrono>

#include "engine/base/error.h"
#include "engine/episode/altered_task.h"
#include "engine/episode/call_settings.h"
#include "engine/episode/drivers.h"
#include "engine/episode/keyframes.h"
#include "engine/episode/language.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

RandomKey key_of(const char* purpose, const EpisodeRecord& record) {
  return RandomKey(purpose).with(record.task).with(record.variation).with(record.seed);
}

EpisodeRecord described(const Task& task, const Symbols& symbols, const RunOptions& options) {
  EpisodeRecord record;
  record.task = task.name;
  record.variation = task.variation;
  record.axes = task.axes;
  record.seed = options.seed;
  record.split = options.split;
  record.options = options.as_text();
  record.options.merge(before(options.observation, task.observation).as_text());
  record.beside_goal = beside_goal(task);
  for (const std::string& sentence : task.instructions) record.language.push_back({LanguageLevel::task, sentence, -1});
  for (const Predicate& predicate : symbols.domain().predicates)
    if (predicate.kind != PredicateKind::start)
      record.predicates[predicate.name] = predicate.kind == PredicateKind::basic     ? "basic"
                                          : predicate.kind == PredicateKind::derived ? "derived"
                                                                                     : "fixed";
  return record;
}

void describe_scene(const Scene& scene, EpisodeRecord& record) {
  record.world = scene.world;
  record.physics_hz = scene.physics_hz;
  record.frame_hz = scene.frame_hz;
  record.scene_document = scene_to_document(scene);
  record.objects = scene.objects;
  record.cameras = scene.cameras;
  record.masks = mask_key(scene);
  record.hands = {scene.robot.name + "." + scene.robot.hand};
}

// The world's own domain, the same for all its tasks; where the goal has an order, also what the planner is asked.
void write_problem(const Task& task, const Domain& domain, const Rollout& rollout, EpisodeRecord& record) {
  const Domain own = named_by_content(domain);
  record.documents.push_back({DocumentKind::pddl_domain, to_pddl(own)});
  record.documents.push_back(
      {DocumentKind::pddl_problem, to_pddl(world_problem(task, rollout.facts()), own, record.beside_goal)});
  if (task.stages.empty()) return;
  const PlanningTask planning = planning_task(task, domain, rollout.facts(), rollout.stage());
  const Domain ordered = named_by_content(planning.domain);
  record.documents.push_back({DocumentKind::ordered_domain, to_pddl(ordered)});
  record.documents.push_back({DocumentKind::ordered_problem, to_pddl(planning.problem, ordered)});
}

SkillResult behave(Drive& drive, const Rollout& rollout, EpisodeRecord& record) {
  const bool planned = drive.options.behaviour == Behaviour::plan;
  const SkillResult made = planned ? drive.plan.make() : SkillResult{};
  record.documents.push_back({DocumentKind::plan, to_pddl(drive.plan.steps)});
  if (!made.ok()) return made;
  if (!planned) return act_at_random(drive, rollout, key_of("behaviour", record));
  switch (drive.options.on_failure) {
    case OnFailure::undo:
      return follow_with_undo(drive);
    case OnFailure::stop:
      return follow_plan(drive);
    case OnFailure::recover:
      return follow_with_recovery(drive);
  }
  return {};
}

// All that the rollout holds goes into the record.
void close(Rollout& rollout, const SkillResult& verdict, const CurrentPlan& plan, EpisodeRecord& record) {
  const bool success = verdict.ok();
  Recorder& recorder = rollout.recorder();
  if (recorder.frames.size() > 1) {
    FrameRecord& last = recorder.frames[recorder.frames.size() - 2];
    last.done = true;
    if (success) last.reward += 1;
  }
  record.outcome = success ? Outcome::success : Outcome::failure;
  record.reason = verdict.reason;
  record.detail = verdict.detail;
  record.steps = rollout.step();
  record.commands = rollout.world().log();
  record.facts = rollout.facts().intervals(record.steps, rollout.steps_per_frame());
  record.observed_facts = rollout.facts().observed_intervals(record.steps, rollout.steps_per_frame());
  record.channels = rollout.sensors().channels();
  record.state_hash = rollout.world().state_hash();
  record.physics_wall_s = rollout.physics_wall_s();
  recorder.finish(record, record.steps);
  for (const SegmentRecord& segment : record.segments)
    if (segment.kind == SegmentKind::skill && !segment.label.empty())
      record.language.push_back({LanguageLevel::skill, segment.label, segment.ordinal});
  record.keyframes["stopped"] = stopped_keyframes(record);
  for (DocumentRecord& document : record.documents)
    if (document.kind == DocumentKind::plan) document.text = plan.as_text();
}

void execute(Rollout& rollout, Symbols& symbols, SkillLibrary& skills, const RunOptions& options,
             EpisodeRecord& record) {
  const Task& task = rollout.task();
  const Domain& domain = symbols.domain();
  for (const std::string& sentence : describe_world(rollout.facts().facts(), domain, rollout.view().scene()))
    record.language.push_back({LanguageLevel::world, sentence, -1});
  write_problem(task, domain, rollout, record);
  SkillTrack track(rollout, symbols, skills, options, key_of("skill", record));
  CurrentPlan plan(rollout, options);
  Drive drive{track, plan, options, record.documents};
  const SkillResult verdict = behave(drive, rollout, record);
  track.close(verdict);
  track.place_attempts();
  close(rollout, verdict, plan, record);
}

void check_all_settings(const std::map<std::string, CallSettings>& all, const SkillLibrary& skills) {
  for (const auto& [name, set] : all) {
    const SkillInfo* skill = skills.skill(name);
    if (skill == nullptr) throw Error("set", "there is no skill '" + name + "'");
    check_settings(*skill, set, "set");
  }
}

// From what was recorded, as anybody could later.
void paint(Renderer* renderer, EpisodeRecord& record) {
  if (chosen(observation_of(record)).images == WhichFrames::none) return;
  const std::unique_ptr<Renderer> own = renderer == nullptr ? make_osmesa_renderer() : nullptr;
  paint_episode(own ? *own : *renderer, record);
}

}  // namespace

EpisodeRecord run_episode(const TaskDraw& task, Symbols& symbols, SkillLibrary& skills, const RunOptions& options,
                          const std::atomic<bool>* stop) {
  const auto began = std::chrono::steady_clock::now();  // host time, outside every hash
  check_all_settings(options.set, skills);
  const PreparedStart start = prepare_start(altered(task, symbols, options), symbols, options, stop);
  EpisodeRecord record = described(start.task, symbols, options);
  record.draws = start.draws;
  record.reason = start.reason;
  record.detail = start.detail;
  if (start.scene) {
    describe_scene(*start.scene, record);
    check_observation(*start.scene, chosen(observation_of(record)));  // now, not after the run
  }
  if (start.reason != Reason::none) return record;
  SensorReader sensors(*start.scene, chosen(observation_of(record)),
                       sensor_key(record.task, record.variation, record.seed));
  Rollout rollout(symbols, start, std::move(sensors), stop);
  execute(rollout, symbols, skills, options, record);
  paint(options.renderer, record);
  record.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return record;
}

}  // namespace stampede
