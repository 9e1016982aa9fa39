// Complaints of what the program and the library share, in the words of who asked.
#pragma once

#include <string>
#include <typeinfo>

#include "engine/base/error.h"

namespace stampede {

// `--variation` is `variation` to who has no command line, and `--on-failure` is `on_failure`. Commands in backticks
// stay as they are.
std::string without_flags(const std::string& text);

// Calls `work`; what it complains of is said without the program's flags.
template <typename Work>
decltype(auto) in_own_words(const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (typeid(error) != typeid(Error)) throw;
    throw Error(without_flags(error.where()), without_flags(error.message()), without_flags(error.hint()));
  }
}

}  // namespace stampede
