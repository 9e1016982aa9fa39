// Bindings that make a formula true, found by joins over the facts instead of one by one.
#pragma once

#include <functional>
#include <vector>

#include "engine/symbolic/evaluation.h"

namespace stampede::symbolic {

// Calls `visit` with every binding of the variables under which the formula (in negation normal form) holds, in no
// particular order and some more than once, until it returns false. Result: false if it did. The binding is as before
// on return. The facts must not change meanwhile.
//
// Atoms of a conjunction bind their variables from the facts that match, those first whose first arguments are known
// (facts are sorted by them); what all variables of are bound is tested at once; only what no atom binds is tried
// object by object.
bool for_each_solution(const std::vector<Parameter>& variables, const Formula& formula, const View& view,
                       Binding& binding, const std::function<bool()>& visit);

}  // namespace stampede::symbolic
