// What only building shows of scripts: URDF and mesh files, sizes of shapes, tips off their tools, slots that are too
// small.
#pragma once

#include <memory>
#include <vector>

#include "engine/base/error.h"
#include "scripting/library/library.h"

namespace stampede::program {

// One draw of the first variation of each task, and each object that says where its tip is.
void check_built(const std::shared_ptr<const Library>& library, std::vector<Error>& complaints);

}  // namespace stampede::program
