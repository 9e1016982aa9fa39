// Seeded problems of six kinds that planning competitions made common, with domains and generators of our own.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "planning_problems.h"

namespace stampede::bench {

// Each is a pure function of its arguments. The size is the number of what is in question: packages, people, crates,
// pictures, assemblies, passengers; everything else grows with it.
PlanningProblem logistics(std::int64_t packages, std::int64_t seed);   // trucks in cities, aircraft between them
PlanningProblem travel(std::int64_t people, std::int64_t seed);        // aircraft with levels of fuel, no numbers
PlanningProblem storage(std::int64_t crates, std::int64_t seed);       // hoists carry crates through narrow depots
PlanningProblem satellite(std::int64_t pictures, std::int64_t seed);   // turn, calibrate, take pictures
PlanningProblem assembly(std::int64_t assemblies, std::int64_t seed);  // ADL: quantified preconditions, conditions
PlanningProblem elevator(std::int64_t passengers, std::int64_t seed);  // ADL: conditional effects, quantifiers

struct ClassicalDomain {
  const char* name;
  PlanningProblem (*generate)(std::int64_t, std::int64_t);
  std::array<std::int64_t, 3> sizes;
};
extern const std::array<ClassicalDomain, 6> kClassicalDomains;

}  // namespace stampede::bench
