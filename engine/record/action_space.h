// The table of an agent's action spaces: names, components, units, bounds.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/model/scene.h"
#include "stampede/action.h"
#include "stampede/environment.h"

namespace stampede {

// All spaces of an arm, in the order of the table in stampede/action.h. Joint limits are those of the scene; the tool's
// are those of a Panda: 1.7 m/s and 2.5 rad/s, per frame where a space counts in frames.
std::vector<ActionSpace> action_spaces(const Scene& scene);

// The same for an arm with these joints, by name and unit alone: nothing has bounds.
std::vector<ActionSpace> named_spaces(const std::vector<std::string>& joints);

// What is wrong with an action's form: its space, number of values, bounds, controller, frame of reference. A joint or
// a hand that was measured up to 1 mrad or 1 mm beyond its stop may be sent there: it goes to the stop.
std::optional<ActionRefusal> mistake_in(const AgentAction& action, const std::vector<ActionSpace>& spaces);

bool is_of_tool(std::string_view space);     // its values are a pose or a motion of the tool
bool is_planned(std::string_view space);     // tool_path, tool_path_delta
bool lasts_a_frame(std::string_view space);  // all but these, skill, hold and go_on

}  // namespace stampede
