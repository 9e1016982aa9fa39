// Who goes with whom, so that all together fit best.
#pragma once

#include <vector>

namespace stampede::learning {

// By row its column, -1: none is left; no column twice, as many pairs as there can be, and the sum of their gains the
// greatest. The Hungarian method with potentials, O(n^3) (Kuhn, NRLQ 2, 1955; Jonker, Volgenant, Computing 38, 1987).
// Repeatable; rows of equal length.
std::vector<int> full_assignment(const std::vector<std::vector<double>>& gains);

// The same, but pairs without a gain (0 or less) are not made.
std::vector<int> best_assignment(const std::vector<std::vector<double>>& gains);

}  // namespace stampede::learning
