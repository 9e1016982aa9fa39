// Where a recording takes place, by a library's files.
#pragma once

#include <memory>

#include "db/recording/recording_scene.h"
#include "scripting/library/library.h"

namespace stampede::program {

// The library's robot, or that of the recording's URDF, and the fixtures of a world of the library's.
RecordingStager stager_of(std::shared_ptr<const Library> library);

}  // namespace stampede::program
