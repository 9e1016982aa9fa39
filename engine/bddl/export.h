// A scene and a goal of ours as a BDDL problem of either dialect.
#pragma once

#include <map>
#include <set>

#include "engine/bddl/mapping.h"

namespace stampede {

struct BddlThing {
  enum class Kind { object, fixture, part, region, hand };
  Kind kind = Kind::object;
  std::string name, class_name, type;
  std::string owner;                // part and region: the body; a region without one cannot be said
  std::vector<BddlRectangle> area;  // region: what it covers, in its owner's frame; fixture: where things can stand
};

// The start of a task, or any frame of an episode: the same shape, with the facts and placements of that moment.
struct BddlScene {
  std::string task, instruction;
  std::vector<BddlThing> things;
  std::vector<BddlPlacement> placements;
  Facts facts;  // traits and static facts included; derived ones may be
  Formula goal;
  std::vector<std::string> interest;
};

struct BddlExport {
  std::string refusal;  // not empty: the dialect cannot say the goal: which part, why, cure; then there is no text
  BddlProblem problem;
  std::string text;
  std::string file_name;                     // LIBERO: policies are told the words of the file's name
  std::set<BddlNote> notes;                  // of the predicates in init and goal
  std::vector<std::string> remarks;          // what was left out or has no counterpart
  std::map<std::string, std::string> names;  // ours -> theirs; several parts may have one
};

// Goals: static facts, equalities and types are decided now; derived predicates are replaced by their definition;
// quantifiers stay (BEHAVIOR, where they range over all instances of one category) or are written out over the
// objects. What is left must be a conjunction of atoms for LIBERO. `init` is what the facts say in their words.
// LIBERO: a part becomes a site of its body; `on` a fixture with an area becomes `on` a region of it. BEHAVIOR: parts
// are folded into their bodies, scene objects get a room, the hand an agent on the floor.
// Throws Error where check_mapping does and for objects that are named twice. Every atom written resolves.
BddlExport export_bddl(const BddlScene& scene, const BddlMapping& mapping, const Domain& domain);

}  // namespace stampede
