// How far the plan for the goal has come, as one number that rises.
#pragma once

#include <optional>

#include "engine/rollout/rollout.h"
#include "engine/start/planning.h"

namespace stampede {

// 1 - (remaining - near) / first, where `remaining` is the number of steps of a plan from here, `first` that from the
// start, and `near`, 0 … 0.9, how near the facts are that its next step brings about: the mean of 1 - tanh(5 m), m the
// size of the predicate's margin (m or rad), 1 for those that hold. 1 exactly where the goal holds, `also` included;
// below 0 where more is left to do than at the start, or nothing leads to the goal any more. A plan is kept as long as
// some rest of it leads to the goal, or its present step has begun to do what it should; so the value depends on the
// way that was taken. Lifetime: refers to the rollout and the symbols.
class DenseReward {
 public:
  DenseReward(Rollout& rollout, Symbols& symbols, RandomKey key);
  double value();  // of this moment

  // What it remembers beside the world: for whoever goes back.
  struct State {
    std::int64_t looked_at = -1;  // FactTracker::changes()
    int stage = -1;
    bool done = false, lost = false;
    Plan plan;
    std::size_t next = 0;  // the rest of the plan from here on
  };
  const State& state() const { return state_; }
  void restore(State state);

 private:
  void look();  // plans again when facts have changed and no rest of the present plan leads to the goal
  bool leads(std::size_t from, Facts facts, const PlanningTask& asked) const;
  bool under_way(const Facts& now, const PlanningTask& asked) const;
  double nearness() const;

  Rollout& rollout_;
  Symbols& symbols_;
  RandomKey key_;
  State state_;
  std::size_t first_ = 0;  // steps at the start
};

}  // namespace stampede
