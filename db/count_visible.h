// How many pixels of each thing an instance mask shows. Inside this room only.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "db/sqlite.h"

namespace stampede {

// Of a PNG of kind `instance`: number in the mask -> pixels; the background is left out. Throws Error when it is none.
std::vector<std::pair<int, std::int64_t>> visible_pixels(std::span<const std::uint8_t> png);

// All that table image holds, or what it holds of an episode, into table mask_pixels.
void count_stored_masks(const sql::Database& database, std::optional<std::int64_t> episode = {});

}  // namespace stampede
