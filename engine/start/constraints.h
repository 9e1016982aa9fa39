// Constraints on a start: which literals make a formula true.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/start/predicates.h"
#include "engine/start/task.h"

namespace stampede {

// What is known of a scene without simulating it: its objects and the values of their attributes, by name; traits
// and attributes.
struct StaticFacts {
  std::vector<TypedObject> objects;
  Facts facts;
};
StaticFacts static_facts(const Scene& scene, const Domain& domain);

// Draws bindings and alternatives until what is known does not contradict: quantifiers over objects of the types and
// traits, disjunctions by one of their parts. `known` holds all traits and attributes; a literal of these is decided
// at once and not in the result, and so is one whose arguments are not of the predicate's types and traits. Result:
// what else has to be true, each once, in the formula's order; nothing when the formula contradicts itself, what is
// known, or what predicates say of themselves (`functional`, `mutex`). Repeatable: a pure function of its arguments.
std::optional<std::vector<Literal>> draw_literals(const Formula& formula, const Symbols& symbols,
                                                  const std::vector<TypedObject>& objects, const Facts& known,
                                                  RandomKey key);

std::set<std::string> predicates_of(const Formula& formula);  // that it names, traits and attributes too

// Why there can be no such fact, by the types and traits of its arguments: "table is not openable, which ?part must
// be"; empty: there can. Of attributes, which speak of values, always empty.
std::string atom_fault(const Fact& fact, const Domain& domain, const std::vector<TypedObject>& objects,
                       const Facts& known);

// What no fact can be, and the formula asks for in any case: a basic predicate of a thing and itself, or its own part.
// "left_of of cube1 and cube1"; empty: there is no such part.
std::string related_to_itself(const Formula& formula, const Domain& domain);

// The formula with the hand filled in where an atom leaves it out and there is one hand. Throws Error for unknown
// predicates, types and objects (with the nearest as cure), wrong numbers of arguments, variables that nothing
// binds and what relates a thing to itself. `place` starts the message: `--where`, `--goal`.
Formula checked_formula(const Formula& formula, const Domain& domain, const std::vector<TypedObject>& objects,
                        const std::string& place);

// Which parts of a conjunction do not hold; of another formula, itself.
std::vector<std::string> failing_parts(const Formula& formula, const Facts& facts, const Domain& domain,
                                       const std::vector<TypedObject>& objects);

}  // namespace stampede
