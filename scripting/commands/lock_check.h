// How a catalogue agrees with a lock, said to people and programs.
#pragma once

#include "scripting/program/command.h"
#include "scripting/session/lock.h"

namespace stampede::program {

ExitCode tell_check(const LockCheck& check, const Lock& lock, bool json, Console& console);

}  // namespace stampede::program
