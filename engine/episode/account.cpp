#include "engine/episode/account.h"

#include "engine/record/keyframes.h"
#include "engine/start/language.h"
#include "engine/start/planning.h"
#include "engine/start/relations.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

// The world's own domain, the same for all its tasks; where the goal has an order or asks for relations that skills
// make by where they put things, also what the planner is asked.
void write_problem(const Task& task, const Domain& domain, const Rollout& rollout, EpisodeRecord& record) {
  const Domain own = named_by_content(domain);
  record.labels.documents.push_back({DocumentKind::pddl_domain, to_pddl(own)});
  record.labels.documents.push_back(
      {DocumentKind::pddl_problem, to_pddl(world_problem(task, rollout.facts()), own, record.beside_goal)});
  if (task.stages.empty() && relations_asked(task, rollout.facts()).empty()) return;
  const PlanningTask planning = planning_task(task, domain, rollout.facts(), rollout.stage());
  const Domain ordered = named_by_content(planning.domain);
  record.labels.documents.push_back({DocumentKind::ordered_domain, to_pddl(ordered)});
  record.labels.documents.push_back({DocumentKind::ordered_problem, to_pddl(planning.problem, ordered)});
}

ObservationChoice observed(const Task& task, const RunOptions& options) {
  ObservationChoice choice = before(options.observation, task.observation);
  const auto add = [](std::optional<double>& noise, double further) {
    if (further > 0) noise = noise.value_or(0) + further;
  };
  const SensorNoise further = further_noise(options.perturb);
  add(choice.rgb_noise, further.rgb);
  add(choice.depth_noise, further.depth);
  add(choice.torque_noise, further.torque);
  return choice;
}

}  // namespace

RandomKey draw_key(const char* purpose, const EpisodeRecord& record) {
  return RandomKey(purpose).with(record.task).with(record.variation).with(record.seed);
}

EpisodeRecord described(const Task& task, const Symbols& symbols, const RunOptions& options) {
  EpisodeRecord record;
  record.task = task.name;
  record.variation = task.variation;
  record.axes = task.axes;
  record.seed = options.seed;
  record.made.split = options.split;
  record.made.options = options.as_text();
  record.made.options.merge(observed(task, options).as_text());
  record.beside_goal = beside_goal(task);
  for (const std::string& sentence : task.instructions)
    record.labels.language.push_back({.level = LanguageLevel::task, .text = sentence});
  for (const Predicate& predicate : symbols.domain().predicates)
    if (predicate.kind != PredicateKind::start)
      record.scene.predicates[predicate.name] = predicate.kind == PredicateKind::basic     ? "basic"
                                                : predicate.kind == PredicateKind::derived ? "derived"
                                                                                           : "fixed";
  return record;
}

void describe_beginning(const Rollout& rollout, EpisodeRecord& record) {
  const FactTracker& facts = rollout.facts();
  const Scene& scene = rollout.view().scene();
  const Facts said = mentionable(facts.facts(), facts.observed(), rollout.domain(), scene);
  for (const std::string& sentence : describe_world(said, rollout.domain(), scene))
    record.labels.language.push_back({.level = LanguageLevel::world, .text = sentence});
  write_problem(rollout.task(), rollout.domain(), rollout, record);
}

void close_record(Rollout& rollout, const SkillResult& verdict, const std::string& plan, EpisodeRecord& record) {
  const bool success = verdict.ok();
  Recorder& recorder = rollout.recorder();
  if (recorder.frames.size() > 1) {
    FrameRecord& last = recorder.frames.edit(recorder.frames.size() - 2);
    last.done = true;
    if (success) last.reward += 1;
  }
  record.outcome = success ? Outcome::success : Outcome::failure;
  record.reason = verdict.reason;
  record.detail = verdict.reason == Reason::sensor_error ? rollout.sensors().failure() : verdict.detail;
  record.steps = rollout.step();
  record.commands = rollout.world().log();
  record.labels.facts = rollout.facts().intervals(record.steps, rollout.steps_per_frame());
  record.labels.observed_facts = rollout.facts().observed_intervals(record.steps, rollout.steps_per_frame());
  record.channels = rollout.sensors().channels();
  record.state_hash = rollout.world().state_hash();
  record.made.physics_wall_s = rollout.physics_wall_s();
  recorder.finish(record, record.steps);
  for (const SegmentRecord& segment : record.labels.segments)
    if (segment.kind == SegmentKind::skill && !segment.label.empty())
      record.labels.language.push_back(
          {.level = LanguageLevel::skill, .text = segment.label, .segment = segment.ordinal});
    else if (segment.kind == SegmentKind::subgoal && segment.label != segment.skill)
      record.labels.language.push_back(
          {.level = LanguageLevel::subgoal, .text = segment.label, .segment = segment.ordinal});
  record.labels.keyframes["stopped"] = stopped_keyframes(record);
  for (DocumentRecord& document : record.labels.documents)
    if (document.kind == DocumentKind::plan) document.text = plan;
}

}  // namespace stampede
