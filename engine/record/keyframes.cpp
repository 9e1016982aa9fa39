#include "engine/record/keyframes.h"

#include <cmath>

namespace stampede {
namespace {

constexpr double kStill = 0.1;      // rad/s
constexpr double kOpenShare = 0.9;  // of the widest opening: counts as open
constexpr int kBuffer = 4;          // frames after a stop in which none is accepted

// What the rule looks at. Indices before the start wrap to the end, as in the rule's first code.
class Watched {
 public:
  explicit Watched(const EpisodeRecord& episode)
      : episode_(episode), count_(static_cast<std::int64_t>(episode.frames.size())) {
    for (const FrameRecord& frame : episode.frames)
      if (!frame.hands.empty()) widest_ = std::max(widest_, frame.hands[0].opening);
  }
  std::int64_t count() const { return count_; }
  bool open(std::int64_t i) const {
    const auto& hands = episode_.frames[static_cast<std::size_t>((i + count_) % count_)].hands;
    return !hands.empty() && hands[0].opening > kOpenShare * widest_;
  }
  bool still(std::int64_t i) const {
    const FrameRecord& frame = episode_.frames[static_cast<std::size_t>(i)];
    for (std::size_t j = 0; j < episode_.scene.joints.size(); ++j)
      if (episode_.scene.joints[j].driven && episode_.scene.joints[j].kind == "hinge" &&
          !(std::abs(frame.joint_velocity[j]) <= kStill))
        return false;
    return true;
  }
  bool stopped(std::int64_t i) const {
    return i < count_ - 2 && open(i) == open(i + 1) && open(i) == open(i - 1) && open(i - 1) == open(i - 2) && still(i);
  }

 private:
  const EpisodeRecord& episode_;
  std::int64_t count_;
  double widest_ = 0;
};

}  // namespace

std::vector<std::int64_t> stopped_keyframes(const EpisodeRecord& episode) {
  const Watched watched(episode);
  std::vector<std::int64_t> keyframes;
  int buffer = 0;
  for (std::int64_t i = 0; i < watched.count(); ++i) {
    const bool stop = buffer <= 0 && watched.stopped(i);
    buffer = stop ? kBuffer : buffer - 1;
    if (i != 0 && (watched.open(i) != watched.open(i - 1) || i == watched.count() - 1 || stop)) keyframes.push_back(i);
  }
  if (keyframes.size() > 1 && keyframes[keyframes.size() - 1] - 1 == keyframes[keyframes.size() - 2])
    keyframes.erase(keyframes.end() - 2);
  return keyframes;
}

}  // namespace stampede
