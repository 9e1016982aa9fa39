// Which episode is made.
#pragma once

#include <compare>
#include <cstdint>
#include <string>

namespace stampede {

struct EpisodeJob {
  std::string task, variation;  // a canonical text of the task's
  std::int64_t seed = 0;
  friend auto operator<=>(const EpisodeJob&, const EpisodeJob&) = default;
};

}  // namespace stampede
