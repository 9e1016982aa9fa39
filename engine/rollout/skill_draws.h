// What a skill's call leaves open: continuous parameters, drawn from their streams, bounds or defaults.
#pragma once

#include <string>
#include <vector>

#include "engine/rollout/rollout.h"
#include "engine/rollout/skill_call.h"
#include "engine/start/impasse.h"

namespace stampede {

// Fills call.continuous, in the order of declaration: what the context's settings say, else drawn. Repeatable: a pure
// function of the rollout's state and the context. Result: none, or why a stream has nothing, said in `detail`.
// `impasse`: where somebody asks, the subject of a stream and what was looked at for it, in vain or not.
Reason draw_continuous(Rollout& rollout, Symbols& symbols, const SkillContext& context, SkillCall& call,
                       std::string& detail, Impasse* impasse = nullptr);

// What may be touched near the targets: by the empty hand only what it is to grasp, by a held object all arguments.
std::vector<PartRef> touchable(const Rollout& rollout, const SkillContext& context);

// How many grasps and places are told apart; a random call takes any of them.
inline constexpr int kGraspCandidates = 6, kPlaceCandidates = 16;

}  // namespace stampede
