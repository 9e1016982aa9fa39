// Operators learned from transitions, with and without labels.
#pragma once

#include <string>
#include <vector>

#include "engine/learning/experience.h"

namespace stampede::learning {

struct LearningOptions {
  int support = 2;          // transitions that a case must have been seen in
  double share = 0.02;      // and so many of its skill's (without labels: of all)
  double tolerance = 0;     // share of a case's transitions in which one of its preconditions may have been missing
  std::size_t further = 6;  // things beside the arguments that one transition may change; more are an accident
};

struct LearnedOperators {
  Domain domain;
  std::vector<int> seen;  // by action: transitions it was learned from
  int transitions = 0;    // successes
  int unused = 0;         // of these: in no case that was seen often enough, or without a change
  int failures = 0;       // of labelled skills
  int explained = 0;      // of these: refused by the preconditions learned
};

// Cluster and intersect (Silver et al., Learning Symbolic Operators for Task and Motion Planning, IROS 2021; the idea
// of cases by effects: Zettlemoyer, Pasula, Kaelbling, JAIR 2007): transitions of one skill that change the same
// literals over their arguments, and over further things that changed, are one case, and each case one action. Its
// precondition is what held of these things before all of them: the most that can be asked, so what is learned from
// clean data refuses too much rather than too little. Without labels it is also what held of the only thing of its type
// (a hand). Parameters have the narrowest type that all their objects share. Literals that a skill's failures have and
// its successes lack become negated preconditions, the one that explains the most failures first, as long as chance
// explains it in less than one case in twenty (hypergeometric); so does what an action makes true, where it was seen to
// hold with the precondition: there the action could have been taken, and never was. Transitions without a skill are
// clustered all together, and their actions are named op1, op2 … in the order of how often they were seen; those of a
// skill by its name, with _1, _2 … where it has cases. Throws Error where there is nothing to learn from, and for a
// skill whose calls differ in their number of arguments. Repeatable: a pure function of its arguments; actions are
// sorted by name.
LearnedOperators learn_operators(const Experience& experience, const LearningOptions& options = {});

// The action of a learned domain whose effects are just what a transition changed; empty: none.
std::string like_action(const Transition& transition, const Domain& learned);

}  // namespace stampede::learning
