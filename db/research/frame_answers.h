// Answers about frames: which row of theirs is about what.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "db/research/scorer.h"

namespace stampede::research {

std::string name_of(std::int64_t episode, std::int64_t frame, const std::string& about = "");

using Place = std::tuple<std::int64_t, std::int64_t, std::string>;  // episode, frame, what of it
using Places = std::map<Place, std::size_t>;                        // rows of the answers

// Rows by frame and the text of a column; without a column, by frame. Rows whose column is NULL are left out. Throws
// Error for a second answer about the same.
Places places_of(const ScoringJob& job, const std::string& column = "");
std::size_t row_about(const ScoringJob& job, const Places& places, const Place& place);  // throws Error: there is none

// What was asked about and not answered: places as people read them. Throws Error with how many there are and the
// first.
void refuse_missing(const ScoringJob& job, const std::vector<std::string>& missing, std::size_t asked,
                    const std::string& what, const std::string& cure);

// Answers about frames of test episodes that do not exist are mistakes, not extras.
void refuse_beyond_the_end(const ScoringJob& job);

struct Mean {
  double sum = 0, count = 0;
  void add(double value) { sum += value, ++count; }
  double value() const { return count > 0 ? sum / count : 0; }
};

}  // namespace stampede::research
