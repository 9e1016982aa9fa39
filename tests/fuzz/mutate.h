// Files that are nearly sound.
#pragma once

#include "engine/base/random.h"
#include "tests/fuzz/targets.h"

namespace stampede::fuzz {

// A few changes of `bytes`: bits, bytes, numbers, pieces cut, repeated, swapped, taken from `other`, words spliced in.
// Repeatable: a function of its arguments.
std::string mutated(std::string bytes, const std::string& other, const std::vector<std::string>& words, Random& random);

}  // namespace stampede::fuzz
