// Which links of an arm can meet each other: found by looking at it all over the range of its joints, as MoveIt's setup
// assistant does, so that nobody has to list them.
#pragma once

#include <utility>
#include <vector>

#include "engine/model/scene.h"

namespace stampede {

// Pairs of parts, in order, that are to be checked. Left out are neighbours, those that touch wherever the joints are
// (hulls that swallow a neighbour's end), those that come nowhere near each other, and those that the arm does not move
// against each other: two fingers. Repeatable; kept for the process, as finding them takes some milliseconds.
std::vector<std::pair<int, int>> pairs_that_meet(const Robot& robot);

}  // namespace stampede
