// The derived facts of a state, brought up to date from what changed.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/symbolic/ground.h"

namespace stampede::symbolic {

// Derived facts are evaluated in the order of their dependencies, and only where a fact that they are derived from has
// another value than before: a fact by itself from its axioms, a circle of facts that derive each other as a whole, to
// its least fixed point by counters (Dowling, Gallier, J. Logic Programming 1, 1984). Negated conditions lie strictly
// before what they decide, as `GroundTask` promises. Not for two threads at once: it has scratch space of its own.
class Axioms {
 public:
  explicit Axioms(const GroundTask& task);
  bool empty() const { return components_.empty(); }
  void derive(std::uint64_t* state) const;  // from the basic facts alone
  // `before` is the state that `state` was made from by changing basic facts; its derived facts are right and have been
  // copied into `state`.
  void update(const std::uint64_t* before, std::uint64_t* state) const;

 private:
  struct Component {
    int begin = 0, end = 0;  // of its facts in `members_`
    bool is_circle = false;
  };
  std::vector<std::vector<int>> derived_from() const;
  void find_components();
  void index();
  void disturb(int fact) const;            // what is derived from it must be looked at
  void sweep(std::uint64_t* state) const;  // all that must be looked at
  void evaluate(const Component& component, std::uint64_t* state) const;
  void evaluate_circle(const Component& component, std::uint64_t* state) const;
  bool fires(int axiom, const std::uint64_t* state) const;

  const GroundTask& task_;
  std::vector<Component> components_;         // in the order of dependencies
  std::vector<int> members_;                  // facts, by component
  std::vector<int> component_of_;             // by derived fact, from 0
  std::vector<int> head_begin_, of_head_;     // by derived fact: its axioms
  std::vector<int> used_begin_, used_by_;     // by fact: components derived from it, ascending
  std::vector<int> inner_begin_, inner_;      // by derived fact: axioms of its own circle with it as a condition
  mutable std::vector<std::uint64_t> dirty_;  // bits of components
  mutable std::vector<int> open_, stack_;     // by axiom: conditions of its own circle that are not yet true; facts
  mutable std::vector<char> was_true_;        // by member of a circle
};

}  // namespace stampede::symbolic
