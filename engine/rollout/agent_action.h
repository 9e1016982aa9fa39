// An agent's low-level actions: the operations that they mean.
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/record/action_space.h"
#include "engine/rollout/rollout.h"
#include "stampede/action.h"
#include "stampede/environment.h"

namespace stampede {

// What a space of arm or hand asks for during the next frame. Repeatable: a pure function of its arguments. Nothing has
// been applied yet, so a refusal changes nothing.
std::variant<std::vector<Operation>, ActionRefusal> operations_for(const AgentAction& action, Rollout& rollout);

// Where a tool space's values lead: of tool_pose, tool_delta, tool_impedance, tool_path and tool_path_delta.
Transform tool_target(const AgentAction& action, const World& world);

// What brings an arm to rest that an agent steers.
Operation rest(const World& world);

// What a skill action sets of its call.
CallSettings settings_of(const AgentAction& action);

}  // namespace stampede
