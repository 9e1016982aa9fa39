// What can be seen of goals: how the things that the sentences speak of are to each other, to the rest and to the hand.
#pragma once

#include <Eigen/Dense>
#include <string>

#include "db/plain_file.h"
#include "db/research/signals.h"

namespace stampede::research {

// Of the things that are asked for, and of all others, what can be seen of goals. Columns of each: how many movable
// ones have moved, how far the highest has risen, how near the hand is to one, whether it holds one, how many are in
// something, on something asked for, on something else; how far joints have moved now, and at most so far. Then how
// many are still missing from a pile of the number that is asked for; the hand.
Eigen::MatrixXd relations(const PlainFile& given, const Signals& signals);

std::string kind_of_scene(const PlainFile& given, std::int64_t episode);  // its classes of things

}  // namespace stampede::research
