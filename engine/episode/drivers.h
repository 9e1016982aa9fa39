// Who decides what is done next: loops over the skills of one rollout. Each ends with the episode's verdict.
#pragma once

#include <vector>

#include "engine/episode/current_plan.h"
#include "engine/rollout/skill_track.h"

namespace stampede {

// What a driver works with.
struct Drive {
  SkillTrack& track;
  CurrentPlan& plan;
  const RunOptions& options;
  std::vector<DocumentRecord>& documents;  // plans that failed are kept here
};

// The plan's skills in order; the first failure is the episode's.
SkillResult follow_plan(Drive& drive);
// A depth-first search over draws, whose states are the boundaries between skills.
SkillResult follow_with_undo(Drive& drive);
// What failed stays, and the rest is planned again from where the world is.
SkillResult follow_with_recovery(Drive& drive);
// Draws skills and arguments, and does not mind failing; the episode is as long as was asked for.
SkillResult act_at_random(Drive& drive, const Rollout& rollout, RandomKey key);

}  // namespace stampede
