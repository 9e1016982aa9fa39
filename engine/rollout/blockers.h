// What was in the way of a skill.
#pragma once

#include <functional>

#include "engine/rollout/rollout.h"
#include "engine/rollout/skill_call.h"

namespace stampede {

// Imagines things near the context's arguments away, one after the other, and asks `works`: each without which it says
// yes; where there is none, all near ones together, when that helps, less those that need not be away. Into
// result.blockers and its detail. Looks only where the call's mode asks for it.
void name_blockers(Rollout& rollout, const SkillContext& context, SkillResult& result,
                   const std::function<bool()>& works);

}  // namespace stampede
