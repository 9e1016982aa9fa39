// What the labels of any good episode have in common.
#pragma once

#include <string>

#include "engine/record/record.h"

namespace stampede::test {

// Motions and subgoals each cover every frame once; skills those before the arm stands still for the verdict.
void check_tiling(const EpisodeRecord& episode);

// The stored plan solves the stored problem.
void check_plan(const EpisodeRecord& episode);

}  // namespace stampede::test
