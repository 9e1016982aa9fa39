// States as bits, their successors, and the axioms.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/symbolic/axioms.h"

namespace stampede::symbolic {

using Words = std::vector<std::uint64_t>;

inline bool test(const std::uint64_t* words, int fact) { return (words[fact >> 6] >> (fact & 63) & 1) != 0; }
inline bool literal_holds(const std::uint64_t* words, Literal literal) {
  return test(words, literal >> 1) != ((literal & 1) != 0);
}
inline int goals_open(const Words& state, const Literals& goal) {
  return static_cast<int>(
      std::count_if(goal.begin(), goal.end(), [&](Literal one) { return !literal_holds(state.data(), one); }));
}
inline void assign(std::uint64_t* words, int fact, bool value) {
  const std::uint64_t bit = std::uint64_t{1} << (fact & 63);
  words[fact >> 6] = value ? words[fact >> 6] | bit : words[fact >> 6] & ~bit;
}

// Bits of all facts; the derived ones follow from the basic ones. Not for two threads at once.
class Semantics {
 public:
  explicit Semantics(const GroundTask& task);
  Words initial() const;
  bool applicable(const Words& state, int op) const;
  void apply(const Words& state, int op, Words& next) const;  // derived bits included
  bool is_goal(const Words& state) const;
  std::size_t words() const { return words_; }

 private:
  const GroundTask& task_;
  Axioms axioms_;
  std::size_t words_;
};

// Distinct states in one pool, numbered in the order of their insertion.
class StatePool {
 public:
  explicit StatePool(std::size_t words) : words_(words), slots_(1024, -1) {}
  // The state's number, and whether it is new.
  std::pair<int, bool> insert(const Words& state);
  Words get(int number) const;
  std::int64_t bytes() const;
  int size() const { return count_; }

 private:
  void grow();
  std::uint64_t hash(const std::uint64_t* state) const;
  std::size_t words_;
  int count_ = 0;
  std::vector<std::uint64_t> pool_;
  std::vector<int> slots_;
};

}  // namespace stampede::symbolic
