// The shipped tasks and what their sentences have to mean, made once a test program: some starts in physics.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/language/rules.h"
#include "scripting/library/library.h"
#include "scripting/sentences/meaning_of.h"

namespace shipped {

std::shared_ptr<const stampede::Library> library();

// Of each task some variations: the first, and the last where there are several.
const std::vector<stampede::Meaning>& meanings();

// Of one variation; of the task's first, where none is named.
const stampede::Meaning& meaning(const std::string& task, const std::string& variation = {});

}  // namespace shipped
