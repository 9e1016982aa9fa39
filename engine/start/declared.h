// What predicates and skills say of themselves, as their files declare it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/model/operation.h"
#include "engine/symbolic/symbols.h"

namespace stampede {

// Of which arguments a predicate can hold at all: pairs that touch or are near each other; held: the last argument is
// what the pads grasp.
enum class Pairs { all, touching, near, held };

struct PredicateTraits {
  double settle_s = 0;           // a shorter change is noise
  bool momentary = false;        // read at every physics step, no settle time
  bool remember = false;         // stays true once true
  bool ends_when_moved = false;  // every action that moves one of its things deletes it
  Pairs requires_pairs = Pairs::all;
  int functional = -1;             // index of the parameter that has at most one value for given others; -1: none
  std::vector<std::string> mutex;  // predicates that cannot hold of the same first argument
  // Of its margins: `m`, `rad`, or kUnitOfJoint; empty: it has none, or does not say.
  std::string margin_unit = {};
  bool only_named = false;  // followed in those tasks alone that name it
  // Of a relation that no skill declares, such as left_of: skills that make it by where they put its first thing, and
  // all that end it, with the parameter that they move.
  std::vector<std::string> made_by = {};
  std::vector<std::pair<std::string, std::string>> moved_by = {};
  bool sampled = true;  // it has a `sample`, which makes it
};
inline constexpr const char* kUnitOfJoint = "m or rad";  // that of the joint of the first argument

// A declared continuous parameter of a skill.
struct ContinuousInfo {
  enum class Source { value, grasps, sample };
  std::string name;
  Source source = Source::value;
  std::vector<double> initial, lower, upper;  // value: equal lengths (lower, upper may be infinite)
  std::string unit, frame;
  std::string object;   // grasps: the parameter that names the object
  Fact literal;         // sample: predicate and parameter names whose sample gives poses of its first argument
  std::string to = {};  // grasps: the number of the object that says up to where it must be taken; or empty
};

struct SkillInfo {
  std::string name;
  std::vector<Parameter> parameters;
  std::vector<ContinuousInfo> continuous;
  ControllerKind controller = ControllerKind::joint_position;
  double stiffness = 0;
  std::string label;                    // "pick up the {obj}"
  std::vector<std::string> forgets;     // predicates whose facts contact leaves uncertain
  std::vector<std::string> actions;     // names in the domain, one per case
  std::vector<std::string> moves = {};  // parameters that it moves
  std::vector<std::string> verbs = {};  // that tell of it in sentences, the first its own
  std::string replaces = {};            // the skill whose place it takes where a task or world asks for it; empty: none
};

}  // namespace stampede
