// Rates in Hz: the check of the files and the building of a scene complain in the same words.
#pragma once

#include <string>

namespace stampede {

// The cure for a rate that does not divide `rate`.
inline std::string divisors_of(int rate) {
  std::string divisors;
  for (int one = 1; one <= rate; ++one)
    if (rate % one == 0) divisors += (divisors.empty() ? "" : " ") + std::to_string(one);
  return "these do: " + divisors;
}

}  // namespace stampede
