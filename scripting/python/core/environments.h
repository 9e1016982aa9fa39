// What environments, groups of them and policies share.
#pragma once

#include <stampede/environment.h>

#include "convert.h"

namespace stampede::python {

// A StepResult with its observation as numpy arrays.
struct Step {
  NamedValues observation;
  StepResult rest;
};
Step to_step(StepResult result);

// A policy of Python as the engine asks it: `factory()` gives an object with `act(observation)` and, if it likes,
// `begin(call)`. It may be called by any thread: the GIL is taken for each question.
PolicyEntry policy_entry(nb::callable factory, std::vector<std::string> channels, bool hidden, int width, int height,
                         std::string version);
std::function<std::unique_ptr<Policy>()> policy_maker(nb::callable factory);

EnvironmentSettings settings_from(const nb::kwargs& words, const char* where);

}  // namespace stampede::python
