// How the program ends: documented in scripting/program/README.md, tested in tests/program.
#pragma once

namespace stampede::program {

enum ExitCode : int {
  kDone = 0,         // done, or the answer is yes
  kNo = 1,           // it ran and the answer is no
  kUsage = 2,        // the command line makes no sense
  kBadInput = 3,     // a script or another input file is wrong
  kCatalogue = 4,    // the catalogue cannot be used
  kBudgetSpent = 5,  // a budget ran out before there was an answer
  kInterrupted = 6,  // somebody stopped it; what is finished is kept
  kBug = 70          // our mistake
};

}  // namespace stampede::program
