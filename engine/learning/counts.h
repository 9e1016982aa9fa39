// How often something was right, wrong or missed, and what follows from it.
#pragma once

#include <cstdint>

namespace stampede::learning {

// A share of nothing is 1 for `precision` and `recall` where nothing was asked either, else 0.
struct Counts {
  std::int64_t right = 0, wrong = 0, missed = 0;
  double precision() const;  // right of all that was said
  double recall() const;     // right of all that was to be said
  double f1() const;         // their harmonic mean
  Counts& operator+=(const Counts& other);
};

// Two truths of the same things.
struct Confusion {
  std::int64_t both = 0, only_said = 0, only_true = 0, neither = 0;
  Counts counts() const { return {both, only_said, only_true}; }
  // Matthews' correlation, -1 … 1: 0 is what chance gives (Matthews, BBA 405, 1975). 0 where one of the two never
  // varies.
  double mcc() const;
};

}  // namespace stampede::learning
