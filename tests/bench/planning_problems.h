// Seeded planning problems of any size: blocksworld, a typed tabletop with drawers and stacks, gripper.
#pragma once

#include <cstdint>
#include <string>

namespace stampede::bench {

struct PlanningProblem {
  std::string domain, problem;  // PDDL
};

PlanningProblem blocks(std::int64_t count, std::int64_t seed);    // 4 operators, random towers to random towers
PlanningProblem tabletop(std::int64_t count, std::int64_t seed);  // pick place stack unstack open-drawer close-drawer
PlanningProblem gripper(std::int64_t count, std::int64_t seed);   // balls in two rooms, two grippers

}  // namespace stampede::bench
