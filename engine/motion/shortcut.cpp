#include <algorithm>

#include "engine/motion/rrt.h"

namespace stampede {
namespace {

struct ShortcutPoint {
  std::size_t segment = 0;  // between waypoint segment and segment + 1
  JointVector q;
};

std::vector<double> arc_lengths(const std::vector<JointVector>& path) {
  std::vector<double> lengths{0};
  for (std::size_t i = 1; i < path.size(); ++i) lengths.push_back(lengths.back() + (path[i] - path[i - 1]).norm());
  return lengths;
}

ShortcutPoint point_at(const std::vector<JointVector>& path, const std::vector<double>& lengths, double s) {
  const auto after = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, s);
  const std::size_t segment = static_cast<std::size_t>(after - lengths.begin()) - 1;
  const double span = lengths[segment + 1] - lengths[segment];
  const double share = span > 0 ? std::clamp((s - lengths[segment]) / span, 0.0, 1.0) : 0.0;
  return {segment, path[segment] + share * (path[segment + 1] - path[segment])};
}

// From each kept waypoint straight to the farthest one that can be seen among the next few.
std::vector<JointVector> skip_corners(const Checker& checker, const std::vector<JointVector>& path, double step_rad) {
  constexpr std::size_t kLookAhead = 8;
  std::vector<JointVector> kept{path.front()};
  for (std::size_t i = 0; i + 1 < path.size();) {
    std::size_t next = std::min(i + kLookAhead, path.size() - 1);
    while (next > i + 1 && !checker.edge_free(path[i], path[next], step_rad)) next = i + 1 + (next - i - 1) / 2;
    kept.push_back(path[next]);
    i = next;
  }
  return kept;
}

}  // namespace

std::vector<JointVector> shorten(const Checker& checker, std::vector<JointVector> path, int attempts, double step_rad,
                                 RandomKey key) {
  if (path.size() < 3) return path;
  path = skip_corners(checker, path, step_rad);
  Random random(key);
  for (int k = 0; k < attempts && path.size() > 2; ++k) {
    const std::vector<double> lengths = arc_lengths(path);
    const double s = random.between(0, lengths.back());
    const double t = random.between(0, lengths.back());
    const ShortcutPoint a = point_at(path, lengths, std::min(s, t));
    const ShortcutPoint b = point_at(path, lengths, std::max(s, t));
    if (a.segment == b.segment) continue;
    const double saved = std::abs(t - s) - (b.q - a.q).norm();
    if (saved < 0.01 || !checker.edge_free(a.q, b.q, step_rad)) continue;  // not worth the checks
    std::vector<JointVector> shorter(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(a.segment) + 1);
    shorter.push_back(a.q);
    shorter.push_back(b.q);
    shorter.insert(shorter.end(), path.begin() + static_cast<std::ptrdiff_t>(b.segment) + 1, path.end());
    path = std::move(shorter);
  }
  return path;
}

}  // namespace stampede
