// The world in symbols at one moment: what holds, what is known to hold, and the numbers behind it.
#pragma once

#include <map>
#include <set>
#include <string>

#include "engine/record/record.h"
#include "engine/symbolic/symbols.h"

namespace stampede {

struct AbstractState {
  std::int64_t frame = 0;
  Facts facts;                                    // debounced; traits, attributes and derived ones included
  Facts observed;                                 // the same as far as it is known: see FactTracker::observed_intervals
  std::map<std::string, double> joints;           // rad or m, by JointName::name
  std::map<std::string, double> joint_fractions;  // 0 at the lower limit … 1 at the upper; limited joints only
  std::map<std::string, Pose> poses;              // world, by object
  std::map<std::string, double> openings;         // m, by hand
};

// Of a record, at any frame. Throws Error for a frame that it does not have.
AbstractState abstract_state(const EpisodeRecord& episode, std::int64_t frame);

// One line each: facts as sentences by the labels of their predicates (`the red block is on the table`), what is not
// known marked; then joints and poses.
std::string describe(const AbstractState& state, const Domain& domain, const Scene& scene);

// Of which nobody knows where they are: what lies hidden.
std::set<std::string> unseen_things(const AbstractState& state);

}  // namespace stampede
