// Relations in space that a goal asks for, such as left_of: no skill declares them, skills make them by where they put
// things (PredicateTraits::made_by).
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/start/fact_tracker.h"
#include "engine/start/predicates.h"
#include "engine/start/task.h"

namespace stampede {

class CollisionState;
class WorldView;

// Predicates followed only where they are named (PredicateTraits::only_named) that the task names: in its formulas and
// functions, and in the domain's actions and derived predicates.
std::set<std::string> named_by(const Task& task, const Symbols& symbols);

// The literals of such relations that make the goal true, in its order: alternatives and bindings are drawn, the same
// for all seeds. Empty: it asks for none.
std::vector<Literal> relations_asked(const Task& task, const FactTracker& facts);

// Places for the first argument of `on` where those of `asked` hold that it is the first argument of too, with all else
// where it is; first those where the others hold that speak of it, then those that leave room for the first arguments
// of these to be put down after it. What is sampled for `on` and for the relations is tested in the world as `view`
// sees it. Empty: there is none.
std::vector<Placement> related_placements(const std::vector<Literal>& asked, const Fact& on, const WorldView& view,
                                          const CollisionState& space, Symbols& symbols, RandomKey key, int most);

// The first of `asked` that cannot be made from what `view` sees by putting things elsewhere on what they are on, one
// after the other, in a row of more than one: there is no room for all of it beside the table's edge, say. Nothing: all
// can; or it is the first already, for which plans make room by moving what is in its way; or nobody knows (they go
// round in a circle, or a thing is on nothing). Whether the arm gets there is not asked.
std::optional<Literal> relation_without_room(const std::vector<Literal>& asked, const FactTracker& facts,
                                             const WorldView& view, Symbols& symbols, RandomKey key);

}  // namespace stampede
