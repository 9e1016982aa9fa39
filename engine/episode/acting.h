// One episode that is acted in from outside, action by action. Inside this room only: the public face is Environment.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/episode/dense_reward.h"
#include "engine/episode/episode_source.h"
#include "engine/rollout/observer.h"
#include "engine/rollout/skill_track.h"
#include "engine/start/start.h"

namespace stampede {

// What goes on beyond the step that began it.
struct Running {
  enum class What { nothing, skill, path, hold } what = What::nothing;
  std::string name;
  std::unique_ptr<Motion> path;
  std::unique_ptr<GoalWatch> watch;
  int segment = -1;  // of a path
};

// Where an episode stands beside its rollout: what a saved state holds of it.
struct ActingPlace {
  std::size_t skills = 0;     // begun so far: the place of the next one
  std::int64_t held = -1;     // frames for which the goal has held without a skill; -1: it does not
  bool controlled = false;    // low-level actions since the last skill: the hand may hold something else
  int control_segment = -1;   // open; -1: none
  SharedList<PlanStep> done;  // skills, for the episode's plan
};

// Lifetime: refers to settings and renderer.
struct Acting : ActingPlace {
  Acting(EpisodeSource::Opened opened_in, const EnvironmentSettings& settings, EpisodeRecord described_record,
         const PreparedStart& start, std::unique_ptr<Renderer>& renderer);

  // Why an action makes no sense here, whatever the world is like.
  std::optional<ActionRefusal> refusal_of(const AgentAction& action) const;
  // Does it, and adds what ended to the result. A refusal: nothing has changed.
  std::optional<ActionRefusal> do_asked(const AgentAction& action, StepResult& result);
  // Of the action that was done last: what came of it, for the record.
  void note_result(const StepResult& result);
  // What runs is cut off here.
  void end_running(StepResult& result, const std::string& why);
  // The record gets all that the rollout holds.
  void finish(const SkillResult& verdict);

  EpisodeSource::Opened opened;
  EpisodeRecord record;
  Rollout rollout;
  SkillTrack track;
  Observer observer;
  std::vector<ActionSpace> spaces;
  std::optional<DenseReward> dense;
  Running running;
  Reason over = Reason::none;
  bool success = false, ended = false;
  std::optional<EnvironmentObservation> last;  // once the record has been given away
  std::string identity;

 private:
  std::optional<ActionRefusal> carry_out(const AgentAction& action, StepResult& result);
  std::optional<ActionRefusal> begin_skill(const AgentAction& action, StepResult& result);
  std::optional<ActionRefusal> begin_path(const AgentAction& action, StepResult& result);
  void begin_hold(StepResult& result);
  void one_frame(const std::vector<Operation>& operations);
  void to_frame();
  void advance();
  void go_on(int frames, StepResult& result);
  bool tick(StepResult& result);
  void skill_over(StepResult& result);
  void path_over(StepResult& result, const SkillResult& how);
  void look_at_hand();
  void look_at_goal();
  void judge();
  void open_control();
  void close_control();
};

}  // namespace stampede
