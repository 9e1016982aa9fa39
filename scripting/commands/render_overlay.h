// Whether the model agrees with pictures.
#pragma once

#include "scripting/commands/render_output.h"
#include "scripting/program/command.h"

namespace stampede::program {

// Draws the robot over stored pictures and says how far its outline is from theirs.
ExitCode render_overlays(const Arguments& arguments, const RenderRequest& request, Console& console);

}  // namespace stampede::program
