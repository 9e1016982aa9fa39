// The skills of an episode one after the other: their subgoals, the places between them to which an episode can go
// back, and which try took whose place.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/rollout/goal_watch.h"
#include "engine/rollout/skill_execution.h"
#include "engine/start/options.h"

namespace stampede {

// Lifetime: refers to all it is made of.
class SkillTrack {
 public:
  // `key`: of all draws of all skills. Opens the segment of the first subgoal.
  SkillTrack(Rollout& rollout, Symbols& symbols, SkillLibrary& skills, const RunOptions& options, RandomKey key);

  // Executes one skill to its end. `position`: in the plan; with the number of earlier tries there it chooses the
  // draws. Throws Error for a call that cannot be.
  SkillResult run(const PlanStep& step, std::size_t position, const CallSettings& set = {}, CallMode mode = {});
  // The same in parts, for whoever owns the loop: begin, ticks of what `execution` is, and end once it is over.
  std::optional<Error> begin(SkillRequest request, std::size_t position);
  SkillExecution& execution() { return execution_; }
  SkillResult end(std::size_t position);

  // Stands still for the verdict, as if it were the step after the last.
  SkillResult finish_goal(std::size_t position);
  std::unique_ptr<GoalWatch> watch_goal(std::int64_t held);  // the same in parts; the goal has held for so many frames
  std::int64_t hold_frames() const;                          // for so many it must hold
  void end_goal(const SkillResult& result, std::size_t position);
  void advance_subgoals();  // to the first one that does not hold
  int subgoal_segment() const { return subgoal_segment_; }
  // To the next frame, and closes the subgoal that is open.
  void close(const SkillResult& verdict);

  // A boundary between two skills.
  struct Place {
    Rollout::Checkpoint checkpoint;
    std::size_t subgoal = 0;
    int subgoal_segment = 0;
  };
  Place here();                      // finds contacts anew, at every boundary, whether or not anything is undone
  void back_to(const Place& place);  // what has been since becomes attempts
  void place_attempts();             // at the end: each learns the segment that took its place

  // All that a branch of events needs to be taken up again. Between two skills.
  struct State {
    std::size_t subgoal = 0;
    int subgoal_segment = 0;
    std::map<int, std::pair<std::size_t, int>> slots;
    std::map<std::size_t, int> tries;
  };
  State state() const;
  void restore(const State& state);
  void forget();  // skills that are over, when nothing is recorded

 private:
  struct Slot {
    std::size_t position = 0;
    int try_number = 0;
  };
  void remember(int segment, std::size_t position);
  void open_subgoal();
  std::int64_t frames(double seconds) const;

  Rollout& rollout_;
  const RunOptions& options_;
  RandomKey key_;
  SkillExecution execution_;
  std::size_t subgoal_ = 0;
  int subgoal_segment_ = 0;
  std::map<int, Slot> slots_;         // of skill segments, by ordinal
  std::map<std::size_t, int> tries_;  // runs so far at a place in the plan: never undone, so draws never repeat
  std::set<std::pair<std::size_t, PlanStep>> asked_;  // steps tried at a place: what is in the way is sought once
};

}  // namespace stampede
