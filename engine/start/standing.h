// Whether a scene can be a start at all, whatever a task asks of it: nothing lies in anything, the arm touches nothing,
// all is at rest.
#pragma once

#include <optional>
#include <string>

#include "engine/start/world_view.h"

namespace stampede {

class CollisionState;

inline constexpr double kPlacedDepth_m = 0.0011;  // that one body may be in another before all has settled

// What keeps a draw from being a start: two things that lie in each other, or an arm that touches.
struct Blocked {
  std::string what;    // as it is told: `cabinet standing clear of table`
  double depth = 0;    // m
  std::string cure;    // empty: draw again
  std::string moment;  // what would have to vary for it to go away: the same text, the same contact
};

// The arm where it starts: against itself, and against all that stands or lies about.
std::optional<Blocked> blocked_arm(const CollisionState& state, const Robot& robot);

// Nothing lies in anything else: furniture in the table, things in each other. Before they have settled, free things
// may: a cup is filled with beads in one place; and a hair deeper, for samplers put things a millimetre into what they
// are to lie on.
std::optional<Blocked> blocked_bodies(const CollisionState& state, bool settled);

bool all_at_rest(const WorldView& view);

}  // namespace stampede
