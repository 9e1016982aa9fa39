// Keyframe discovery as imitation-learning code for RLBench does it, for comparison with the true via-points.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/record/record.h"

namespace stampede {

// A frame is a keyframe where the gripper's open state changes, where all arm joints stand still (at most 0.1 rad/s,
// gripper steady, at least five frames apart) and at the end. James, Davison, RA-L 2022, doi:10.1109/LRA.2022.3140817.
std::vector<std::int64_t> stopped_keyframes(const EpisodeRecord& episode);

}  // namespace stampede
