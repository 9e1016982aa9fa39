#include "engine/record/keyframes.h"

#include <cmath>

namespace stampede {
namespace {

constexpr double kStill = 0.1;      // rad/s
constexpr double kOpenShare = 0.9;  // of the widest opening: counts as open
constexpr int kBuffer = 4;          // frames after a stop in which none is accepted

}  // namespace

std::vector<std::int64_t> stopped_keyframes(const EpisodeRecord& episode) {
  const auto count = static_cast<std::int64_t>(episode.frames.size());
  double widest = 0;
  for (const FrameRecord& frame : episode.frames)
    if (!frame.hands.empty()) widest = std::max(widest, frame.hands[0].opening);
  const auto open = [&](std::int64_t i) {  // indices before the start wrap to the end, as in the rule's first code
    const auto& hands = episode.frames[static_cast<std::size_t>((i + count) % count)].hands;
    return !hands.empty() && hands[0].opening > kOpenShare * widest;
  };
  const auto still = [&](std::int64_t i) {
    const FrameRecord& frame = episode.frames[static_cast<std::size_t>(i)];
    for (std::size_t j = 0; j < episode.joints.size(); ++j)
      if (episode.joints[j].driven && episode.joints[j].kind == "hinge" &&
          !(std::abs(frame.joint_velocity[j]) <= kStill))
        return false;
    return true;
  };
  std::vector<std::int64_t> keyframes;
  int buffer = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const bool steady = i < count - 2 && open(i) == open(i + 1) && open(i) == open(i - 1) && open(i - 1) == open(i - 2);
    const bool stop = buffer <= 0 && i != count - 2 && steady && still(i);
    buffer = stop ? kBuffer : buffer - 1;
    if (i != 0 && (open(i) != open(i - 1) || i == count - 1 || stop)) keyframes.push_back(i);
  }
  if (keyframes.size() > 1 && keyframes[keyframes.size() - 1] - 1 == keyframes[keyframes.size() - 2])
    keyframes.erase(keyframes.end() - 2);
  return keyframes;
}

}  // namespace stampede
