// A stored episode as a recording folder.
#pragma once

#include <cstdint>
#include <filesystem>

#include "db/catalogue.h"
#include "db/stored_episode.h"

namespace stampede {

// Joints, hand, commands, the wrench, stored pictures with their cameras, and labels (as those of the model `simulator`
// where they are the simulator's). All is on one clock that begins with the episode. recording.json is written last.
// Cameras on things that are not the robot are left out. Result: files written. Throws Error: a full disk.
std::int64_t export_recording(const Catalogue& catalogue, const StoredEpisode& stored,
                              const std::filesystem::path& folder);

}  // namespace stampede
