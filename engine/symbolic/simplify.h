// Derived facts that need not be derived.
#pragma once

#include "engine/symbolic/ground.h"

namespace stampede::symbolic {

// Lifting makes auxiliary predicates of quantifiers, and most of their ground facts turn out to be nothing of their
// own: always true or always false, another literal by another name, or, where denied, a conjunction. Puts in what they
// stand for, wherever actions and axioms use them, and removes derived facts that nothing uses any more. The goal stays
// in its own words. What the task means does not change.
void simplify(GroundTask& task);

}  // namespace stampede::symbolic
