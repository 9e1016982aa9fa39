// Which operators can be taken in a state.
#pragma once

#include <vector>

#include "engine/symbolic/state.h"

namespace stampede::symbolic {

// Each operator waits at the literal of its precondition that the fewest operators share; a state wakes those whose
// literal holds in it, and only they are tested.
class Successors {
 public:
  explicit Successors(const GroundTask& task);
  void applicable(const Words& state, std::vector<int>& operators) const;  // ascending

 private:
  const GroundTask& task_;
  std::vector<int> always_;           // without precondition
  std::vector<int> begin_, waiting_;  // by literal: the operators that wait there
  std::vector<int> rest_begin_;       // by position in waiting_: its other literals, the rarest first
  Literals rest_;
};

}  // namespace stampede::symbolic
