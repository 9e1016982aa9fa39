// What is said between an environment and a policy's program, as lines of JSON: POLICIES.md describes them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "stampede/environment.h"

namespace stampede {

// Writes a picture into a file and says where. `ChannelValue::data` is what the file holds, row by row.
using PictureStore = std::function<std::string(const ChannelValue& picture)>;

// CAMERA_rgb, CAMERA_depth, CAMERA_mask, CAMERA_semantic_mask, CAMERA_point_cloud.
bool is_picture(const ChannelValue& channel);

struct PolicyEpisode {
  std::string task, variation;
  std::int64_t seed = 0;
  std::vector<std::string> instructions;
};

// Each without its line's end. Infinities and what is not known (NaN) are null.
std::string reset_line(const PolicyEpisode& episode, const Environment& world, const EnvironmentObservation& seen,
                       const PictureStore& pictures);
std::string step_line(const StepResult& result, const PictureStore& pictures);

// Nothing: the program ends the episode. Throws Error whose message names the key that is wrong and whose hint says
// what belongs there. What such an action would do is not looked at: that is for `Environment::step` to refuse.
std::optional<AgentAction> action_from_line(const std::string& line);

}  // namespace stampede
