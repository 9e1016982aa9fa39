// How a program's own code ends a whole run from within.
#pragma once

#include <exception>

#include "stampede/visibility.h"

namespace stampede {

// What a Policy, a sensor or another function of a program throws when not its skill has failed, but the run is to end,
// as Ctrl-C in it asks for: no episode counts what it was in the midst of, those that are finished are kept, and who
// began the run gets it thrown. It is no std::exception, as nothing between there and here may take it for a failure.
struct STAMPEDE_EXPORT Interruption {
  std::exception_ptr cause;
};

}  // namespace stampede
