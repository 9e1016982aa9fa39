// Help texts, shell completion and the command reference, all from the table of commands.
#pragma once

#include <string>
#include <vector>

#include "scripting/program/command.h"

namespace stampede::program {

std::string program_help(const std::vector<CommandRow>& commands);
std::string command_help(const CommandRow& command);
std::string command_reference(const std::vector<CommandRow>& commands);  // Markdown
std::string bash_completion(const std::vector<CommandRow>& commands);

}  // namespace stampede::program
