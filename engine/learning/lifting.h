// Ground facts over a list of objects become literals over its places. Room-internal.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "engine/symbolic/symbols.h"

namespace stampede::learning {

struct LiftedAtom {
  std::string predicate;
  std::vector<int> slots;  // places in the list
  friend auto operator<=>(const LiftedAtom&, const LiftedAtom&) = default;
};
using LiftedAtoms = std::set<LiftedAtom>;

// The facts that are about these objects alone, those about nothing among them. The objects are distinct.
LiftedAtoms lifted(const Facts& facts, const std::vector<std::string>& objects);
Fact ground(const LiftedAtom& atom, const std::vector<std::string>& objects);

// What a transition changes, told by places: the first `fixed` objects keep theirs, the further objects of the changes
// follow in the order that makes the sets the least of all orders; so equal changes of other objects have equal sets.
// More than one order can: `orders` has all of them (objects with the fixed ones).
struct LiftedChange {
  LiftedAtoms added, removed;
  std::vector<std::vector<std::string>> orders;  // empty: more than `most` further objects
};
LiftedChange lifted_change(const Facts& before, const Facts& after, const std::vector<std::string>& fixed,
                           std::size_t most);

}  // namespace stampede::learning
