// A way of the tool in pieces: lines, arcs, turns. Travelled one after the other without a stop but where one says so.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/motion/planner.h"

namespace stampede {

struct ToolPiece {
  // At a share 0 … 1 of the piece; at 0 where the piece before ends, of the first where the tip is.
  std::function<Transform(double)> world_from_tip;
  double speed = 0.25;            // m/s of the tip, at most
  double turn_speed = 1.0;        // rad/s of the tool, at most
  bool stop = false;              // the arm comes to rest at its end; it does at the end of the last
  std::string name;               // of the via at its end; empty: none
  std::optional<double> opening;  // m, to which the hand begins to open or close as the piece begins
};

struct PiecesOptions {
  // m: corners are cut within this distance of them, and by a quarter of it at most; a rad of turning counts as 0.25 m.
  double blend = 0.01;
  bool keep_clear = false;  // as of LineOptions; what opens may be left behind then, and counts as an obstacle
};

// Errors name the piece, counted from 1: `piece 2 'dip': the arm cannot follow beyond 40 % of it`. The moment at which
// a named piece ends is planned to the step. Repeatable: a pure function of its arguments.
PlannedMotion plan_pieces(const MotionProblem& problem, const std::vector<ToolPiece>& pieces,
                          const PiecesOptions& options);

// How far the tip goes and turns on a piece, m and rad.
struct PieceLength {
  double way = 0, turn = 0;
};
PieceLength length_of(const ToolPiece& piece);

}  // namespace stampede
