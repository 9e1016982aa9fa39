// Which action of a learned domain stands for which of the true one.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/symbolic/symbols.h"

namespace stampede::learning {

struct ActionMatch {
  std::string learned, truth;  // names; truth empty: it stands for none
  std::vector<int> slot_of;    // by parameter of the true action: parameter of the learned one, -1: it has none
  double likeness = 0;         // F1 of effects and of preconditions, their mean, under these parameters
  bool by_name = false;
};

// An action that has a true one's name, was learned from that skill (`;@ skill`), or has that name with `_` and more
// behind it, stands for it; the others for those that they are most like, first one for each true action
// (best_assignment), then further ones as cases of it, and so those that would have to take what they are much less
// like; below a likeness of `kLeastLike` for none. Parameters go where
// the literals agree most, types that cannot meet apart. What the true domain derives is left out of effects there, and
// inequalities out of preconditions. `among`: the true actions in question; who has the name of
// another stands for none.
inline constexpr double kLeastLike = 0.3;
std::vector<ActionMatch> match_actions(const Domain& learned, const Domain& truth, const std::set<std::string>& among);

// The match of an action of the learned domain; null: it stands for none.
const ActionMatch* match_of(const std::vector<ActionMatch>& matches, const std::string& learned);

}  // namespace stampede::learning
