// A BDDL problem in our words: objects, start and goal.
#pragma once

#include <map>
#include <set>

#include "engine/bddl/judge.h"
#include "engine/bddl/mapping.h"
#include "engine/symbolic/evaluation.h"

namespace stampede {

struct BddlObject {
  std::string name, theirs;  // ours is well-formed and unique
  std::string category;      // theirs
  std::string class_name;    // ours, by the mapping
  std::string group;         // ours: the category's word, shared by its instances
};

// A region that stands in no model of ours: it must be made, on its target.
struct BddlMadeRegion {
  std::string name, theirs, on;  // name: on.region
  std::vector<BddlRectangle> ranges;
};

struct BddlTask {
  std::string name, instruction;
  std::vector<BddlObject> objects, fixtures;  // BEHAVIOR: fixtures are what :init puts into a room
  std::vector<BddlMadeRegion> regions;        // used by init or goal
  std::vector<BddlPlacement> placements;
  std::vector<BddlLiteral> init;             // in our words
  std::map<std::string, std::string> rooms;  // our object -> room
  std::vector<Formula> goal_parts;           // one for each part of the problem's goal, ground
  Formula goal;                              // their conjunction
  std::vector<std::string> interest;
  std::map<std::string, std::string> names;           // of objects, fixtures and regions: theirs -> ours
  std::map<std::pair<Fact, bool>, Formula> literals;  // of the goal: theirs (negated?) -> ours
  std::set<BddlNote> notes;
  std::vector<std::string> warnings;
  std::string refusal;  // why it cannot be a task here, and the cure; empty: it can. Then goal may be unfinished
};

// A formula of more ground atoms, or a quantifier of more disjuncts, is refused.
constexpr int kMostBddlDisjuncts = 1000, kMostBddlAtoms = 100'000;

// Quantifiers are expanded over the ground objects. `forn n` is exactly n; `forpairs` is read as it is documented, not
// as it is evaluated: a matching of all instances of the smaller category; `fornpairs n`: a matching of n pairs.
// LIBERO's `on` a region of a surface becomes `on` the surface and `inside` the region.
// Throws Error where check_bddl or check_mapping do.
BddlTask from_bddl(const BddlProblem& problem, const BddlMapping& mapping);

struct BddlVerdicts {
  bool theirs = false, ours = false;
  std::vector<std::string> disagreements;  // parts of the goal and ground literals on which the two differ
};

// `values`: their predicates in the state; `ours`: our facts in the same state, derived ones included, under the names
// of task.names. Parts may differ where both verdicts agree; they are listed too.
BddlVerdicts judge_both(const BddlProblem& problem, const BddlValues& values, const BddlTask& task,
                        const symbolic::View& ours);

}  // namespace stampede
