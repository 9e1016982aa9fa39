// robot_call::Follow as pieces of a way that the planner knows.
#pragma once

#include <vector>

#include "engine/motion/pieces.h"
#include "engine/start/interfaces.h"

namespace stampede {

// From where the tip is at `start`, one after the other. Throws Error for parts that the scene does not have.
std::vector<ToolPiece> tool_pieces(const robot_call::Follow& call, const WorldView& view, const Transform& start);

}  // namespace stampede
