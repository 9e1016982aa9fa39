// Mapping files: which words of BDDL's dialects stand for which of ours (worlds/bddl/NAME.lua).
#pragma once

#include <string>
#include <vector>

#include "engine/bddl/mapping.h"
#include "scripting/library/library.h"

namespace stampede {

// `path`: a file anywhere, or the name of one in worlds/bddl of the roots. Its entries go before those of the file of
// its dialect (worlds/bddl/libero.lua, behavior.lua); with `extend = false` they are all there is. README.md of
// worlds/bddl lists the fields.
// Throws Error for unknown fields, for words of ours that the library does not have and words of theirs that the
// dialect does not have, with the nearest as cure.
BddlMapping read_bddl_mapping(const Library& library, const std::string& path);

// The mapping that a dialect has in the roots.
BddlMapping bddl_mapping_of(const Library& library, BddlDialect dialect);
// Of `libero`, `behavior`, or both for any other word.
std::vector<BddlMapping> bddl_mappings_of(const Library& library, const std::string& dialect);
std::string dialect_name(BddlDialect dialect);  // libero, behavior: also the file's name

}  // namespace stampede
