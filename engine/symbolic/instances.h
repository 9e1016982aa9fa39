// How many ground instances there are of what quantifies: counted before any of them is made.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/symbolic/evaluation.h"

namespace stampede::symbolic {

// Of one formula, predicate or action over the objects of an episode. Foreign PDDL has the planner's limits.
inline constexpr std::int64_t kMostInstances = 200'000;

// Variables times the objects that each can stand for; no more than 10^18.
std::int64_t instances_of(const std::vector<Parameter>& variables, const View& view);
std::int64_t times(std::int64_t count, std::int64_t choices);  // likewise

// Throws Error at `place` for more than kMostInstances, quantifiers in quantifiers multiplied:
// `exists over ?a ?b ?c: 3,200,000 instances, at most 200,000`.
void limit_instances(const Formula& formula, const View& view, const std::string& place);
// Of a predicate or an action, as `what`.
void limit_instances(const std::string& what, const std::vector<Parameter>& variables, const View& view,
                     const std::string& place);

// The error itself, for whoever counts by other means.
[[noreturn]] void too_many_instances(const std::string& what, const std::vector<std::string>& variables,
                                     std::int64_t count, std::int64_t most, const std::string& place);

}  // namespace stampede::symbolic
