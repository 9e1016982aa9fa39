// The end of an episode of an imported problem, judged twice: by the dialect's own rule, and by our predicates.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "engine/bddl/import.h"
#include "engine/record/record.h"

namespace stampede {

// Lifetime: refers to its parts only.
struct ImportedProblem {
  BddlProblem problem;
  BddlMapping mapping;
  BddlTask task;  // with the names of our scene
};

// BDDL names of the task -> names of things in a scene of ours, everywhere in the task.
BddlTask with_scene_names(BddlTask task, const std::map<std::string, std::string>& names);

// LIBERO's predicates by its own geometry, in the last frame. BEHAVIOR needs ray casts and regions of contact that
// are not recorded: there, atoms are ours and only the rule for the whole formula is theirs.
std::map<std::string, BddlGeometry> libero_geometry(const EpisodeRecord& episode, const Scene& scene,
                                                    const ImportedProblem& imported);

// Throws Error for an episode without frames or problem.
VerdictRecord bddl_verdict(const EpisodeRecord& episode, const ImportedProblem& imported);

}  // namespace stampede
