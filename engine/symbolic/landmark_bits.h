// Which landmarks are ahead of each successor of a state, by bits and from what changed.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/symbolic/landmark_graph.h"

namespace stampede::symbolic {

struct LandmarksAhead {
  int landmarks = 0;  // not yet reached, or false again though still needed
  int goals = 0;      // open, or held too early
};

// Lifetime: refers to the graph.
class LandmarkBits {
 public:
  explicit LandmarkBits(const LandmarkGraph& graph);
  bool empty() const { return needs_.empty(); }  // there are too many landmarks, or none

  // `reached`: on the way to the state. `same`: what is ahead of a successor in which the same landmarks are true.
  // State and `reached` must outlive the calls of `ahead_of`.
  void begin_successors(const Words& state, const std::uint64_t* reached, LandmarksAhead same);
  LandmarksAhead ahead_of(const Words& successor);

 private:
  using Bits = std::vector<std::uint64_t>;
  const std::uint64_t* mask(const Bits& masks, int landmark) const {
    return masks.data() + static_cast<std::size_t>(landmark) * words_;
  }
  bool find_truth(const Words& successor);
  void spread_wanted(int landmark);
  void find_wanted();
  void find_reached();
  LandmarksAhead count() const;

  const LandmarkGraph& graph_;
  std::size_t words_;
  Bits before_, needs_, needed_for_, takes_away_;  // the graph's relations, `words_` a landmark
  Bits goals_;
  const Words* parent_ = nullptr;
  const std::uint64_t* parent_reached_ = nullptr;
  LandmarksAhead same_;
  Bits parent_truth_, truth_, wanted_, reached_;
  std::vector<int> stack_;
};

}  // namespace stampede::symbolic
