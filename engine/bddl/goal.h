// Words, numbers, atoms and goals of BDDL from parsed lists. All throw Error at the node.
#pragma once

#include <vector>

#include "engine/bddl/words.h"
#include "engine/symbolic/pddl_tokens.h"

namespace stampede::symbolic {

const std::string& bddl_word(const Node& node, const char* what);
// As many numbers in parentheses, also such as `-pi/2`.
std::vector<double> read_bddl_numbers(const Node& list, std::size_t count, const char* what);
Fact read_bddl_fact(const Node& node);  // (on cup_1 table_1)
// The parts of (:goal FORMULA): those of its outer `and`, or the formula alone.
std::vector<BddlFormula> read_bddl_goal(const Node& section, const BddlScope& scope, BddlDialect dialect);

}  // namespace stampede::symbolic
