// What a skill's call leaves open: continuous parameters, drawn from their streams, bounds or defaults.
#pragma once

#include <string>
#include <vector>

#include "engine/rollout/rollout.h"
#include "engine/rollout/skill_call.h"
#include "engine/start/impasse.h"
#include "engine/start/skills.h"

namespace stampede {

struct DrawnParameters {
  std::vector<ContinuousValue> values;  // in the order of declaration
  Reason reason = Reason::none;         // why the stream of the next one has nothing
  std::string detail;
};

// What the context's settings say, else drawn. Repeatable: a pure function of the rollout's state and the context.
// Of grasps, those are skipped with which the plan's next step that puts the thing somewhere finds no place to which
// its first motion could go, unless it finds none with any. `impasse`: where somebody asks, the subject of a stream and
// what was looked at for it, in vain or not.
DrawnParameters draw_continuous(Rollout& rollout, Symbols& symbols, SkillLibrary& skills, const SkillContext& context,
                                Impasse* impasse = nullptr);

// What may be touched near the targets: by the empty hand only what it is to grasp, by a held object all arguments,
// where it is one of them: what the hand holds by mistake would be pressed into what another is to be put on.
std::vector<PartRef> touchable(const Rollout& rollout, const SkillContext& context);

// How many grasps and places are told apart; a random call takes any of them.
inline constexpr int kGraspCandidates = 6, kPlaceCandidates = 16;

}  // namespace stampede
