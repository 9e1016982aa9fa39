// Options about starts, goals and planning, shared by the commands that make episodes or plans.
#pragma once

#include <vector>

#include "engine/episode/runner.h"
#include "engine/symbolic/task_planner.h"
#include "scripting/library/library.h"
#include "scripting/program/command.h"

namespace stampede::program {

std::vector<OptionRow> constraint_options();  // --where, --goal
std::vector<OptionRow> behaviour_options();   // --behaviour, --skills
std::vector<OptionRow> setting_options();     // --set
std::vector<OptionRow> planner_options();     // --planner
void add_options(std::vector<OptionRow>& options, std::vector<OptionRow> further);

// Reads those that the command has. Throws UsageError, and Error for formulas that are none.
void read_symbol_options(const Arguments& arguments, RunOptions& options);

// Reads --set. Throws UsageError for what the library's skills do not have.
void read_settings(const Arguments& arguments, const Library& library, RunOptions& options);

// What `--planner` names, asked instead of ours. Throws UsageError for a command without {domain}, {problem}, {plan}.
std::function<PlanOutcome(const Domain& domain, const Problem& problem)> named_planner(const std::string& command);

}  // namespace stampede::program
