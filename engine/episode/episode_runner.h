// One episode in the making: the class behind run_episode. runner.cpp frames it, behave.cpp and
// undo.cpp decide what is done next.
#pragma once

#include <map>
#include <optional>
#include <set>

#include "engine/episode/planning.h"
#include "engine/episode/skill_driver.h"
#include "engine/symbolic/task_planner.h"

namespace stampede {

class EpisodeRunner {
 public:
  EpisodeRunner(Task& task, Symbols& symbols, SkillLibrary& skills, const RunOptions& options,
                const std::atomic<bool>* stop)
      : task_(task), symbols_(symbols), skills_(skills), options_(options), stop_(stop), subgoals_(task.subgoals()) {}

  EpisodeRecord run();

 private:
  // A skill boundary to which the episode can go back.
  struct Place {
    Rollout::Checkpoint checkpoint;
    std::size_t subgoal = 0;
    int subgoal_segment = 0;
  };

  struct Undo;

  void describe_episode(const PreparedStart& start);
  SkillResult make_plan();
  PlanOutcome ask_planner();
  void write_problem();
  SkillResult plan_rest(std::size_t done);
  SkillResult behave();
  SkillResult with_undo();
  SkillResult straight();
  SkillResult with_recovery();
  SkillResult at_random();
  void step_done(Undo& undo);
  bool try_again(Undo& undo, const SkillResult& failed);
  bool stands(const Obstruction& one) const;
  bool avoid_obstacles(const SkillResult& failed, std::size_t index);
  bool avoid(const std::vector<std::string>& blockers, const SkillResult& failed, std::size_t index);
  bool other_plan(const Place& start, std::map<PlanStep, int>& blame);
  SkillResult watch(std::size_t done);
  SkillResult one_step(std::size_t index, std::size_t position);
  SkillResult finish_goal(std::size_t position);
  void remember(int segment, std::size_t position);
  void open_subgoal();
  void after_skill();
  Place here();
  void back_to(const Place& place);
  void place_attempts();
  void close(const SkillResult& result);
  void paint();
  std::int64_t frames(double seconds) const;

  Task& task_;
  Symbols& symbols_;
  SkillLibrary& skills_;
  const RunOptions& options_;
  const std::atomic<bool>* stop_;
  EpisodeRecord record_;
  std::optional<Rollout> rollout_;
  std::optional<SkillDriver> driver_;
  std::vector<std::pair<std::string, Formula>> subgoals_;
  std::size_t subgoal_ = 0;
  int subgoal_segment_ = 0;
  Plan plan_;
  std::set<PlanStep> forbidden_;                      // ground actions that plans do without
  std::set<std::pair<std::size_t, PlanStep>> asked_;  // steps tried at a place: what is in the way is sought once
  std::vector<Obstruction> obstructions_;             // what was found in the way of which action
  std::optional<Facts> expected_;                     // basic facts that the last step should have led to
  struct Slot {
    std::size_t position = 0;
    int try_number = 0;
  };
  std::map<int, Slot> slots_;         // of skill segments, by ordinal
  std::map<std::size_t, int> tries_;  // runs so far at a place in the plan: never undone, so draws never repeat
  bool explicit_steps_ = false;
};

}  // namespace stampede
