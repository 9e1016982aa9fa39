// The facts that every plan makes true at some time, and the orders between them.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/symbolic/relaxation.h"
#include "engine/symbolic/state.h"

namespace stampede::symbolic {

// All fact landmarks of the task without removals, by propagating labels to a fixed point (Zhu, Givan, ICAPS 2003
// doctoral consortium; Keyder, Richter, Helmert, ECAI 2010), with the orders that follow from them. Where the labels
// would need too much memory or time, the goals alone.
struct LandmarkGraph {
  LandmarkGraph(const GroundTask& task, const Relaxation& relaxation, const Words& start);

  int size() const { return static_cast<int>(node.size()); }
  std::size_t words() const { return (node.size() + 63) / 64; }  // of 64 bits, a set of landmarks

  std::vector<int> node;                     // of each landmark
  std::vector<int> of_node;                  // by node: its landmark or -1
  std::vector<int> goals;                    // landmarks
  std::vector<std::vector<int>> before;      // by landmark: which must have been true earlier
  std::vector<std::vector<int>> needed_for;  // by landmark: those just before whose first achievement it must hold
  std::vector<std::vector<int>> needs;       // by landmark: what must hold right before it
  std::vector<std::vector<int>> takes_away;  // by landmark, goals only: what all its achievers remove
};

inline bool has_bit(const std::uint64_t* words, int i) { return (words[i >> 6] >> (i & 63) & 1) != 0; }
inline void set_bit(std::uint64_t* words, int i) { words[i >> 6] |= std::uint64_t{1} << (i & 63); }

}  // namespace stampede::symbolic
