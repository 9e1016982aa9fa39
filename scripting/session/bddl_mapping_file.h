// A mapping between BDDL's words and ours as a Lua file, which returns a table: see README.md.
#pragma once

#include <filesystem>
#include <string>

#include "engine/bddl/mapping.h"

namespace stampede {

// What a field does not say is as in the mapping that is built in for the dialect; `sites` and `parts` replace it, rows
// of `categories` and `predicates` go before its rows. Throws Error with the place.
BddlMapping read_bddl_mapping(const std::filesystem::path& path);
BddlMapping bddl_mapping_from_lua(const std::string& source, const std::string& place);

}  // namespace stampede
