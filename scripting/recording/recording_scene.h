// What a recording takes place in: its robot where it stood, its cameras, and the fixtures of a world of ours.
#pragma once

#include <memory>
#include <set>
#include <string>

#include "engine/base/hash.h"
#include "scripting/recording/recording_file.h"
#include "scripting/runtime/stage.h"

namespace stampede {

struct RecordingScene {
  Stage stage;
  std::set<std::string> uncalibrated;  // cameras whose optics and pose nobody measured: stand-ins at the world's origin
};

// Throws Error. Files that take part go to the hasher. The sizes of cameras that no file measured are those of the
// first picture of each.
RecordingScene scene_of(const RecordingFile& recording, const std::shared_ptr<const Library>& library, Hasher& hasher);

}  // namespace stampede
