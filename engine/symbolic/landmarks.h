// How many of the facts that every plan makes true are still ahead.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/symbolic/landmark_bits.h"

namespace stampede::symbolic {

// Landmarks, counted along the path that led to a state (Richter, Westphal, JAIR 2010, doi:10.1613/jair.2972).
class Landmarks {
 public:
  Landmarks(const GroundTask& task, const Relaxation& relaxation, const Words& start);
  Landmarks(const Landmarks&) = delete;
  Landmarks& operator=(const Landmarks&) = delete;

  std::size_t words() const { return now_.size(); }
  int size() const { return graph_.size(); }
  // `reached`: which landmarks came true on the way to the state before; afterwards on the way to this one.
  void progress(const Words& state, std::uint64_t* reached);
  using Ahead = LandmarksAhead;
  // As `progress`, except that goals which hold too early are taken out of `reached`: they will be undone, because
  // every way to make them true takes away what an open goal, or another of them, still needs (the reasonable orders of
  // Koehler, Hoffmann, JAIR 2000, doi:10.1613/jair.715).
  Ahead judge(const Words& state, std::uint64_t* reached);

  // What `judge` says of each successor of one state, by bits and from what changed: several times faster.
  // `reached`: of the state, after its own `progress`. Both must outlive the calls of `ahead_of`.
  void begin_successors(const Words& state, const std::uint64_t* reached);
  Ahead ahead_of(const Words& successor);

 private:
  int find_wanted(const Words& state);

  LandmarkGraph graph_;
  LandmarkBits bits_;
  const std::uint64_t* parent_reached_ = nullptr;  // of `begin_successors`
  std::vector<char> wanted_;                       // scratch of `find_wanted`
  std::vector<int> stack_;                         // the same
  std::vector<std::uint64_t> now_, reached_;       // scratch of `progress`; of `ahead_of`
};

}  // namespace stampede::symbolic
