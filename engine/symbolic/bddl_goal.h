// Atoms and goals of BDDL from parsed lists.
#pragma once

#include <vector>

#include "engine/symbolic/bddl_words.h"
#include "engine/symbolic/pddl_tokens.h"

namespace stampede::symbolic {

Fact read_bddl_fact(const Node& node);  // (on cup_1 table_1)
// The parts of (:goal FORMULA): those of its outer `and`, or the formula alone.
std::vector<BddlFormula> read_bddl_goal(const Node& section, const BddlScope& scope, BddlDialect dialect);

}  // namespace stampede::symbolic
