// What `import` can read beside BDDL problems; import.cpp is the list.
#pragma once

#include "scripting/program/command.h"

namespace stampede::program {

ExitCode import_recordings(const Arguments& arguments, Console& console);  // recording FOLDER…
ExitCode import_labels(const Arguments& arguments, Console& console);      // labels FILE CATALOGUE --episode N

}  // namespace stampede::program
