// How deep things lie in each other: what a CollisionState says beyond yes and no.
#pragma once

#include <optional>
#include <vector>

#include "engine/sim/collision_state.h"

namespace stampede {

// Two things that lie in each other; the arm's link, or what it holds, first.
struct Overlap {
  PartRef one, other;
  double depth = 0;  // the least way that parts them, m
};

// The deepest of the pairs that touch at `q`; nothing: none does.
std::optional<Overlap> deepest_overlap(const CollisionState& state, const JointVector& q);

// Bodies, at most one of them of the world itself, that lie deeper in each other than `most_m`: each pair of parts
// once, the deepest first. Parts of one body, and a body and what it is joined to, are no pairs.
std::vector<Overlap> overlapping_bodies(const CollisionState& state, double most_m);

// From now on only the arm counts: its links against each other and against all bodies, and what it holds against the
// links. The hand, its fingers and what it holds may meet bodies: for ways on which they are to.
void count_arm_alone(CollisionState& state);

}  // namespace stampede
