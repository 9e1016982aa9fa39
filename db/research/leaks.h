// What training still shows of what a split holds out: the datasheet says so.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "db/research/split.h"

namespace stampede::research {

// Of one value that is held out, in episodes for training and validation.
struct Leak {
  std::string value;
  std::int64_t by_axis = 0;    // episodes in which another axis has it, or one of another task
  std::int64_t by_things = 0;  // episodes with a thing of that class, type or attribute, whatever part it has
  std::int64_t by_words = 0;   // episodes with sentences that say it
  std::int64_t sentences = 0;  // such sentences
  std::int64_t episodes = 0;   // in which any of these is
};

struct Leaks {
  std::int64_t training = 0;       // episodes for training and validation
  std::vector<Leak> values;        // in the order of what is held out; those of pairs one by one
  std::int64_t shared_starts = 0;  // test episodes whose task, variation and seed are those of a training episode
  std::int64_t shared_phrases =
      0;  // test episodes with a task sentence that is one of a training episode, word for word
};
Leaks leaks_of(const Catalogue& catalogue, const std::vector<SplitEpisode>& episodes, const Split& split,
               const SplitRule& rule);

// For the datasheet, as Markdown: says too where nothing leaks.
std::string leaks_text(const Leaks& leaks, const SplitRule& rule);
// The same on one line; empty: nothing of what is held out is shown.
std::string leaks_line(const Leaks& leaks);

}  // namespace stampede::research
