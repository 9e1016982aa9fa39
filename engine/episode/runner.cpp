#include "engine/episode/runner.h"

#include <chrono>

#include "engine/base/error.h"
#include "engine/episode/account.h"
#include "engine/episode/drivers.h"
#include "engine/record/scene_record.h"
#include "engine/start/altered_task.h"
#include "engine/start/call_settings.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

SkillResult behave(Drive& drive, const Rollout& rollout, EpisodeRecord& record) {
  const bool planned = drive.options.behaviour == Behaviour::plan;
  const SkillResult made = planned ? drive.plan.make() : SkillResult{};
  record.labels.documents.push_back({DocumentKind::plan, to_pddl(drive.plan.steps)});
  if (!made.ok()) return made;
  if (!planned) return act_at_random(drive, rollout, draw_key("behaviour", record));
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

void execute(Rollout& rollout, Symbols& symbols, SkillLibrary& skills, const RunOptions& options,
             EpisodeRecord& record) {
  describe_beginning(rollout, record);
  SkillTrack track(rollout, symbols, skills, options, draw_key("skill", record));
  CurrentPlan plan(rollout, options);
  Drive drive{track, plan, options, record.labels.documents};
  const SkillResult verdict = behave(drive, rollout, record);
  track.close(verdict);
  track.place_attempts();
  close_record(rollout, verdict, plan.as_text(), record);
}

void check_all_settings(const std::map<std::string, CallSettings>& all, const SkillLibrary& skills) {
  for (const auto& [name, set] : all) {
    if (name == kOfMotions) {
      check_motion_settings(set, "set");
      continue;
    }
    const SkillInfo* skill = skills.skill(name);
    if (skill == nullptr) throw Error("set", "there is no skill '" + name + "'");
    check_settings(*skill, set, "set");
  }
}

// From what was recorded, as anybody could later.
void paint(const RunOptions& options, EpisodeRecord& record) {
  if (chosen(observation_of(record)).images == WhichFrames::none) return;
  const std::unique_ptr<Renderer> own = options.services.renderer == nullptr ? make_renderer() : nullptr;
  paint_episode(own ? *own : *options.services.renderer, record, options.services.encoders);
}

}  // namespace

EpisodeRecord run_episode(const TaskDraw& task, Symbols& symbols, SkillLibrary& skills, const RunOptions& options,
                          const std::atomic<bool>* stop) {
  const auto began = std::chrono::steady_clock::now();  // host time, outside every hash
  check_all_settings(options.set, skills);
  const PreparedStart start = prepare_start(altered(task, symbols, options), symbols, options, stop);
  EpisodeRecord record = described(start.task, symbols, options);
  record.made.draws = start.draws;
  record.reason = start.reason;
  record.detail = start.detail;
  if (start.scene) {
    describe_scene(*start.scene, record);
    check_observation(*start.scene, chosen(observation_of(record)));  // now, not after the run
  }
  if (start.reason != Reason::none) return record;
  Rollout rollout(symbols, start, sensors_of(*start.scene, record, options.sensors), stop);
  execute(rollout, symbols, skills, options, record);
  paint(options, record);
  record.made.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return record;
}

}  // namespace stampede
