// What a recording takes place in: its robot where it stood, its cameras, and the fixtures of a world of ours.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "db/recording/recording_file.h"
#include "engine/base/hash.h"
#include "engine/model/scene.h"
#include "engine/record/record.h"

namespace stampede {

struct RecordingStage {
  Scene scene;                                // the robot where it stood, the world's fixtures; masks are numbered
  std::vector<DefinitionRecord> definitions;  // the files of ours that say so
};

// Of the recording's robot and world; whoever knows these hands it in, so that no script is read here. Throws Error.
using RecordingStager = std::function<RecordingStage(const RecordingFile& recording)>;

struct RecordingScene {
  RecordingStage stage;
  std::set<std::string> uncalibrated;  // cameras whose optics and pose nobody measured: stand-ins at the world's origin
};

// Throws Error. Files that take part go to the hasher. The sizes of cameras that no file measured are those of the
// first picture of each.
RecordingScene scene_of(const RecordingFile& recording, const RecordingStager& stager, Hasher& hasher);

}  // namespace stampede
