// Which names are allowed, and which one was probably meant.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/nearest.h"  // edit_distance, nearest, did_you_mean

namespace stampede {

// What is wrong with a name of ours (`[a-z][a-z0-9_]*`, neither a keyword of Lua nor reserved by PDDL), or nothing.
std::optional<std::string> name_fault(std::string_view name);

// A sound name near a faulty one, not in `taken`.
std::string proposed_name(std::string_view name, const std::vector<std::string>& taken = {});

}  // namespace stampede
