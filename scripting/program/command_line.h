// From words on the command line to a command that runs.
#pragma once

#include <string>
#include <vector>

#include "scripting/program/command.h"

namespace stampede::program {

// Runs the one of `commands` that the words (without the program's name) ask for, and says on the console what went
// wrong, if anything. Result: never throws; every exception becomes an exit code.
ExitCode run_program(const std::vector<CommandRow>& commands, const std::vector<std::string>& words, Console& console);

}  // namespace stampede::program
