// Another planner's program in place of ours.
#pragma once

#include <string>

#include "engine/symbolic/task_planner.h"

namespace stampede {

// Runs a command template such as `fast-downward.py --plan-file {plan} --alias lama-first {domain} {problem}` in a new
// temporary folder: the three words stand for files there (quoted for the shell); domain and problem have been written
// to theirs, the plan is read from its own (or its anytime siblings `{plan}.1`, `{plan}.2`, …; the last one counts).
// Time limits are the command's own affair.
// Result: solved, with a plan that has been validated; else an explanation that quotes the end of what the program
// said. Exit codes 10 to 12 are Fast Downward's for unsolvable (`unsolvable` only for 10 and 11), 20 to 24 for limits.
// Throws Error for a template without `{domain}`, `{problem}` or `{plan}`, a program that is not found, and a plan
// that cannot be read or does not validate.
PlanOutcome solve_externally(const std::string& command, const Domain& domain, const Problem& problem);

}  // namespace stampede
