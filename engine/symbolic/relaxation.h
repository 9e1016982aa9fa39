// A ground task without removals: rules over literals, which heuristics and landmarks share.
#pragma once

#include <vector>

#include "engine/symbolic/ground.h"

namespace stampede::symbolic {

// Nodes are literals (2 * fact, plus 1 where negated), and beyond those one for each axiom that may be denied.
struct Relaxation {
  explicit Relaxation(const GroundTask& task);

  struct Rule {
    int op = -1;                                   // -1: an axiom, costs nothing
    int begin = 0, end = 0;                        // of its effects
    int conditions_begin = 0, conditions_end = 0;  // of its conditions
  };
  int nodes = 0;
  std::vector<Rule> rules;  // operators' first, then those that cost nothing
  int costly = 0;           // the number of the former
  std::vector<int> effects, conditions;
  std::vector<int> used_begin, used;  // by node: rules with it as a condition
  std::vector<char> needed;           // by node: some condition or the goal mentions it

 private:
  void mark_needed(const GroundTask& task);
  void add_rule(int op, const std::vector<int>& condition, const std::vector<int>& effect);
  void add_denials(const GroundTask& task);
  void drop_dominated();
  void index_uses();
};

}  // namespace stampede::symbolic
