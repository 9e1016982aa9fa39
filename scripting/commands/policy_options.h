// Options about a program that acts instead of the planner.
#pragma once

#include <optional>
#include <vector>

#include "engine/record/observation.h"
#include "scripting/program/command.h"
#include "scripting/session/policy_run.h"

namespace stampede::program {

std::vector<OptionRow> policy_options();  // --policy, --policy-timeout, --observe, --reward

// Nothing: the planner acts. `pictures`: what the command line says of them holds for those that are observed too.
// Throws UsageError for what makes no sense, options of the planner beside a policy among it.
std::optional<PolicySettings> policy_settings(const Arguments& arguments, const ObservationChoice& pictures);

}  // namespace stampede::program
