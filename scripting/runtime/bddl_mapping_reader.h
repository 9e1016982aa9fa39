// Mapping files: which words of BDDL's dialects stand for which of ours (worlds/bddl/NAME.lua).
#pragma once

#include <string>

#include "engine/bddl/mapping.h"
#include "scripting/library/library.h"

namespace stampede {

// `path`: a file anywhere, or the name of one in worlds/bddl of the roots. With `extend = true` the file's entries go
// before those that are built in, otherwise they are all there is. README.md of worlds/bddl lists the fields.
// Throws Error for unknown fields, for words of ours that the library does not have and words of theirs that the
// dialect does not have, with the nearest as cure.
BddlMapping read_bddl_mapping(const Library& library, const std::string& path);

}  // namespace stampede
