// Pieces that a skill asks for as pieces of a way that the planner knows.
#pragma once

#include <vector>

#include "engine/motion/pieces.h"
#include "engine/start/robot_call.h"
#include "engine/start/world_view.h"

namespace stampede {

// From where the tip is at `start`, one after the other. Throws Error for parts that the scene does not have.
std::vector<ToolPiece> tool_pieces(const std::vector<robot_call::Piece>& asked, const WorldView& view,
                                   const Transform& start);

}  // namespace stampede
