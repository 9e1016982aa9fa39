// Facts that every plan makes true at some time, and how many of them are still ahead.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/symbolic/relaxation.h"
#include "engine/symbolic/state.h"

namespace stampede::symbolic {

// All fact landmarks of the task without removals, by propagating labels to a fixed point (Zhu, Givan, ICAPS 2003
// doctoral consortium; Keyder, Richter, Helmert, ECAI 2010), with the orders that follow from them; counted along the
// path that led to a state (Richter, Westphal, JAIR 2010, doi:10.1613/jair.2972). Where the labels would need too much
// memory or time, the goals alone.
class Landmarks {
 public:
  Landmarks(const GroundTask& task, const Relaxation& relaxation, const Words& start);

  std::size_t words() const { return words_; }
  int size() const { return static_cast<int>(node_.size()); }
  // `reached`: which landmarks came true on the way to the state before; afterwards on the way to this one.
  void progress(const Words& state, std::uint64_t* reached);
  struct Ahead {
    int landmarks = 0;  // not yet reached, or false again though still needed
    int goals = 0;      // open, or held too early
  };
  // As `progress`, except that goals which hold too early are taken out of `reached`: they will be undone, because
  // every way to make them true takes away what an open goal, or another of them, still needs (the reasonable orders of
  // Koehler, Hoffmann, JAIR 2000, doi:10.1613/jair.715).
  Ahead judge(const Words& state, std::uint64_t* reached);

  // What `judge` says of each successor of one state, by bits and from what changed: several times faster.
  // `reached`: of the state, after its own `progress`. Both must outlive the calls of `ahead_of`.
  void begin_successors(const Words& state, const std::uint64_t* reached);
  Ahead ahead_of(const Words& successor);

 private:
  void make_masks();
  void spread_wanted(int landmark);
  const std::uint64_t* mask(const std::vector<std::uint64_t>& masks, int landmark) const {
    return masks.data() + static_cast<std::size_t>(landmark) * words_;
  }
  void label(const GroundTask& task, const Relaxation& relaxation, const Words& start);
  void choose(const GroundTask& task);
  void find_removals(const GroundTask& task);
  int find_wanted(const Words& state);
  void order(const GroundTask& task, const Relaxation& relaxation);
  const std::uint64_t* labels_of(int node) const { return labels_.data() + static_cast<std::size_t>(node) * width_; }

  std::size_t words_ = 0, width_ = 0;  // 64-bit words a set of landmarks and a label
  std::vector<std::uint64_t> labels_;  // by node, while building; empty: none
  std::vector<char> labelled_;         // by node: reached by the relaxation

  std::vector<int> node_;                     // of each landmark
  std::vector<int> of_node_;                  // by node: its landmark or -1
  std::vector<char> is_goal_;                 // by landmark
  std::vector<int> goals_;                    // landmarks
  std::vector<std::vector<int>> before_;      // by landmark: which must have been true earlier
  std::vector<std::vector<int>> needed_for_;  // by landmark: those just before whose first achievement it must hold
  std::vector<std::vector<int>> needs_;       // by landmark: what must hold right before it
  std::vector<std::vector<int>> takes_away_;  // by landmark, goals only: what all its achievers remove
  std::vector<char> wanted_;                  // scratch of `find_wanted`
  std::vector<int> stack_;                    // the same
  std::vector<std::uint64_t> now_;            // scratch of `progress` and `judge`

  // The same relations as bits, `words_` a landmark; empty where there are too many landmarks.
  std::vector<std::uint64_t> before_mask_, needs_mask_, needed_for_mask_, takes_away_mask_, goal_mask_;
  const Words* parent_ = nullptr;  // of `begin_successors`
  const std::uint64_t* parent_reached_ = nullptr;
  Ahead parent_ahead_;  // of a successor in which the same landmarks are true
  std::vector<std::uint64_t> parent_truth_, truth_, wanted_bits_, reached_bits_;
};

}  // namespace stampede::symbolic
