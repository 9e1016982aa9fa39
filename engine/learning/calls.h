// Which calls of an action can be taken in a state, and what they change. Room-internal.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "engine/symbolic/evaluation.h"

namespace stampede::learning {

using Call = std::vector<std::string>;

// Bounded: of an action whose preconditions bind nothing there may be millions.
inline constexpr std::size_t kMostCalls = 20'000;
std::set<Call> applicable_calls(const Action& action, const symbolic::View& view);

// Facts of a state in the words of a domain: those that it does not derive, and those that it does derived anew.
Facts in_words_of(const Domain& domain, const Facts& facts, const std::vector<TypedObject>& objects);

struct GroundChange {
  Facts added, removed;
};
// `facts`: in the words of the domain. Derived facts are part of the change.
GroundChange change_by(const Action& action, const Call& call, const Domain& domain, const Facts& facts,
                       const std::vector<TypedObject>& objects);

}  // namespace stampede::learning
