// The shipped tasks and what their sentences have to mean, made once a test program: some starts in physics.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scripting/language/sentence_check.h"
#include "scripting/library/library.h"

namespace shipped {

std::shared_ptr<const stampede::Library> library();

// Of each task some variations: the first, and the last where there are several.
const std::vector<stampede::Meaning>& meanings();

// Of one: the names are those of `meanings`.
const stampede::Meaning& meaning(const std::string& task);

}  // namespace shipped
