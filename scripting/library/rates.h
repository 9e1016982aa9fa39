// Rates in Hz and other limits: the check of the files and the building of a scene complain in the same words.
#pragma once

#include <string>

namespace stampede {

constexpr int kFastestPhysics = 4000;  // Hz: a second takes as long as seventeen at 240 Hz
constexpr int kMostBodies = 256;       // of a scene
constexpr int kMostShapes = 512;       // of an object, what collides and what is seen
constexpr int kMostRings = 256;        // of a lathe's profile

// The cure for a rate that does not divide `rate`.
inline std::string divisors_of(int rate) {
  std::string divisors;
  for (int one = 1; one <= rate; ++one)
    if (rate % one == 0) divisors += (divisors.empty() ? "" : " ") + std::to_string(one);
  return "these do: " + divisors;
}

}  // namespace stampede
