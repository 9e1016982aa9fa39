// What a ground action declares, before and after it, as literals to be tested.
#pragma once

#include <vector>

#include "engine/record/record.h"
#include "engine/start/task.h"

namespace stampede {

// Conditions are read in `before`. Forall is expanded over `objects`. In order, without doubles.
std::vector<Literal> ground_effects(const Action& action, const std::vector<std::string>& arguments,
                                    const Facts& before, const Domain& domain, const std::vector<TypedObject>& objects);

// Of each effect that counts (Effect::at_least): its literals, and how many of them are enough. No more than there are.
struct CountedEffects {
  std::size_t enough = 0;
  std::vector<Literal> literals;
};
std::vector<CountedEffects> counted_effects(const Action& action, const std::vector<std::string>& arguments,
                                            const Facts& before, const Domain& domain,
                                            const std::vector<TypedObject>& objects);

// The literals of its precondition, tested in `before`. Quantifiers are expanded over `objects`. In order, without
// doubles. `or` and `exists` inside another one count to it.
std::vector<PreconditionRecord> ground_precondition(const Action& action, const std::vector<std::string>& arguments,
                                                    const Facts& before, const Domain& domain,
                                                    const std::vector<TypedObject>& objects);

// The formula's binding of an action's parameters.
Binding binding_of(const Action& action, const std::vector<std::string>& arguments);

}  // namespace stampede
