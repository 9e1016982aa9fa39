// Numbers read from a file are checked once, here: what follows may rely on them. Inside this room only.
#pragma once

#include <cstdint>
#include <string>

#include "engine/record/record.h"

namespace stampede {

inline constexpr std::int64_t kMostHz = 1'000'000, kMostPixels = 1 << 16;

// Throws CatalogueError that names the file, the place, the number and its bounds.
void require_within(const std::string& path, const std::string& what, std::int64_t value, std::int64_t least,
                    std::int64_t most);

// Steps, frames and indices of a whole episode, against each other. The rates and the number of frames were checked
// before anything was read by them.
void check_numbers(const EpisodeRecord& episode, const std::string& path, std::int64_t id);

}  // namespace stampede
