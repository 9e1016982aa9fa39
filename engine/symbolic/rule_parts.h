// A rule's body taken apart around one variable, for rules over more variables than can be joined at once.
#pragma once

#include <set>

#include "engine/symbolic/lifted.h"

namespace stampede::symbolic {

std::set<int> variables_of(const Conjunct& one);

// Leaves in `mine` what speaks of the variable; the rest is added to `rest`.
void take_apart(Conjunct& mine, Conjunct& rest, int variable);

// The variable that the fewest others stand beside, none of `kept`; -1: there is none. `beside`: those others.
int least_bound(const Conjunct& body, const std::set<int>& kept, std::set<int>& beside);

}  // namespace stampede::symbolic
