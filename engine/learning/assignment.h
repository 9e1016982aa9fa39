// Who goes with whom, so that all together fit best.
#pragma once

#include <vector>

namespace stampede::learning {

// By row its column, -1: none; no column twice, and the sum of the gains the greatest there is. Pairs without a gain
// (0 or less) are not made. The Hungarian method with potentials, O(n^3) (Kuhn, NRLQ 2, 1955; Jonker, Volgenant,
// Computing 38, 1987). Repeatable; rows of equal length.
std::vector<int> best_assignment(const std::vector<std::vector<double>>& gains);

}  // namespace stampede::learning
