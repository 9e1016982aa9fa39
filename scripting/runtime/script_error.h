// A task's own test that fails while its episode runs.
#pragma once

#include "engine/base/error.h"

namespace stampede {

// Ends the episode as script_error; other episodes of the run go on.
class ScriptError : public Error {
 public:
  using Error::Error;
};

}  // namespace stampede
