// What environments, groups of them and policies share.
#pragma once

#include <stampede/environment.h>
#include <stampede/session.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "convert.h"

namespace stampede::python {

// A StepResult with its observation as numpy arrays.
struct Step {
  NamedValues observation;
  StepResult rest;
};
Step to_step(StepResult result);

// A session as Python has it, with the functions of Python's that its engine holds: the cycle collector asks for them.
struct PySession : Owned<Session> {
  explicit PySession(SessionOptions options);
  std::map<std::string, std::shared_ptr<Kept>> functions;  // by kind and name
  const std::string catalogue;                             // empty: none
  bool has_catalogue() const { return !catalogue.empty(); }
};

// What a session made, and for as long as it is there, the session.
struct PyEnvironment : Owned<Environment> {
  PyEnvironment(nb::object session, const std::string& task, const EnvironmentSettings& settings);
  const std::string task;
  nb::object session;
  // Throws Error for the end of a recorded episode in a process that was forked: the catalogue is not its own.
  void check_may_keep() const;
};

// A policy of Python as the engine asks it: `factory()` gives an object with `act(observation)` and, if it likes,
// `begin(call)`. It may be called by any thread: the GIL is taken for each question.
std::function<std::unique_ptr<Policy>()> policy_maker(std::shared_ptr<Kept> factory);

EnvironmentSettings settings_from(const nb::kwargs& words, const char* where);

}  // namespace stampede::python
