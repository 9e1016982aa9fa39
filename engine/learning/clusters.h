// Transitions with equal effects, and what held before them. Room-internal.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/learning/experience.h"
#include "engine/learning/lifting.h"
#include "engine/learning/operators.h"

namespace stampede::learning {

struct Cluster {
  struct Member {
    const Transition* transition;
    std::vector<std::string> objects;  // by slot
  };
  std::string skill;
  std::size_t arguments = 0;  // the first slots
  LiftedAtoms added, removed;
  std::vector<Member> members;
  std::map<LiftedAtom, int> held;  // before: in how many members
  LiftedAtoms denied;              // must not hold
};

// The successful transitions that change something, by skill (in its order), the largest case first; cases that were
// seen too seldom are left out.
std::vector<Cluster> cluster_by_effects(const Experience& experience, const LearningOptions& options);
LiftedAtoms preconditions(const Cluster& cluster, double tolerance);
// By slot: the narrowest type that all members' objects share.
std::vector<std::string> slot_types(const Cluster& cluster, const std::map<std::string, std::string>& types);
std::set<std::string> changing_predicates(const Experience& experience);
// A thing that is the only one of its type in every scene becomes a slot of its own where something that can change
// held of it before all members.
void add_only_ones(Cluster& cluster, const std::set<std::string>& changing, double tolerance);
// Negated preconditions over the arguments, from failures of the same skill.
void deny_what_failed(const Experience& experience, std::vector<Cluster>& clusters, const LearningOptions& options,
                      LearnedOperators& counts);

// What it makes true must not hold already, where a state that was seen has both this and its precondition: there the
// action could have been taken, and never was. At most `kMostStates` states are looked at, evenly chosen.
inline constexpr std::size_t kMostStates = 200;
void deny_what_is_made(const Experience& experience, std::vector<Cluster>& clusters, const LearningOptions& options);

Action action_of(const Cluster& cluster, const Experience& experience, const LearningOptions& options);  // unnamed

}  // namespace stampede::learning
