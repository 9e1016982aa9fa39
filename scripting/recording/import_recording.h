// A recording folder becomes an episode.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "engine/episode/record.h"
#include "scripting/library/library.h"

namespace stampede {

struct ImportOptions {
  std::optional<int> frame_hz;       // goes before the recording's own
  std::optional<std::string> world;  // likewise
  int workers = 2;                   // threads that check and convert pictures; they do not change the result
};

// With source `real`; its pictures lie in the recording's folder until it is stored. The same recording, the same key.
// Throws Error with file, line and cure for everything that is wrong with it.
EpisodeRecord record_of(const std::filesystem::path& folder, const std::shared_ptr<const Library>& library,
                        const ImportOptions& options);

}  // namespace stampede
