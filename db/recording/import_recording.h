// A recording folder becomes an episode.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "db/catalogue.h"
#include "db/recording/recording_scene.h"
#include "engine/record/record.h"

namespace stampede {

struct ImportOptions {
  std::optional<int> frame_hz;       // goes before the recording's own
  std::optional<std::string> world;  // likewise
  int workers = 2;                   // threads that read, check and convert pictures; they do not change the result
};

// With source `real`; its pictures lie in the recording's folder until it is stored. The same recording, the same key.
// Throws Error with file, line and cure for everything that is wrong with it; all pictures are read for that.
EpisodeRecord record_of(const std::filesystem::path& folder, const RecordingStager& stager,
                        const ImportOptions& options);

struct StoredRecording {
  EpisodeRecord episode;
  std::int64_t id = 0;
  bool added = false;              // false: it was there already
  std::vector<std::string> notes;  // what is no fault and may be none the less meant otherwise, with file and line
};

// The same in a catalogue, all or nothing. Pictures are read once, while they are stored; twice where the catalogue has
// an episode of the same task and length, which may be this one.
StoredRecording store_recording(const std::filesystem::path& folder, const RecordingStager& stager,
                                const ImportOptions& options, Catalogue& catalogue, const EngineInfo& engine);

}  // namespace stampede
