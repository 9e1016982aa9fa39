// A part of a data set that nobody vouches for, opened for who counts and indexes with its numbers.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "db/plain_file.h"

namespace stampede::research {

// The most frames of an episode: more than a day of them.
inline constexpr std::int64_t kMostFrames = 2'000'000;

// Opens given.db or hidden.db. Each number in the tables of its problem is checked here, once: units against the list
// of them, frames against their episode, counts, flags, facts and JSON lists. Throws CatalogueError naming the table.
PlainFile open_dataset(const std::filesystem::path& file);

// For what only reading shows: tables of a part that do not fit together.
[[noreturn]] void refuse_unfit(const PlainFile& file, const std::string& what);

// What `work` on a part makes of it; where that looks for a row or moment that is not there, the part is refused.
template <typename Work>
auto fitting(const PlainFile& file, const Work& work) {
  try {
    return work();
  } catch (const std::out_of_range&) {
    refuse_unfit(file, "its tables do not fit together: one speaks of what another lacks");
  }
}

}  // namespace stampede::research
