// A planning task over numbered facts, grounded by relaxed reachability.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "engine/symbolic/lifted.h"
#include "engine/symbolic/task_planner.h"

namespace stampede::symbolic {

// A literal is 2 * fact, plus 1 where negated. As an effect: an addition, or a removal.
using Literal = int;
using Literals = std::vector<Literal>;

struct ConditionalEffect {
  Literals when;
  Literal effect;
};

struct Operator {
  int schema = 0;
  std::vector<int> binding;
  Literals precondition, effects;  // sorted; no removal of what is also added
  std::vector<ConditionalEffect> conditional;
  int cost = 1;
};

struct Axiom {
  int head = 0;  // fact
  Literals body;
  int layer = 0;
};

struct GroundTask {
  LiftedTask lifted;
  int basic = 0, facts = 0;       // [0, basic) are changed by operators, [basic, facts) by axioms
  std::vector<LiftedAtom> atoms;  // of each fact
  std::vector<Operator> operators;
  std::vector<Axiom> axioms;  // sorted by layer
  std::vector<int> initial;   // facts
  Literals goal;
  std::vector<LiftedAtom> impossible;  // positive literals of the goal that nothing makes true
  std::vector<LiftedAtom> undeniable;  // negated literals of the goal that nothing makes false
  std::vector<LiftedAtom> reachable;   // all atoms that relaxed reachability met

  bool out_of_memory = false;  // grounding was given up; nothing else can be relied on
  std::string fullest;         // then: how many ground formulas there are, and what most of them come from

  bool solvable() const { return impossible.empty() && undeniable.empty(); }
  PlanStep step(int op) const;
  Fact fact(const LiftedAtom& atom) const;
};

// Helmert, Artificial Intelligence 173, 2009, doi:10.1016/j.artint.2008.10.013 (the idea: reachability as Datalog).
// An operator whose cost function has no value for its objects cannot be taken.
GroundTask ground(LiftedTask lifted, const std::set<PlanStep>& forbidden,
                  std::int64_t memory_bytes = PlanLimits{}.memory_bytes);

}  // namespace stampede::symbolic
