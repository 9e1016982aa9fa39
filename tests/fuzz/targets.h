// Readers of files that nobody vouches for, each as a function of bytes.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace stampede::fuzz {

struct Target {
  std::string name;  // inputs/NAME: files to begin with, and those that once did harm; words/NAME.txt: what they say
  // Reads the bytes as such a file. An Error is an answer; any other exception is a defect, and is let out.
  std::function<void(std::string_view bytes)> read;
};

// Lifetime: files that readers want on disk lie in a folder of this process that goes with it.
const std::vector<Target>& targets();
const Target& target(std::string_view name);  // throws Error, naming those that there are

}  // namespace stampede::fuzz
